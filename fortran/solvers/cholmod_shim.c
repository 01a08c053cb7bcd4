/* CHOLMOD behind an opaque handle, because Fortran cannot see the layout of its structures.
 *
 * Indices count from 0. Matrices are symmetric and come with both triangles in compressed columns; CHOLMOD reads
 * the upper one. Status codes are CHOLMOD's: 0 done, 1 not positive definite, negative failed. */
#include <omp.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <suitesparse/cholmod.h>

_Static_assert(sizeof(SuiteSparse_long) == sizeof(int64_t), "CHOLMOD's long integers are expected to have 64 bits");

typedef struct {
    cholmod_common common;
    cholmod_factor *factor;
} cholmod_shim;

/* The caller's arrays as a CHOLMOD matrix; nothing is copied. */
static cholmod_sparse matrix_view(int64_t n, int64_t *start, int64_t *row, double *value)
{
    cholmod_sparse a;
    memset(&a, 0, sizeof a);
    a.nrow = a.ncol = (size_t)n;
    a.nzmax = (size_t)start[n];
    a.p = start;
    a.i = row;
    a.x = value;
    a.stype = 1;
    a.itype = CHOLMOD_LONG;
    a.xtype = value ? CHOLMOD_REAL : CHOLMOD_PATTERN;
    a.dtype = CHOLMOD_DOUBLE;
    a.sorted = 1;
    a.packed = 1;
    return a;
}

/* NULL when there is no memory. */
cholmod_shim *cholmod_shim_create(void)
{
    cholmod_shim *self = calloc(1, sizeof *self);
    if (!self) return NULL;
    if (!cholmod_l_start(&self->common)) {
        free(self);
        return NULL;
    }
    self->common.print = 0;
    self->common.supernodal = CHOLMOD_SUPERNODAL;
    self->common.quick_return_if_not_posdef = 1;
    self->common.nmethods = 2;
    self->common.method[0].ordering = CHOLMOD_GIVEN;
    self->common.method[1].ordering = CHOLMOD_AMD;
    return self;
}

void cholmod_shim_destroy(cholmod_shim *self)
{
    cholmod_l_free_factor(&self->factor, &self->common);
    cholmod_l_finish(&self->common);
    free(self);
}

/* A fill-reducing order of a symmetric pattern: the better one of METIS and AMD. order[new] = old. */
int cholmod_shim_order(int64_t n, int64_t *start, int64_t *row, int64_t *order)
{
    cholmod_sparse a = matrix_view(n, start, row, NULL);
    cholmod_common common;
    cholmod_factor *factor;
    int status;
    if (!cholmod_l_start(&common)) return CHOLMOD_OUT_OF_MEMORY;
    common.print = 0;
    common.supernodal = CHOLMOD_SIMPLICIAL;
    common.nmethods = 2;
    common.method[0].ordering = CHOLMOD_METIS;
    common.method[1].ordering = CHOLMOD_AMD;
    factor = cholmod_l_analyze(&a, &common);
    status = common.status;
    if (factor) memcpy(order, factor->Perm, (size_t)n * sizeof *order);
    cholmod_l_free_factor(&factor, &common);
    cholmod_l_finish(&common);
    return status;
}

/* The better one of the given order, order[new] = old, and of AMD is taken. */
int cholmod_shim_analyse(cholmod_shim *self, int64_t n, int64_t *start, int64_t *row, int64_t *order)
{
    cholmod_sparse a = matrix_view(n, start, row, NULL);
    cholmod_l_free_factor(&self->factor, &self->common);
    self->factor = cholmod_l_analyze_p(&a, order, NULL, 0, &self->common);
    return self->common.status;
}

/* Numbers that the factor of the analysed matrix holds. */
int64_t cholmod_shim_factor_entries(const cholmod_shim *self)
{
    return (int64_t)self->factor->xsize;
}

/* Operations of a factorisation of the analysed matrix. */
double cholmod_shim_operations(const cholmod_shim *self)
{
    return self->common.fl;
}

/* Where the matrix is not positive definite, `failed` is the equation at which that was found. */
int cholmod_shim_factor(cholmod_shim *self, int64_t n, int64_t *start, int64_t *row, double *value, int64_t *failed)
{
    cholmod_sparse a = matrix_view(n, start, row, value);
    /* CHOLMOD starts a fixed number of threads for its copying loops, whatever the machine has: more than pays */
    const int levels = omp_get_max_active_levels();
    omp_set_max_active_levels(0);
    cholmod_l_factorize(&a, self->factor, &self->common);
    omp_set_max_active_levels(levels);
    if (self->common.status == CHOLMOD_NOT_POSDEF && self->factor->minor < (size_t)n)
        *failed = ((int64_t *)self->factor->Perm)[self->factor->minor];
    return self->common.status;
}

/* The square of each diagonal entry of the factor, by equation. */
void cholmod_shim_pivots(const cholmod_shim *self, double *pivot)
{
    const cholmod_factor *factor = self->factor;
    const int64_t *first = factor->super, *rows = factor->pi, *values = factor->px, *order = factor->Perm;
    const double *x = factor->x;
    for (size_t s = 0; s < factor->nsuper; s++) {
        const int64_t height = rows[s + 1] - rows[s];
        for (int64_t k = first[s]; k < first[s + 1]; k++) {
            const double diagonal = x[values[s] + (k - first[s]) * (height + 1)];
            pivot[order[k]] = diagonal * diagonal;
        }
    }
}

int cholmod_shim_solve(cholmod_shim *self, int64_t n, double *b, double *x)
{
    cholmod_dense right, *solution;
    memset(&right, 0, sizeof right);
    right.nrow = right.nzmax = right.d = (size_t)n;
    right.ncol = 1;
    right.x = b;
    right.xtype = CHOLMOD_REAL;
    right.dtype = CHOLMOD_DOUBLE;
    solution = cholmod_l_solve(CHOLMOD_A, self->factor, &right, &self->common);
    if (!solution) return self->common.status;
    memcpy(x, solution->x, (size_t)n * sizeof *x);
    cholmod_l_free_dense(&solution, &self->common);
    return CHOLMOD_OK;
}

/* Give back the numbers, keep the symbolic work. */
void cholmod_shim_release(cholmod_shim *self)
{
    if (self->factor && self->factor->xtype != CHOLMOD_PATTERN)
        cholmod_l_change_factor(CHOLMOD_PATTERN, 1, 1, 1, 1, self->factor, &self->common);
}
