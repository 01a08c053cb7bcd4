/* What a test asks of the processes of MPI. */
#include <mpi.h>
#include <stdlib.h>

void test_begin_processes(int *rank, int *size);
void test_broadcast(int n, int *values);
void test_gather(int n, const int *values, const int *counts, int *gathered);
void test_end_processes(int code);

enum { first_process = 0 };

void test_begin_processes(int *rank, int *size)
{
    MPI_Init(NULL, NULL);
    MPI_Comm_rank(MPI_COMM_WORLD, rank);
    MPI_Comm_size(MPI_COMM_WORLD, size);
}

void test_broadcast(int n, int *values) { MPI_Bcast(values, n, MPI_INT, first_process, MPI_COMM_WORLD); }

void test_gather(int n, const int *values, const int *counts, int *gathered)
{
    int size, *first;
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    first = calloc((size_t)size, sizeof *first);
    if (!first) MPI_Abort(MPI_COMM_WORLD, EXIT_FAILURE);
    for (int i = 1; i < size; i++) first[i] = first[i - 1] + counts[i - 1];
    MPI_Gatherv(values, n, MPI_INT, gathered, counts, first, MPI_INT, first_process, MPI_COMM_WORLD);
    free(first);
}

void test_end_processes(int code)
{
    if (code) MPI_Abort(MPI_COMM_WORLD, code);
    MPI_Finalize();
    exit(code);
}
