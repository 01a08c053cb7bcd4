/* What a path leads to. Opening a pipe to find out would wait for a writer, for ever if none comes. */
#include <sys/stat.h>

int litz_kind_of_path(const char *path);

/* As in litz_path_kind.f90 */
enum { kind_nothing, kind_file, kind_directory, kind_pipe, kind_other };

int litz_kind_of_path(const char *path)
{
   struct stat status;

   if (stat(path, &status) != 0) return kind_nothing;
   if (S_ISREG(status.st_mode)) return kind_file;
   if (S_ISDIR(status.st_mode)) return kind_directory;
   return S_ISFIFO(status.st_mode) ? kind_pipe : kind_other;
}
