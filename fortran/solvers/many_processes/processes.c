/* The processes of the program under MPI. The first one runs as if it were alone, and announces its calls of MUMPS, in
 * which the others take part. */
#define _POSIX_C_SOURCE 200809L
#include "mumps_shim.h"
#include <mpi.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

void litz_begin_processes(void);
void litz_end_processes(void);

enum { exit_memory = 6 };
/* A message: number of the factorisation, JOB, whether it is symmetric. Number 0: the end */
enum { message_length = 3, the_end = 0, first_process = 0 };
/* Between two looks for a message [ns]: the others are not to take time from the threads of the first */
static const struct timespec pause_of_waiting = {0, 200000};

static int begun = 0;

static void broadcast(int message[message_length])
{
    MPI_Request request;
    int done = 0;
    MPI_Ibcast(message, message_length, MPI_INT, first_process, MPI_COMM_WORLD, &request);
    for (MPI_Test(&request, &done, MPI_STATUS_IGNORE); !done; MPI_Test(&request, &done, MPI_STATUS_IGNORE))
        nanosleep(&pause_of_waiting, NULL);
}

static void announce(int instance, int job, int symmetric)
{
    int message[message_length] = {instance, job, symmetric};
    broadcast(message);
}

static void serve(void)
{
    int message[message_length];
    for (broadcast(message); message[0] != the_end; broadcast(message))
        if (!mumps_shim_follow(message[0], message[1], message[2])) {
            fputs("error: not enough memory: a process that takes part in the factorisation has none\n", stderr);
            MPI_Abort(MPI_COMM_WORLD, exit_memory);
        }
}

void litz_begin_processes(void)
{
    int given, rank, size;
    MPI_Init_thread(NULL, NULL, MPI_THREAD_FUNNELED, &given);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    begun = 1;
    if (rank != first_process) {
        serve();
        MPI_Finalize();
        exit(EXIT_SUCCESS);
    }
    if (size > 1) mumps_shim_announce = announce;
}

void litz_end_processes(void)
{
    if (!begun) return;
    if (mumps_shim_announce) mumps_shim_announce(the_end, 0, 0);
    mumps_shim_announce = NULL;
    begun = 0;
    MPI_Finalize();
}
