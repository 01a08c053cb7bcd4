/* Whether a fuzzer wants the deck read again. Without AFL++'s run-time object (afl-compiler-rt.o) it is read once. */
#include <stddef.h>

extern int __afl_persistent_loop(unsigned int) __attribute__((weak));
extern void __afl_manual_init(void) __attribute__((weak));

/* AFL++ looks for these in the program, to know that it reads many decks in one process. */
const char *const fuzz_signatures[] = {"##SIG_AFL_PERSISTENT##", "##SIG_AFL_DEFER_FORKSRV##"};

int fuzz_again(void);

int fuzz_again(void)
{
   static int calls;

   if (__afl_persistent_loop == NULL) return calls++ == 0;
   if (calls++ == 0) __afl_manual_init();
   return __afl_persistent_loop(1000);
}
