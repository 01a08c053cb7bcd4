   integer :: nh1, nh2, nh3
   common /hdata/ nh1, nh2, nh3
