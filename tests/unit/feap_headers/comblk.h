   double precision :: hr
   integer :: mr
   common /comblk/ hr(1024), mr(1024)
