      character      uct*4,utx(2)*15
      common /umac1/ uct  ,utx
