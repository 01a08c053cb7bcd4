!> The contact element (TYPE=U1) and the conductor (TYPE=U2) as user elements of Abaqus/Standard.
!>
!>     *USER ELEMENT, TYPE=U1, NODES=4, COORDINATES=3, PROPERTIES=10, I PROPERTIES=5, VARIABLES=6, UNSYMM
!>      1, 2, 3, 4, 5, 6, 11
!>     *UEL PROPERTY, ELSET=CONTACTS
!>      (8 real properties on a line, then the other 2 and the 5 integer ones; see litz_user_element)
!>     *USER ELEMENT, TYPE=U2, NODES=2, COORDINATES=3, PROPERTIES=2, I PROPERTIES=1, VARIABLES=2
!>      11
!>     *UEL PROPERTY, ELSET=CONDUCTORS
!>      (cross-section, resistivity, 0; see litz_user_conductor)
!>
!> A pair of elements is one user element: all that may touch are listed in the input file. With the present length
!> of the conductor (1 in place of 0) its unknowns are 1, 2, 3, 11 and it is UNSYMM.
!>
!> What is wrong in the input file ends the analysis with a message of its own. Where the wires overlap and have no
!> unique closest points, which smaller increments may avoid, the increment is tried again with half of its time.
subroutine uel(rhs, amatrx, svars, energy, ndofel, nrhs, nsvars, props, nprops, coords, mcrd, nnode, u, du, v, a, &
   jtype, time, dtime, kstep, kinc, jelem, params, ndload, jdltyp, adlmag, predef, npredf, lflags, mlvarx, ddlmag, &
   mdload, pnewdt, jprops, njprop, period)
   use litz_kinds, only: dp
   implicit none
   !> Number of unknowns: 28 of U1; 2 or 8 of U2
   integer, intent(in) :: ndofel
   !> Number of right-hand sides
   integer, intent(in) :: nrhs
   !> Number of entries of `svars`: 6 of U1, 2 of U2
   integer, intent(in) :: nsvars
   !> Number of real properties
   integer, intent(in) :: nprops
   !> Number of coordinates of a node
   integer, intent(in) :: mcrd
   !> Number of nodes: 4 of U1, 2 of U2
   integer, intent(in) :: nnode
   !> Number of the type of element: 1 or 2
   integer, intent(in) :: jtype
   !> Numbers of the step and of the increment
   integer, intent(in) :: kstep, kinc
   !> Number of the element
   integer, intent(in) :: jelem
   !> Number of the distributed load
   integer, intent(in) :: ndload
   !> Number of predefined fields
   integer, intent(in) :: npredf
   !> Rows of `rhs` and `du`
   integer, intent(in) :: mlvarx
   !> Number of distributed loads on the element
   integer, intent(in) :: mdload
   !> Number of integer properties
   integer, intent(in) :: njprop
   !> Right-hand side (mlvarx, nrhs): minus the residual; in a linear perturbation minus its change
   real(dp), intent(inout) :: rhs(mlvarx, *)
   !> Tangent (ndofel, ndofel): minus the derivative of the right-hand side
   real(dp), intent(inout) :: amatrx(ndofel, ndofel)
   !> History (nsvars); at every call Abaqus gives that of the last converged state
   real(dp), intent(inout) :: svars(*)
   !> (8), (2): elastic energy [J]
   real(dp), intent(inout) :: energy(8)
   !> Real properties (nprops), see litz_user_element and litz_user_conductor
   real(dp), intent(in) :: props(nprops)
   !> Positions of the nodes before loading (mcrd, nnode) [m]
   real(dp), intent(in) :: coords(mcrd, nnode)
   !> Displacements [m], rotation vectors [rad] and voltages [V] (ndofel), all of them totals; in a linear perturbation
   !> those of the base state
   real(dp), intent(in) :: u(ndofel)
   !> Their increments, or the perturbation (mlvarx, nrhs)
   real(dp), intent(in) :: du(mlvarx, *)
   !> Rates of the unknowns (ndofel), first and second
   real(dp), intent(in) :: v(ndofel), a(ndofel)
   !> Time in the step and in all (2) [s]
   real(dp), intent(in) :: time(2)
   !> Time of the increment [s]
   real(dp), intent(in) :: dtime
   !> Parameters of the time integration (3)
   real(dp), intent(in) :: params(*)
   !> Distributed loads (mdload, nrhs) and their increments
   real(dp), intent(in) :: adlmag(mdload, *), ddlmag(mdload, *)
   !> Predefined fields (2, npredf, nnode)
   real(dp), intent(in) :: predef(2, npredf, nnode)
   !> Time of the step [s]
   real(dp), intent(in) :: period
   !> Types of the distributed loads (mdload, nrhs)
   integer, intent(in) :: jdltyp(mdload, *)
   !> What kind of step it is, and what is asked for (5)
   integer, intent(in) :: lflags(*)
   !> Integer properties (njprop): the options of litz_user_element and litz_user_conductor
   integer, intent(in) :: jprops(njprop)
   !> Below 1: the increment is to be tried again, that much shorter
   real(dp), intent(inout) :: pnewdt
   !> lflags(3), what is asked for; damping (3) and mass (4) are zero
   integer, parameter :: normal = 1, tangent = 2, residual = 5, residual_and_mass = 6, perturbation_output = 100
   real(dp), parameter :: shorter = 0.5_dp
   real(dp) :: k(ndofel, ndofel), r(ndofel)
   logical :: perturbs, failed
   integer :: i

   amatrx = 0
   rhs(:ndofel, :nrhs) = 0
   if (all(lflags(3) /= [normal, tangent, residual, residual_and_mass, perturbation_output])) return
   perturbs = lflags(4) == 1 .or. lflags(3) == perturbation_output
   select case (jtype)
   case (1)
      call litz_uel_contact(ndofel, nsvars, nprops, props, mcrd, nnode, coords, u, jelem, njprop, jprops, &
         .not. perturbs .and. lflags(3) /= tangent, svars, energy(2), k, r, failed)
   case (2)
      call litz_uel_conductor(ndofel, nsvars, nprops, props, mcrd, nnode, coords, u, jelem, njprop, jprops, &
         .not. perturbs .and. lflags(3) /= tangent, svars, k, r, failed)
   case default
      call litz_uel_stop(jelem, 'TYPE must be U1, the contact element, or U2, the conductor')
      return
   end select
   if (failed) then
      pnewdt = min(pnewdt, shorter)
      return
   end if
   if (lflags(3) == normal .or. lflags(3) == tangent) amatrx = k
   if (lflags(3) == tangent) return
   if (perturbs) then
      do i = 1, nrhs
         rhs(:ndofel, i) = -matmul(k, du(:ndofel, i))
      end do
   else
      rhs(:ndofel, 1) = -r
   end if
end subroutine uel

!> The contact element, TYPE=U1.
subroutine litz_uel_contact(ndofel, nsvars, nprops, props, mcrd, nnode, coords, u, jelem, njprop, jprops, keeps, &
   svars, elastic, k, r, failed)
   use litz_kinds, only: dp
   use litz_user_element, only: user_contact, check_user_contact, user_contact_failure, words_length, n_unknowns, &
      n_history, history_energy, contact_active
   implicit none
   !> As of `uel`
   integer, intent(in) :: ndofel, nsvars, nprops, mcrd, nnode, jelem, njprop, jprops(njprop)
   !> As of `uel`
   real(dp), intent(in) :: props(nprops), coords(mcrd, nnode), u(ndofel)
   !> The state is one of iteration, whose history is kept, not a tangent alone or that of a perturbation
   logical, intent(in) :: keeps
   !> History (nsvars), and elastic energy [J]
   real(dp), intent(inout) :: svars(*), elastic
   !> Tangent (ndofel, ndofel) and residual (ndofel)
   real(dp), intent(out) :: k(ndofel, ndofel), r(ndofel)
   !> The increment is to be tried again
   logical, intent(out) :: failed
   character(len=words_length) :: words
   real(dp) :: history(n_history)
   integer :: info

   failed = .true.
   k = 0
   r = 0
   words = ''
   if (nnode /= 4 .or. mcrd < 3) then
      words = 'U1 needs NODES=4 and COORDINATES=3'
   else if (ndofel /= n_unknowns) then
      words = 'U1 needs 7 degrees of freedom at each node: 1, 2, 3, 4, 5, 6 and that of the voltage, 9 or 11'
   else if (nsvars < n_history) then
      words = 'U1 needs VARIABLES=6'
   else
      words = check_user_contact(coords(1:3, 1:4), props, jprops)
   end if
   if (words /= '') then
      call litz_uel_stop(jelem, words)
      return
   end if
   history = svars(:n_history)
   call user_contact(coords(1:3, 1:4), reshape(u, [7, 4]), props, jprops, history, k, r, info)
   failed = info < contact_active
   if (failed) call litz_uel_warn(jelem, user_contact_failure(info))
   if (failed .or. .not. keeps) return
   svars(:n_history) = history
   elastic = history(history_energy)
end subroutine litz_uel_contact

!> The conductor, TYPE=U2: the degrees of freedom of a node are that of the voltage, or 1, 2, 3 and that.
subroutine litz_uel_conductor(ndofel, nsvars, nprops, props, mcrd, nnode, coords, u, jelem, njprop, jprops, keeps, &
   svars, k, r, failed)
   use litz_kinds, only: dp
   use litz_user_conductor, only: user_conductor, check_user_conductor, conductor_words_length, n_conductor_unknowns, &
      n_conductor_history, conductor_reference_length
   implicit none
   !> As of `uel`
   integer, intent(in) :: ndofel, nsvars, nprops, mcrd, nnode, jelem, njprop, jprops(njprop)
   !> As of `uel`
   real(dp), intent(in) :: props(nprops), coords(mcrd, nnode), u(ndofel)
   !> The state is one of iteration, whose results are kept
   logical, intent(in) :: keeps
   !> Results (nsvars)
   real(dp), intent(inout) :: svars(*)
   !> Tangent (ndofel, ndofel) and residual (ndofel)
   real(dp), intent(out) :: k(ndofel, ndofel), r(ndofel)
   !> The increment is to be tried again
   logical, intent(out) :: failed
   character(len=conductor_words_length) :: words
   real(dp) :: unknowns(4, 2), k_all(n_conductor_unknowns, n_conductor_unknowns), r_all(n_conductor_unknowns)
   real(dp) :: results(n_conductor_history)

   failed = .true.
   k = 0
   r = 0
   if (nnode /= 2 .or. mcrd < 3) then
      words = 'U2 needs NODES=2 and COORDINATES=3'
   else if (ndofel /= 2 .and. ndofel /= n_conductor_unknowns) then
      words = 'U2 needs the degree of freedom of the voltage at each node, 9 or 11, or 1, 2, 3 and that'
   else if (nsvars < n_conductor_history) then
      words = 'U2 needs VARIABLES=2'
   else if (njprop < 1) then
      words = 'U2 needs I PROPERTIES=1, the length: 0 (before loading) or 1 (present)'
   else
      words = check_user_conductor(coords(1:3, 1:2), props, jprops(1))
      if (words == '' .and. ndofel == 2 .and. jprops(1) /= conductor_reference_length) then
        words = 'U2 over the present length needs the degrees of freedom 1, 2, 3 before that of the voltage'
      end if
   end if
   if (words /= '') then
      call litz_uel_stop(jelem, words)
      return
   end if
   failed = .false.
   if (ndofel == 2) then
      unknowns = 0
      unknowns(4, :) = u
      call user_conductor(coords(1:3, 1:2), unknowns, props, jprops(1), results, k_all, r_all)
      k = k_all([4, 8], [4, 8])
      r = r_all([4, 8])
   else
      call user_conductor(coords(1:3, 1:2), reshape(u, [4, 2]), props, jprops(1), results, k, r)
   end if
   if (keeps) svars(:n_conductor_history) = results
end subroutine litz_uel_conductor

!> Say what is wrong, and end the analysis. `stdb_abqerr` and `xit` are procedures of Abaqus.
subroutine litz_uel_stop(jelem, words)
   use litz_kinds, only: dp
   implicit none
   !> Number of the element
   integer, intent(in) :: jelem
   !> What is wrong
   character(len=*), intent(in) :: words
   integer, parameter :: error_and_end = -3
   character(len=8) :: no_texts(1)

   no_texts = ''
   call stdb_abqerr(error_and_end, 'litz, user element %I: '//trim(words), [jelem], [0.0_dp], no_texts)
   call xit()
end subroutine litz_uel_stop

!> Say why an increment is tried again.
subroutine litz_uel_warn(jelem, words)
   use litz_kinds, only: dp
   implicit none
   !> Number of the element
   integer, intent(in) :: jelem
   !> What happened
   character(len=*), intent(in) :: words
   integer, parameter :: warning = -1
   character(len=8) :: no_texts(1)

   no_texts = ''
   call stdb_abqerr(warning, 'litz, user element %I: '//trim(words)//'; the increment is shortened', [jelem], &
      [0.0_dp], no_texts)
end subroutine litz_uel_warn
