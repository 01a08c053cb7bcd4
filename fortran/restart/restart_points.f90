!> The memory of the contact points as rows of numbers that go to a restart file or come back from it.
module litz_restart_points
   use litz_contact_history, only: contact_history_t
   use litz_contact_points, only: contact_point_t
   use litz_quantities, only: quantity_table_t
   implicit none
   private
   public :: point_table, points_of_table

contains

   !> The points as rows of numbers, with the names of the columns.
   pure function point_table(points) result(table)
      type(contact_point_t), intent(in) :: points(:)
      type(quantity_table_t) :: table
      type(contact_point_t) :: point
      integer :: i

      call list_point(table, point)
      call table%begin_storing(size(points))
      do i = 1, size(points)
         point = points(i)
         call table%next_row()
         call list_point(table, point)
      end do
   end function point_table

   !> The points that a table was made of.
   pure subroutine points_of_table(table, points)
      type(quantity_table_t), intent(inout) :: table
      type(contact_point_t), allocatable, intent(out) :: points(:)
      integer :: i

      call table%begin_restoring()
      allocate (points(size(table%reals, 2)))
      do i = 1, size(points)
         call table%next_row()
         call list_point(table, points(i))
      end do
   end subroutine points_of_table

   !> What the next increment needs of a contact: its place, its memory, and how it stood.
   pure subroutine list_point(table, point)
      type(quantity_table_t), intent(inout) :: table
      type(contact_point_t), intent(inout) :: point

      call table%field('id', point%id)
      call table%field('element_bar', point%element_bar)
      call table%field('element', point%element)
      call table%field('pair', point%pair)
      call table%field('closed', point%closed)
      call table%field('line_place', point%line_place)
      call table%field('held_bar', point%held(1))
      call table%field('held', point%held(2))
      call table%field('xi_bar', point%xi_bar)
      call table%field('xi', point%xi)
      call table%field('arc_bar', point%arc_bar)
      call table%field('arc', point%arc)
      call table%field('gap', point%gap)
      call table%field('fit', point%fit)
      call table%field('distance_gap', point%kinematics%gap)
      call table%field('normal', point%kinematics%normal)
      call table%field('side', point%kinematics%side)
      call table%field('angle', point%kinematics%angle)
      call table%field('force', point%force)
      call table%field('energy', point%at_gap%energy)
      call table%field('held_energy', point%held_energy)
      call table%field('held_angle', point%held_angle)
      call table%field('traction', point%traction)
      call list_shares(table, point)
      call list_history(table, point%history)
   end subroutine list_point

   !> What of the contact it carries, at a crossing or along a line, and by which law.
   pure subroutine list_shares(table, point)
      type(quantity_table_t), intent(inout) :: table
      type(contact_point_t), intent(inout) :: point

      call table%field('weight', point%weight)
      call table%field('line_share', point%line_share)
      call table%field('reach_back', point%cell%reach(1))
      call table%field('reach_on', point%cell%reach(2))
      call table%field('shared_overlap', point%shared_overlap)
      call table%field('long_share', point%long_share)
      call table%field('section_share', point%section_share)
      call table%field('in_lens', point%in_lens)
      call table%field('spot_section', point%spot_section)
      call table%field('kept_overlap', point%kept_overlap)
      call table%field('deepest', point%deepest)
      call table%field('lens_depth', point%lens_depth)
      call table%field('lens_has_dent', point%lens_has_dent)
      call table%field('lens_share', point%lens_share)
      call table%field('lens_sine', point%lens_sine)
      call table%field('lens_quality_bar', point%lens_quality(1))
      call table%field('lens_quality', point%lens_quality(2))
      call table%field('angle_element_bar', point%angle_element(1))
      call table%field('angle_element', point%angle_element(2))
      call table%field('fixed_share', point%fixed_share)
      call table%field('angle_at_bar', point%angle_at(1))
      call table%field('angle_at', point%angle_at(2))
      call table%field('knows_bends', point%bends%are_known)
      call table%field('curvature_bar', point%bends%curvature(1))
      call table%field('curvature', point%bends%curvature(2))
      call table%field('energy_by_curvature_bar', point%bends%by_curvature(1))
      call table%field('energy_by_curvature', point%bends%by_curvature(2))
      call table%field('axis_curvature_bar', point%bends%of_axes(1))
      call table%field('axis_curvature', point%bends%of_axes(2))
      call table%field('curvature_ratio', point%bends%ratio)
      call table%field('takes_equal_radii', point%bends%as_equal)
      call table%field('bends_change_bar', point%bends_seen%change(:, 1))
      call table%field('bends_change', point%bends_seen%change(:, 2))
      call table%field('bends_part_bar', point%bends_seen%part(1))
      call table%field('bends_part', point%bends_seen%part(2))
      call table%field('bends_place_bar', point%bends_seen%place(1))
      call table%field('bends_place', point%bends_seen%place(2))
      call table%field('energy_ratio', point%energy_ratio)
      call table%field('lacking_torque', point%lacking_torque)
      call table%field('lacking_torque_of_places', point%lacking_torque_of_places)
      call table%field('torque_of_dents', point%torque_of_dents)
      call table%field('law_angle', point%law_angle)
      call table%field('law_sine', point%law_sine)
      call table%field('law_status', point%law_status)
      call list_lens(table, point)
   end subroutine list_shares

   !> How ends cut its overlap.
   pure subroutine list_lens(table, point)
      type(quantity_table_t), intent(inout) :: table
      type(contact_point_t), intent(inout) :: point
      character(len=*), parameter :: wire(2) = ['_bar', '    '], shape(2) = ['cylinder', 'end     ']
      integer :: i, j

      associate (lens => point%lens)
         call table%field('lens_known', lens%is_known)
         call table%field('lens_has_energies', lens%has_energies)
         call table%field('lens_cosine', lens%cosine)
         call table%field('lens_angle', lens%angle)
         call table%field('lens_distance', lens%distance)
         call table%field('lens_near_joint', lens%is_near_joint)
         call table%field('lens_of_crossing', lens%of_crossing)
         call table%field('lens_of_wedge', lens%of_wedge)
         call table%field('lens_beside_places', lens%beside_places)
         do i = 1, 2
            call table%field('lens_near'//trim(wire(i)), lens%near(i))
            call table%field('lens_side'//trim(wire(i)), lens%side(i))
            call table%field('lens_bend'//trim(wire(i)), lens%bend(i))
            call table%field('lens_extent'//trim(wire(i)), lens%extent(i))
            call table%field('lens_spot_of_end'//trim(wire(i)), lens%spot_of_end(i))
            call table%field('lens_receding'//trim(wire(i)), lens%receding(i))
            call table%field('lens_own_bend'//trim(wire(i)), lens%own_bend(i))
            call table%field('legs_at_joint'//trim(wire(i)), lens%of_joint(1, i))
            call table%field('joint'//trim(wire(i)), lens%of_joint(2, i))
            call table%field('legs_mixed'//trim(wire(i)), lens%is_mixed(i))
            call table%field('legs_young'//trim(wire(i)), lens%young(i))
            call table%field('of_ball'//trim(wire(i)), lens%of_ball(i))
            call table%field('legs_poisson'//trim(wire(i)), lens%poisson(i))
            do j = 1, 2
               associate (name => '_'//trim(shape(i))//'_'//trim(shape(j)))
                  call table%field('lens_energy'//name, lens%energy(i, j))
                  call table%field('lens_share'//name, lens%share(i, j))
                  call table%field('force_part'//name, point%force_part(i, j))
               end associate
            end do
         end do
      end associate
      call table%field('stiff_part', point%stiff_part)
      call table%field('cut', point%cut)
      call table%field('cut_stiffness', point%cut_stiffness)
      call table%field('place_bar', point%place(1))
      call table%field('dweight_dlap', point%lap%dweight)
      call table%field('d2weight_dlap2', point%lap%d2weight)
      call table%field('lap_course', point%lap%of_course)
      call table%field('dlap_course', point%lap%dof_course)
      call table%field('lap_force', point%lap%force)
      call table%field('lap_stiffness', point%lap%stiffness)
      call table%field('strip_bound', point%lap%strip_bound)
      call table%field('dstrip_bound_dlap', point%lap%dstrip_bound)
      call table%field('round_end_share', point%lap%round_end%share)
      call table%field('round_end_distance', point%lap%round_end%distance)
      call table%field('round_end_beyond', point%lap%round_end%beyond)
      call table%field('round_end_dbeyond', point%lap%round_end%dbeyond)
      call table%field('settled_weight', point%settled_weight)
   end subroutine list_lens

   pure subroutine list_history(table, history)
      type(quantity_table_t), intent(inout) :: table
      type(contact_history_t), intent(inout) :: history

      call table%field('was_closed', history%closed)
      call table%field('converged_arc_bar', history%arc(1))
      call table%field('converged_arc', history%arc(2))
      call table%field('converged_force', history%force)
      call table%field('weight_of_force', history%weight)
      call table%field('traction_1', history%traction(1))
      call table%field('traction_2', history%traction(2))
      call table%field('reverses', history%reverses)
      call table%field('slips', history%slips)
      call table%field('slip_path', history%slip_path)
      call table%field('dissipation', history%dissipation)
      call table%field('last_dissipation', history%last_dissipation)
      call table%field('ploughing', history%ploughing)
      call table%field('elastic_energy', history%elastic_energy)
      call table%field('largest_force', history%largest_force)
      call table%field('spot_arc_bar', history%spot_arc(1))
      call table%field('spot_arc', history%spot_arc(2))
      call table%field('spot_ratio', history%spot_shape%ellipse%ratio)
      call table%field('spot_semi_major', history%spot_shape%ellipse%semi_major)
      call table%field('spot_approach', history%spot_shape%ellipse%approach)
      call table%field('spot_modulus', history%spot_shape%ellipse%modulus)
      call table%field('spot_sine', history%spot_shape%sine)
      call table%field('spot_overlap', history%spot_shape%overlap)
      call table%field('spot_part', history%spot_shape%part)
      call table%field('spot_uncut_force', history%spot_shape%uncut_force)
      call table%field('dent_force', history%dent%force)
      call table%field('dent_arc_bar', history%dent%arc(1))
      call table%field('dent_arc', history%dent%arc(2))
      call table%field('dent_overlap', history%dent%overlap)
      call table%field('dent_left', history%dent%left)
      call table%field('dent_felt', history%dent%felt)
      call table%field('dent_dissipation', history%dent%dissipation)
      call table%field('dent_section_share', history%dent%section_share)
      call table%field('slow_heat_bar', history%settled_heat(1, 1))
      call table%field('fast_heat_bar', history%settled_heat(2, 1))
      call table%field('slow_heat', history%settled_heat(1, 2))
      call table%field('fast_heat', history%settled_heat(2, 2))
   end subroutine list_history

end module litz_restart_points
