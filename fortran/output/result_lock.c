/* The lock on the results of one run: no two runs write the same files at the same time.

   The kernel holds it and lets it go when the process ends, however it ends: a lock file that is left by a killed run holds
   nobody up. Its name stands in the directory only while the run lasts, where that can be had: it is removed at the end, and
   on the signals that a user ends a run with. */
#define _XOPEN_SOURCE 700
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

int litz_take_result_lock(const char *path, char *words, int n);
void litz_remove_result_lock(void);
void litz_release_result_lock(void);

/* As in result_lock.f90 */
enum { lock_is_taken, lock_is_held_by_another, lock_file_fails, locks_are_missing };

/* Each try but the last means that another run has just ended */
enum { most_tries = 1000 };

static const int ending_signals[] = {SIGINT, SIGTERM, SIGHUP};
enum { n_ending_signals = sizeof ending_signals / sizeof *ending_signals };

static char lock_path[PATH_MAX];
static int lock_file = -1;
static pthread_t owner;

/* Whether the path still leads to the open file: the run that held it before may have removed its name. */
static int is_in_place(int file, const char *path)
{
   struct stat opened, named;

   return fstat(file, &opened) == 0 && stat(path, &named) == 0 && opened.st_dev == named.st_dev
      && opened.st_ino == named.st_ino;
}

/* Who holds the lock, as the holder has written it, or as far as the kernel knows; 0: nobody any more. */
static int find_holder(int file, char *words, int n)
{
   struct flock lock = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
   char text[300] = "";
   int process = 0;

   if (fcntl(file, F_GETLK, &lock) != 0 || lock.l_type == F_UNLCK) return 0;
   if (pread(file, text, sizeof text - 1, 0) < 0) text[0] = '\0';
   text[strcspn(text, "\n")] = '\0';
   /* a holder on another machine has no number here; one that has just begun has not yet written its own */
   if (sscanf(text, "process %d on ", &process) == 1 && (lock.l_pid <= 0 || lock.l_pid == process))
      snprintf(words, (size_t)n, "%s", text);
   else if (lock.l_pid > 0)
      snprintf(words, (size_t)n, "process %ld", (long)lock.l_pid);
   else
      snprintf(words, (size_t)n, "a process on another machine");
   return 1;
}

static void write_holder(int file)
{
   char host[200] = "", text[300];
   int length;

   if (gethostname(host, sizeof host - 1) != 0) host[0] = '\0';
   length = snprintf(text, sizeof text, "process %ld on %s\n", (long)getpid(), host);
   /* the lock holds without these words */
   if (ftruncate(file, 0) == 0 && pwrite(file, text, (size_t)length, 0) < 0) return;
}

/* The thread that writes the results removes the name and ends: it writes nothing in between. */
static void on_ending_signal(int number)
{
   if (!pthread_equal(pthread_self(), owner)) {
      pthread_kill(owner, number);
      return;
   }
   litz_remove_result_lock();
   signal(number, SIG_DFL);
   raise(number);
}

static void watch_ending_signals(void)
{
   struct sigaction now, own = {.sa_handler = on_ending_signal, .sa_flags = SA_RESTART};

   sigemptyset(&own.sa_mask);
   owner = pthread_self();
   for (int i = 0; i < n_ending_signals; i++)
      /* a signal that is ignored, as under nohup, stays so */
      if (sigaction(ending_signals[i], NULL, &now) == 0 && now.sa_handler == SIG_DFL)
         sigaction(ending_signals[i], &own, NULL);
}

/* Take the lock, or say in `words` (n) who holds it or what the system has against it. */
int litz_take_result_lock(const char *path, char *words, int n)
{
   for (int i = 0; i < most_tries; i++) {
      struct flock lock = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
      const int file = open(path, O_RDWR | O_CREAT | O_CLOEXEC, 0666);

      if (file < 0 || strlen(path) >= sizeof lock_path) {
         snprintf(words, (size_t)n, "%s", strerror(file < 0 ? errno : ENAMETOOLONG));
         return lock_file_fails;
      }
      if (fcntl(file, F_SETLK, &lock) != 0) {
         const int reason = errno;
         const int is_held = (reason == EACCES || reason == EAGAIN) && find_holder(file, words, n);

         close(file);
         if (is_held) return lock_is_held_by_another;
         if (reason == EACCES || reason == EAGAIN || reason == EINTR) continue;
         snprintf(words, (size_t)n, "%s", strerror(reason));
         unlink(path);
         return locks_are_missing;
      }
      if (is_in_place(file, path)) {
         strcpy(lock_path, path);
         lock_file = file;
         write_holder(file);
         watch_ending_signals();
         return lock_is_taken;
      }
      close(file);
   }
   snprintf(words, (size_t)n, "its lock file changes all the time");
   return locks_are_missing;
}

/* Remove the name. Only to be called by the thread that writes, when it writes nothing more. */
void litz_remove_result_lock(void)
{
   if (lock_file >= 0) unlink(lock_path);
}

/* The name goes first: who opens the file by it after that finds that it is not in place any more. */
void litz_release_result_lock(void)
{
   litz_remove_result_lock();
   if (lock_file >= 0) close(lock_file);
   lock_file = -1;
}
