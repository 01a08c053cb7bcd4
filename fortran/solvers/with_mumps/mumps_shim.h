/* How the processes of one program take part in the calls of MUMPS that its first process makes. */
#ifndef LITZ_MUMPS_SHIM_H
#define LITZ_MUMPS_SHIM_H

/* Tells the other processes of a call: number of the factorisation, JOB, whether its matrices are symmetric */
typedef void mumps_announcement(int instance, int job, int symmetric);

/* Set in the first process where there are others; NULL: there are none */
extern mumps_announcement *mumps_shim_announce;

/* The part of another process in a call that was announced. 0 where it has no memory even for that. */
int mumps_shim_follow(int instance, int job, int symmetric);

#endif
