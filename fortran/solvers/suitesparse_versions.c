/* Versions of SuiteSparse and UMFPACK that this was compiled with, and of the CHOLMOD that it runs with: three
 * numbers each. */
#include <suitesparse/SuiteSparse_config.h>
#include <suitesparse/cholmod.h>
#include <suitesparse/umfpack.h>

void litz_suitesparse_versions(int versions[9])
{
    versions[0] = SUITESPARSE_MAIN_VERSION;
    versions[1] = SUITESPARSE_SUB_VERSION;
    versions[2] = SUITESPARSE_SUBSUB_VERSION;
    cholmod_l_version(versions + 3);
    versions[6] = UMFPACK_MAIN_VERSION;
    versions[7] = UMFPACK_SUB_VERSION;
    versions[8] = UMFPACK_SUBSUB_VERSION;
}
