/* CHOLMOD as a program without litz would call it, with its defaults but for the ordering. */
#include <stdint.h>
#include <string.h>
#include <suitesparse/cholmod.h>
#include <time.h>

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Symmetric matrix with both triangles in compressed columns from 0. Seconds: symbolic, numeric, one solution. */
int direct_cholmod(int64_t n, int64_t *start, int64_t *row, double *value, int ordering, double seconds[3],
                   double *flops, double *entries)
{
    cholmod_common common;
    cholmod_sparse a;
    cholmod_factor *factor;
    cholmod_dense *right, *solution;
    int status;
    double begin;

    memset(&a, 0, sizeof a);
    a.nrow = a.ncol = (size_t)n;
    a.nzmax = (size_t)start[n];
    a.p = start;
    a.i = row;
    a.x = value;
    a.stype = 1;
    a.itype = CHOLMOD_LONG;
    a.xtype = CHOLMOD_REAL;
    a.dtype = CHOLMOD_DOUBLE;
    a.sorted = a.packed = 1;
    cholmod_l_start(&common);
    if (ordering > 0) {
        common.nmethods = 1;
        common.method[0].ordering = ordering == 1 ? CHOLMOD_METIS : CHOLMOD_AMD;
        common.postorder = 1;
    }
    begin = now();
    factor = cholmod_l_analyze(&a, &common);
    seconds[0] = now() - begin;
    begin = now();
    cholmod_l_factorize(&a, factor, &common);
    seconds[1] = now() - begin;
    right = cholmod_l_ones((size_t)n, 1, CHOLMOD_REAL, &common);
    begin = now();
    solution = cholmod_l_solve(CHOLMOD_A, factor, right, &common);
    seconds[2] = now() - begin;
    *flops = common.fl;
    *entries = (double)factor->xsize;
    status = common.status;
    cholmod_l_free_dense(&solution, &common);
    cholmod_l_free_dense(&right, &common);
    cholmod_l_free_factor(&factor, &common);
    cholmod_l_finish(&common);
    return status;
}
