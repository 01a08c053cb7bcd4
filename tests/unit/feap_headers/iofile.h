   integer :: ior, iow
   logical :: keepfl, fmt_long
   common /iofile/ ior, iow, keepfl, fmt_long
