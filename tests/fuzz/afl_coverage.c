/* Joins gfortran's -fsanitize-coverage=trace-pc with AFL++: each edge between two places counts in the map of AFL++. */
#include <stdint.h>

extern uint8_t *__afl_area_ptr;
extern char __executable_start;

void __sanitizer_cov_trace_pc(void);

void __sanitizer_cov_trace_pc(void)
{
   static uintptr_t previous;
   uintptr_t here = (uintptr_t)__builtin_return_address(0) - (uintptr_t)&__executable_start;

   here = (here ^ here >> 4 ^ here << 8) & 0xffff;
   if (__afl_area_ptr) __afl_area_ptr[here ^ previous]++;
   previous = here >> 1;
}
