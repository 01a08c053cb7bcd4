/* What the libraries read from the environment when they are loaded, before the program's first line.

   OpenBLAS chooses its kernels by the model of the processor. A release does not know the processors that came after it,
   and takes kernels of twenty years ago for those: factorisations are then half as fast. What a processor can do it says
   itself. And threads of OpenMP spin while they wait, which is worth nothing here and holds up those of OpenBLAS. */
#define _GNU_SOURCE
#include <fcntl.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* NULL where the BLAS is another one */
char *openblas_get_corename(void) __attribute__((weak));
void litz_set_process_environment(void);

/* Room for the words that this process was started with */
enum { longest_command = 2097152, most_words = 65536 };

static int one_of(const char *name, const char *const *names)
{
   for (; *names; names++)
      if (strcmp(name, *names) == 0) return 1;
   return 0;
}

#if defined(__x86_64__)

/* OpenBLAS' name for the kernels with the widest vectors of this processor, where it has chosen others; else NULL. */
static const char *better_kernels(void)
{
   static const char *const oldest[] = {"Katmai", "Prescott", "Barcelona", "Nehalem", "Generic", NULL};
   static const char *const vectors_of_256_bits[] = {"Haswell", "Zen", NULL};
   const char *chosen = openblas_get_corename ? openblas_get_corename() : "";
   const int old = one_of(chosen, oldest);

   if (!old && !one_of(chosen, vectors_of_256_bits)) return NULL;
   if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw")
      && __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512cd"))
      return "SKYLAKEX";
   if (old && __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return "HASWELL";
   return NULL;
}

#else

static const char *better_kernels(void) { return NULL; }

#endif

/* The words of the command, ended by NULL; NULL where the system does not tell them. */
static char **own_command(void)
{
   char *text = malloc(longest_command), **words = malloc(most_words * sizeof *words);
   const int file = open("/proc/self/cmdline", O_RDONLY | O_CLOEXEC);
   ssize_t length = 0, got = -1;
   size_t n = 0;

   if (!text || !words || file < 0) return NULL;
   while ((got = read(file, text + length, (size_t)(longest_command - length))) > 0) length += got;
   close(file);
   if (got < 0 || length == 0 || length == longest_command) return NULL;
   for (ssize_t i = 0; i < length; i += (ssize_t)strlen(text + i) + 1) {
      if (n == most_words - 1) return NULL;
      words[n++] = text + i;
   }
   words[n] = NULL;
   return words;
}

/* Arrays of many megabytes come and go in every iteration. The C library gives each back to the system, which has to fill
   its pages with zeros when it is asked for the next one; up to these sizes [bytes] memory is kept for it instead. */
static void keep_memory(void)
{
#ifdef __GLIBC__
   enum { largest_kept = 512 * 1024 * 1024, kept_in_all = 1024 * 1024 * 1024 };

   if (getenv("MALLOC_MMAP_THRESHOLD_") || getenv("MALLOC_TRIM_THRESHOLD_")) return;
   if (mallopt(M_MMAP_THRESHOLD, largest_kept)) mallopt(M_TRIM_THRESHOLD, kept_in_all);
#endif
}

/* Where a choice is better made otherwise and the user has made none, make it and start the program again, once: the
   libraries do not look a second time. To be called before anything else is done. Where the program cannot be started
   again it goes on as it is. */
void litz_set_process_environment(void)
{
   const char *kernels = getenv("OPENBLAS_CORETYPE") ? NULL : better_kernels();
   const int threads_spin = !getenv("OMP_WAIT_POLICY");
   char **command;

   keep_memory();
   if (!kernels && !threads_spin) return;
   if (kernels && setenv("OPENBLAS_CORETYPE", kernels, 1) != 0) return;
   if (threads_spin && setenv("OMP_WAIT_POLICY", "passive", 1) != 0) return;
   command = own_command();
   if (command) execv("/proc/self/exe", command);
}
