/* MUMPS behind an opaque handle: its structure changes from release to release, and its own header knows it.
 *
 * Indices count from 1. A symmetric matrix comes with both triangles, of which MUMPS is given the upper one. Status
 * codes are those of MUMPS, INFOG(1): 0 or positive done, negative failed. */
#include "mumps_shim.h"
#include <dmumps_c.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

/* Of the communicator: all processes of the program */
enum { whole_world = -987654 };
/* Values of JOB */
enum { initialise = -1, terminate = -2, analyse = 1, factor = 2, solve = 3 };
/* A failed allocation, as MUMPS reports it */
enum { out_of_memory = -13 };
/* Places in ICNTL, CNTL and INFOG, one less than in Fortran, and what stands there */
enum { output_errors = 0, output_warnings = 1, output_totals = 2, print_level = 3 };
enum { column_permutation = 5, ordering = 6, scaling = 7, symmetric_ordering = 11, parallel_root = 12, relaxation = 13 };
enum { null_pivots = 23, sequential_analysis = 27 };
enum { ordering_given = 1, no = 0, yes = 1, silent = -1 };
enum { null_threshold = 2 };
enum { status_code = 0, status_detail = 1, negative_pivots = 11, peak_memory = 15, null_count = 27 };

typedef struct mumps_shim {
    DMUMPS_STRUC_C mumps;
    int instance;
    struct mumps_shim *next;
    MUMPS_INT *row, *column, *position;
    int64_t entries;
} mumps_shim;

mumps_announcement *mumps_shim_announce = NULL;

static int call(mumps_shim *self, int job)
{
    if (mumps_shim_announce) mumps_shim_announce(self->instance, job, self->mumps.sym);
    self->mumps.job = job;
    dmumps_c(&self->mumps);
    return self->mumps.infog[status_code];
}

static void free_arrays(mumps_shim *self)
{
    free(self->row);
    free(self->column);
    free(self->position);
    self->row = self->column = self->position = NULL;
}

static void set_controls(mumps_shim *self)
{
    MUMPS_INT *control = self->mumps.icntl;
    control[output_errors] = control[output_warnings] = control[output_totals] = silent;
    control[print_level] = no;
    control[column_permutation] = no;
    control[ordering] = ordering_given;
    control[scaling] = no;
    control[symmetric_ordering] = 1;
    /* negative pivots are counted on one process only, but for the last front where all work on that */
    control[parallel_root] = 1;
    control[null_pivots] = yes;
    control[sequential_analysis] = 1;
}

/* A pivot no larger than `smallest` counts as vanished. NULL when there is no memory. */
mumps_shim *mumps_shim_create(int symmetric, double smallest)
{
    static int instances = 0;
    mumps_shim *self = calloc(1, sizeof *self);
    if (!self) return NULL;
    self->instance = ++instances;
    self->mumps.sym = symmetric ? 2 : 0;
    self->mumps.par = 1;
    self->mumps.comm_fortran = whole_world;
    if (call(self, initialise) < 0) {
        free(self);
        return NULL;
    }
    set_controls(self);
    self->mumps.cntl[null_threshold] = -smallest;
    return self;
}

void mumps_shim_destroy(mumps_shim *self)
{
    call(self, terminate);
    free_arrays(self);
    free(self);
}

/* order[k]: equation, from 0, that is eliminated as number k + 1; `relax`: workspace beyond the estimate [%]. */
int mumps_shim_analyse(mumps_shim *self, int n, const int *start, const int *column, const int64_t *order, int relax)
{
    const int upper = self->mumps.sym != 0;
    const size_t most = (size_t)start[n] - 1;
    int64_t k = 0;
    free_arrays(self);
    self->row = malloc((most + 1) * sizeof *self->row);
    self->column = malloc((most + 1) * sizeof *self->column);
    self->position = malloc(((size_t)n + 1) * sizeof *self->position);
    if (!self->row || !self->column || !self->position) return out_of_memory;
    for (int i = 0; i < n; i++) {
        self->position[order[i]] = i + 1;
        for (int p = start[i] - 1; p < start[i + 1] - 1; p++) {
            if (upper && column[p] <= i) continue;
            self->row[k] = i + 1;
            self->column[k++] = column[p];
        }
    }
    self->entries = k;
    self->mumps.n = n;
    self->mumps.nnz = k;
    self->mumps.irn = self->row;
    self->mumps.jcn = self->column;
    self->mumps.perm_in = self->position;
    self->mumps.icntl[relaxation] = relax;
    return call(self, analyse);
}

/* What the factorisation takes on the process that takes most [bytes]; MUMPS rounds to 10^6. */
int64_t mumps_shim_memory(const mumps_shim *self)
{
    return 1000000 * (int64_t)self->mumps.infog[peak_memory];
}

/* `value`: entries of the analysed matrix. `failed`: an equation whose pivot vanished; 0: none. */
int mumps_shim_factor(mumps_shim *self, const int *start, const int *column, const double *value, int relax, int *failed)
{
    const int upper = self->mumps.sym != 0;
    int64_t k = 0;
    int status;
    double *entries = malloc(((size_t)self->entries + 1) * sizeof *entries);
    *failed = 0;
    if (!entries) return out_of_memory;
    for (int i = 0; i < self->mumps.n; i++)
        for (int p = start[i] - 1; p < start[i + 1] - 1; p++)
            if (!(upper && column[p] <= i)) entries[k++] = value[p];
    self->mumps.a = entries;
    self->mumps.icntl[relaxation] = relax;
    status = call(self, factor);
    self->mumps.a = NULL;
    free(entries);
    if (status >= 0 && self->mumps.infog[null_count] > 0) *failed = self->mumps.pivnul_list[0];
    return status;
}

/* Of the symmetric matrix that was factored. */
int mumps_shim_negative_pivots(const mumps_shim *self)
{
    return self->mumps.infog[negative_pivots];
}

/* What MUMPS adds to the last status, INFOG(2). */
int mumps_shim_detail(const mumps_shim *self)
{
    return self->mumps.infog[status_detail];
}

/* `x`: in the right-hand side, out the solution. */
int mumps_shim_solve(mumps_shim *self, double *x)
{
    int status;
    self->mumps.nrhs = 1;
    self->mumps.lrhs = self->mumps.n;
    self->mumps.rhs = x;
    status = call(self, solve);
    self->mumps.rhs = NULL;
    return status;
}

/* Main, sub and patch version of the header that this was compiled with. */
void mumps_shim_version(int version[3])
{
    version[0] = version[1] = version[2] = 0;
    sscanf(MUMPS_VERSION, "%d.%d.%d", version, version + 1, version + 2);
}

/* Matrices, right-hand sides and controls are those of the first process. */
int mumps_shim_follow(int instance, int job, int symmetric)
{
    static mumps_shim *first = NULL;
    mumps_shim **place = &first, *self;
    while (*place && (*place)->instance != instance) place = &(*place)->next;
    if (!*place && !(*place = calloc(1, sizeof **place))) return 0;
    self = *place;
    self->instance = instance;
    self->mumps.sym = symmetric;
    self->mumps.par = 1;
    self->mumps.comm_fortran = whole_world;
    call(self, job);
    if (job == initialise) set_controls(self);
    if (job == terminate) {
        *place = self->next;
        free(self);
    }
    return 1;
}
