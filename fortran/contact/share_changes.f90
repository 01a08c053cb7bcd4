!> How much what a contact carries, and by which law, has changed from one state to another: in parts of a share.
module litz_share_changes
   use litz_kinds, only: dp
   use litz_contact_points, only: contact_point_t
   use litz_cut_lens, only: cut_lens_t
   implicit none
   private
   public :: change_of_cut, change_of_cylinders, change_of_energies, change_of_law

   !> A change of the sine of a lens, relative to it, matters this much more than one of a share
   real(dp), parameter :: sine_matters = 20
   !> So does one of the parts of legs and joint, which all of the contact goes with
   real(dp), parameter :: joints_matter = 10

contains

   !> How much the law of a contact near ends and joints has changed: by the shapes of its overlap, and by what it has
   !> of them.
   pure real(dp) function change_of_cut(earlier, lens) result(change)
      type(cut_lens_t), intent(in) :: earlier, lens

      change = joints_matter*maxval(abs(lens%of_joint - earlier%of_joint))
      if (lens%is_near_joint .and. earlier%is_near_joint) change = max(change, joints_matter*abs(lens%angle &
         - earlier%angle))
      if (any(earlier%near .neqv. lens%near)) change = 1
      if (any(earlier%near .neqv. lens%near) .or. .not. any(lens%near)) return
      change = max(change, maxval(abs(lens%share - earlier%share)), maxval(abs(lens%bend/earlier%bend - 1)), &
         abs(lens%cosine - earlier%cosine))
   end function change_of_cut

   !> How much what places along the wires leave of a crossing has changed.
   pure real(dp) function change_of_cylinders(earlier, point) result(change)
      type(contact_point_t), intent(in) :: earlier, point

      change = abs(point%weight*point%lens%share(1, 1) - earlier%weight*earlier%lens%share(1, 1))
   end function change_of_cylinders

   !> How much the energies of the shapes have changed, which all of the contact goes with.
   pure real(dp) function change_of_energies(earlier, lens) result(change)
      type(cut_lens_t), intent(in) :: earlier, lens

      change = 0
      if (.not. (earlier%has_energies .and. lens%has_energies)) return
      change = joints_matter*max(maxval(abs(lens%energy/earlier%energy - 1)), maxval(abs(lens%extent - earlier%extent)))
   end function change_of_energies

   !> How much the law of a crossing has changed: its share, and the sine that it sees.
   pure real(dp) function change_of_law(earlier, point) result(change)
      type(contact_point_t), intent(in) :: earlier, point

      change = max(abs(point%weight - earlier%weight), abs(point%section_share - earlier%section_share), &
         abs(point%lens_share - earlier%lens_share))
      if (earlier%lens_sine > 0) change = max(change, sine_matters*point%weight*point%lens_share &
         *abs(point%lens_sine/earlier%lens_sine - 1))
   end function change_of_law

end module litz_share_changes
