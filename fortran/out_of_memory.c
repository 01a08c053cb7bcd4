/* Want of memory, in words.

   gfortran's own end of a failed allocation is a line about bytes and a backtrace, and where it does not look (automatic
   arrays, temporary copies) a segmentation fault. Here the linker leads the allocations of the program's own code
   through functions that remember a failure; whatever would end the program after one ends it with a message. */
#define _POSIX_C_SOURCE 200809L
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

enum { exit_memory = 6 };

void *__real_malloc(size_t size);
void *__real_calloc(size_t n, size_t size);
void *__real_realloc(void *old, size_t size);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t n, size_t size);
void *__wrap_realloc(void *old, size_t size);
void __wrap__gfortran_os_error_at(const char *where, const char *format, ...) __attribute__((noreturn));
void __wrap__gfortran_runtime_error(const char *format, ...) __attribute__((noreturn));
void __real__gfortran_runtime_error(const char *format, ...) __attribute__((noreturn));
void litz_watch_memory(void);
/* Of result_lock.c */
void litz_remove_result_lock(void);

/* Bytes that the last failed request asked for; 0: none has failed */
static volatile size_t missing;

static void *remembered(void *memory, size_t size)
{
   if (memory == NULL && size > 0) missing = size;
   return memory;
}

void *__wrap_malloc(size_t size) { return remembered(__real_malloc(size), size); }

void *__wrap_calloc(size_t n, size_t size)
{
   return remembered(__real_calloc(n, size), n != 0 && size > (size_t)-1 / n ? (size_t)-1 : n * size);
}

void *__wrap_realloc(void *old, size_t size) { return remembered(__real_realloc(old, size), size); }

static double resident_bytes(void)
{
   char text[100] = "";
   long pages = 0;
   int file = open("/proc/self/statm", O_RDONLY);

   if (file < 0) return 0;
   if (read(file, text, sizeof text - 1) > 0) sscanf(text, "%*d %ld", &pages);
   close(file);
   return (double)pages * (double)sysconf(_SC_PAGESIZE);
}

/* Only calls that are allowed in a signal handler and need no memory, but for snprintf and sscanf on local arrays. */
static void __attribute__((noreturn)) end_without_memory(void)
{
   char text[400];
   int length;

   litz_remove_result_lock();
   length = snprintf(text, sizeof text,
      "error: not enough memory: another %.1f MB could not be had, the program holds %.1f MB already; give it more memory "
      "(see ulimit -v), take fewer threads, or make the model smaller\n",
      1e-6 * (double)missing, 1e-6 * resident_bytes());
   if (length > 0 && write(STDERR_FILENO, text, (size_t)length) < 0) _exit(exit_memory);
   _exit(exit_memory);
}

void __wrap__gfortran_os_error_at(const char *where, const char *format, ...)
{
   (void)where;
   (void)format;
   end_without_memory();
}

/* The size of an array that no integer can count. Other errors of the run-time library go their own way. */
void __wrap__gfortran_runtime_error(const char *format, ...)
{
   va_list arguments;
   char text[400];

   if (missing > 0) end_without_memory();
   va_start(arguments, format);
   vsnprintf(text, sizeof text, format, arguments);
   va_end(arguments);
   __real__gfortran_runtime_error("%s", text);
}

static void (*previous_handler)(int);

/* Returning repeats the access, now under the handler of before. */
static void on_bad_access(int signal_number)
{
   if (missing > 0) end_without_memory();
   signal(signal_number, previous_handler);
}

/* From now on a bad access after a failed allocation is what it is: want of memory. */
void litz_watch_memory(void) { previous_handler = signal(SIGSEGV, on_bad_access); }
