      integer         ior,iow
      common /iofile/ ior,iow

      logical         keepfl,fmt_long
      common /iofile/ keepfl,fmt_long
