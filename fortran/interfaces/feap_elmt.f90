!> The contact element and the conductor as user elements 1 and 2 of FEAP and FEAPpv.
!>
!> Files of those programs: `hdata.h`, `comblk.h`, `cdata.h`, `eldata.h`, `iofile.h`, `umac1.h`.
!>
!>     MATErial,1
!>       USER,1                                      (or WIREcontact)
!>       rb r Eb E nub nu rhob rho                   (barred first; see litz_user_element)
!>       penalty value value value value             (of the normal law LINEAR, and up to 4 numbers of the spot law)
!>       normal spot axis voltage pairs              (numbers of the laws and options; lines of a table, 20 at most)
!>       force resistance                            (as many lines as there are pairs, of the spot law TABLE)
!>
!>     MATErial,2
!>       USER,2                                      (or WIREconductor)
!>       area rho length                             (length: 0 before loading, 1 present; see litz_user_conductor)
!>
!> Control data: 3 space dimensions, 7 unknowns or more for each node (`ux uy uz phix phiy phiz v`), up to 4 nodes for
!> each element. The tangent is unsymmetric: UTANgent. FEAP adds the components of rotation vectors, which must stay
!> below a full turn.
subroutine elmt01(d, ul, xl, ix, tl, s, r, ndf, ndm, nst, isw)
   use litz_kinds, only: dp
   use litz_user_element, only: n_history
   implicit none
   include 'hdata.h'
   include 'cdata.h'
   include 'eldata.h'
   include 'umac1.h'
   !> Unknowns of each node
   integer, intent(in) :: ndf
   !> Space dimensions
   integer, intent(in) :: ndm
   !> Unknowns of the element, with those of all nodes that an element of the mesh can have
   integer, intent(in) :: nst
   !> What is asked for; negative: a name of the element
   integer, intent(in) :: isw
   !> Numbers of the nodes (nen); with isw=1 the unknowns that are used (ndf, nen + 1)
   integer, intent(inout) :: ix(*)
   !> Material data (500): options, number of properties, properties
   real(dp), intent(inout) :: d(*)
   !> Unknowns (ndf, nen, kinds); kind 1: totals of the present iterate [m, rad, V]
   real(dp), intent(in) :: ul(*)
   !> Positions of the nodes before loading (ndm, nen) [m]
   real(dp), intent(in) :: xl(*)
   !> Temperatures of the nodes (nen), not used
   real(dp), intent(in) :: tl(*)
   !> Tangent (nst, nst), zero at the call
   real(dp), intent(inout) :: s(*)
   !> Minus the residual (nst) [N, N m, A], zero at the call
   real(dp), intent(inout) :: r(*)
   integer, parameter :: read_data = 1, check = 2, tangent = 3, results = 4, residual = 6

   if (isw < 0) utx(1) = 'wirecontact'
   select case (isw)
   case (read_data)
      call litz_feap_sizes('contact element', ndf, ndm, nst)
      call litz_feap_read_contact(d)
      ix(8:ndf) = 0
      nh1 = n_history
      pstyp = 0
   case (check, tangent, results, residual)
      call litz_feap_nodes('contact element', 4)
      call litz_feap_contact(d, ul, xl, s, r, ndf, ndm, nst, nen, isw == check, isw == tangent, isw == results)
   end select
end subroutine elmt01

!> The conductor: element 2, with the arguments of `elmt01`.
subroutine elmt02(d, ul, xl, ix, tl, s, r, ndf, ndm, nst, isw)
   use litz_kinds, only: dp
   use litz_user_conductor, only: n_conductor_history, n_conductor_properties
   implicit none
   include 'hdata.h'
   include 'cdata.h'
   include 'eldata.h'
   include 'umac1.h'
   !> As of `elmt01`
   integer, intent(in) :: ndf, ndm, nst, isw
   !> As of `elmt01`
   integer, intent(inout) :: ix(*)
   !> As of `elmt01`; cross-section, resistivity, length
   real(dp), intent(inout) :: d(*)
   !> As of `elmt01`
   real(dp), intent(in) :: ul(*), xl(*), tl(*)
   !> As of `elmt01`
   real(dp), intent(inout) :: s(*), r(*)
   integer, parameter :: read_data = 1, check = 2, tangent = 3, results = 4, residual = 6
   logical, external :: tinput
   character(len=15) :: no_words(1)

   if (isw < 0) utx(1) = 'wireconductor'
   select case (isw)
   case (read_data)
      call litz_feap_sizes('conductor', ndf, ndm, nst)
      if (tinput(no_words, 0, d, n_conductor_properties + 1)) then
        call litz_feap_stop('conductor', 'the line with cross-section, resistivity, length is missing')
      end if
      ! neither rotations nor what comes behind the voltage
      ix(4:6) = 0
      ix(8:ndf) = 0
      nh1 = n_conductor_history
      pstyp = 1
   case (check, tangent, results, residual)
      call litz_feap_nodes('conductor', 2)
      call litz_feap_conductor(d, ul, xl, s, r, ndf, ndm, nst, nen, isw == check, isw == tangent, isw == results)
   end select
end subroutine elmt02

!> Tangent, residual and results of a contact element.
subroutine litz_feap_contact(d, ul, xl, s, r, ndf, ndm, nst, nen, checks, wants_tangent, prints)
   use litz_kinds, only: dp
   use litz_user_element, only: user_contact, check_user_contact, user_contact_failure, words_length, n_history, &
      n_options, history_gap, history_force, history_resistance, history_current, history_energy, contact_active
   implicit none
   include 'hdata.h'
   include 'comblk.h'
   include 'eldata.h'
   include 'iofile.h'
   !> As of `elmt01`, and most nodes of an element of the mesh
   integer, intent(in) :: ndf, ndm, nst, nen
   !> Options, number of properties, properties
   real(dp), intent(in) :: d(*)
   !> Unknowns (ndf, nen), positions (ndm, nen)
   real(dp), intent(in) :: ul(ndf, nen, *), xl(ndm, *)
   !> Tangent (nst, nst), minus the residual (nst)
   real(dp), intent(inout) :: s(nst, nst), r(nst)
   !> The input is to be checked only; the tangent is wanted, the results are to be printed
   logical, intent(in) :: checks, wants_tangent, prints
   character(len=words_length) :: words
   real(dp) :: k(28, 28), internal(28), history(n_history)
   integer :: info, rows(28), i, j, first

   rows = [((ndf*(i - 1) + j, j=1, 7), i=1, 4)]
   first = n_options + 2
   associate (properties => d(first:first - 1 + nint(d(n_options + 1))), options => nint(d(:n_options)))
      words = check_user_contact(xl(1:3, 1:4), properties, options)
      if (words /= '') call litz_feap_stop('contact element', words)
      if (checks .or. words /= '') return
      history = hr(nh1:nh1 + n_history - 1)
      call user_contact(xl(1:3, 1:4), ul(1:7, 1:4, 1), properties, options, history, k, internal, info)
   end associate
   if (info < contact_active) call litz_feap_stop('contact element', user_contact_failure(info))
   if (prints) then
      write (iow, '(a, i8, a, es13.5, a, es13.5, a, es13.5, a, es13.5, a, es13.5)') ' contact element', n_el, &
         '  gap', history(history_gap), '  force', history(history_force), '  resistance', &
         history(history_resistance), '  current', history(history_current), '  energy', history(history_energy)
      return
   end if
   hr(nh2:nh2 + n_history - 1) = history
   r(rows) = -internal
   if (wants_tangent) s(rows, rows) = k
end subroutine litz_feap_contact

!> Tangent, residual and results of a conductor.
subroutine litz_feap_conductor(d, ul, xl, s, r, ndf, ndm, nst, nen, checks, wants_tangent, prints)
   use litz_kinds, only: dp
   use litz_user_conductor, only: user_conductor, check_user_conductor, conductor_words_length, n_conductor_history
   implicit none
   include 'hdata.h'
   include 'comblk.h'
   include 'eldata.h'
   include 'iofile.h'
   !> As of `litz_feap_contact`
   integer, intent(in) :: ndf, ndm, nst, nen
   !> Cross-section, resistivity, length (3)
   real(dp), intent(in) :: d(*)
   !> As of `litz_feap_contact`
   real(dp), intent(in) :: ul(ndf, nen, *), xl(ndm, *)
   !> As of `litz_feap_contact`
   real(dp), intent(inout) :: s(nst, nst), r(nst)
   !> As of `litz_feap_contact`
   logical, intent(in) :: checks, wants_tangent, prints
   character(len=conductor_words_length) :: words
   real(dp) :: k(8, 8), internal(8), results(n_conductor_history)
   integer :: rows(8), place(4)

   place = [1, 2, 3, 7]
   rows = [place, ndf + place]
   words = check_user_conductor(xl(1:3, 1:2), d(1:2), nint(d(3)))
   if (words /= '') call litz_feap_stop('conductor', words)
   if (checks .or. words /= '') return
   call user_conductor(xl(1:3, 1:2), ul(place, 1:2, 1), d(1:2), nint(d(3)), results, k, internal)
   if (prints) then
      write (iow, '(a, i8, a, es13.5, a, es13.5)') ' conductor      ', n_el, '  current', results(1), '  heat', &
         results(2)
      return
   end if
   hr(nh2:nh2 + n_conductor_history - 1) = results
   r(rows) = -internal
   if (wants_tangent) s(rows, rows) = k
end subroutine litz_feap_conductor

!> Material data of the contact element. FEAP fills what is missing with zeros, which the check of values finds.
subroutine litz_feap_read_contact(d)
   use litz_kinds, only: dp
   use litz_user_element, only: n_properties, n_options, option_rotations
   implicit none
   !> Options, number of properties, properties
   real(dp), intent(inout) :: d(*)
   character(len=*), parameter :: what = 'contact element'
   integer, parameter :: most_pairs = 20
   real(dp) :: wires(8), laws(5), choices(5)
   logical, external :: tinput
   character(len=15) :: no_words(1)
   integer :: i, n_pairs, first

   if (tinput(no_words, 0, wires, 8)) call litz_feap_stop(what, 'the line with 8 data of the wires is missing')
   if (tinput(no_words, 0, laws, 5)) call litz_feap_stop(what, 'the line of penalty and spot law is missing')
   if (tinput(no_words, 0, choices, 5)) call litz_feap_stop(what, 'the line with the options is missing')
   n_pairs = nint(choices(5))
   if (n_pairs < 0 .or. n_pairs > most_pairs) then
     call litz_feap_stop('contact element', 'a table has from 0 to 20 pairs of force and resistance')
   end if
   d(:n_options) = choices(:n_options)
   d(option_rotations) = 1
   first = n_options + 2
   d(first:first + 12) = [wires, laws]
   d(n_options + 1) = n_properties + 3
   if (n_pairs == 0) return
   d(n_options + 1) = n_properties + 2*n_pairs
   do i = 1, n_pairs
      if (tinput(no_words, 0, d(first + n_properties + 2*i - 2), 2)) then
        call litz_feap_stop('contact element', 'a line of the table of force and resistance is missing')
      end if
   end do
end subroutine litz_feap_read_contact

!> The control data of the mesh.
subroutine litz_feap_sizes(what, ndf, ndm, nst)
   implicit none
   !> Name of the element
   character(len=*), intent(in) :: what
   !> As of `elmt01`
   integer, intent(in) :: ndf, ndm, nst
   include 'cdata.h'

   if (ndf < 7) call litz_feap_stop(what, 'the control data must have 7 unknowns for each node: u (3), phi (3), v')
   if (ndm /= 3) call litz_feap_stop(what, 'the control data must have 3 space dimensions')
   if (nst < nen*ndf) call litz_feap_stop(what, 'the element arrays are smaller than nodes times unknowns')
end subroutine litz_feap_sizes

!> The nodes of the present element.
subroutine litz_feap_nodes(what, n_nodes)
   implicit none
   !> Name of the element
   character(len=*), intent(in) :: what
   !> How many it has
   integer, intent(in) :: n_nodes
   include 'eldata.h'
   character(len=40) :: words

   write (words, '(a, i0, a, i0)') 'it must have ', n_nodes, ' nodes, not ', nel
   if (nel /= n_nodes) call litz_feap_stop(what, words)
end subroutine litz_feap_nodes

!> Say what is wrong in the output file and on the screen, and end the program.
subroutine litz_feap_stop(what, words)
   implicit none
   !> Name of the element, and what is wrong
   character(len=*), intent(in) :: what, words
   include 'eldata.h'
   include 'iofile.h'

   write (iow, '(5a, i0, a, i0)') ' *ERROR* litz ', what, ': ', trim(words), '; material ', ma, ', element ', n_el
   write (*, '(5a, i0, a, i0)') ' *ERROR* litz ', what, ': ', trim(words), '; material ', ma, ', element ', n_el
   call plstop(.true.)
end subroutine litz_feap_stop
