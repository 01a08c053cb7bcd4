program litz
   implicit none
end program litz
