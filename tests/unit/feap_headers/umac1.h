   character(len=4) :: uct
   character(len=15) :: utx(2)
   common /umac1/ uct, utx
