/* What the communicator of many processes asks of MPI. */
#include <mpi.h>
#include <stdlib.h>

void litz_find_process(int *process, int *n_processes);
void litz_gather_counts(int n, const int *own, const int *counts, int *gathered);
void litz_gather_numbers(int n, const double *own, const int *counts, double *gathered);
void litz_exchange_numbers(int n_neighbours, const int *neighbours, const int *counts, const double *sent,
                           double *received);

enum { exit_memory = 6, message_tag = 1 };

/* Processes count from 0 */
void litz_find_process(int *process, int *n_processes)
{
    MPI_Comm_rank(MPI_COMM_WORLD, process);
    MPI_Comm_size(MPI_COMM_WORLD, n_processes);
}

static void *allocate(int n, size_t size)
{
    void *found = calloc((size_t)n + 1, size);
    if (!found) MPI_Abort(MPI_COMM_WORLD, exit_memory);
    return found;
}

static void gather(int n, const void *own, const int *counts, void *gathered, MPI_Datatype type)
{
    int n_processes, *first;
    MPI_Comm_size(MPI_COMM_WORLD, &n_processes);
    first = allocate(n_processes, sizeof *first);
    for (int i = 1; i < n_processes; i++) first[i] = first[i - 1] + counts[i - 1];
    MPI_Allgatherv(own, n, type, gathered, counts, first, type, MPI_COMM_WORLD);
    free(first);
}

/* `counts`: how many numbers each process has; all of them get all */
void litz_gather_counts(int n, const int *own, const int *counts, int *gathered)
{
    gather(n, own, counts, gathered, MPI_INT);
}

void litz_gather_numbers(int n, const double *own, const int *counts, double *gathered)
{
    gather(n, own, counts, gathered, MPI_DOUBLE);
}

/* `counts`: how many numbers go to each neighbour and come from it, one neighbour after the other */
void litz_exchange_numbers(int n_neighbours, const int *neighbours, const int *counts, const double *sent,
                           double *received)
{
    MPI_Request *requests = allocate(2 * n_neighbours, sizeof *requests);
    for (int i = 0, first = 0; i < n_neighbours; first += counts[i++]) {
        MPI_Irecv(received + first, counts[i], MPI_DOUBLE, neighbours[i], message_tag, MPI_COMM_WORLD, requests + i);
        MPI_Isend(sent + first, counts[i], MPI_DOUBLE, neighbours[i], message_tag, MPI_COMM_WORLD,
                  requests + n_neighbours + i);
    }
    MPI_Waitall(2 * n_neighbours, requests, MPI_STATUSES_IGNORE);
    free(requests);
}
