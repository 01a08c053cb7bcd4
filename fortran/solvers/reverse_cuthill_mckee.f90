!> Profile-reducing order of the equations.
!>
!> Source: E. Cuthill, J. McKee, Proc. 24th ACM National Conference (1969) 157; reversed: A. George, Stanford
!> STAN-CS-71-208 (1971); start from a pseudo-peripheral vertex: A. George, J. W. H. Liu, ACM TOMS 5 (1979) 284.
module litz_reverse_cuthill_mckee
   use litz_linear_solver, only: csr_matrix_t
   implicit none
   private
   public :: reverse_cuthill_mckee

contains

   !> `order(new) = old`: breadth first from one end of each connected part, neighbours of low degree first, reversed.
   pure subroutine reverse_cuthill_mckee(graph, order)
      !> Structurally symmetric pattern
      type(csr_matrix_t), intent(in) :: graph
      !> (n_rows)
      integer, intent(out) :: order(:)
      !> Breadth-first level of each vertex; 0: not reached
      integer :: level(graph%n_rows)
      integer :: vertex, end_vertex, done, last

      level = 0
      done = 0
      do vertex = 1, graph%n_rows
         if (level(vertex) > 0) cycle
         call find_peripheral_vertex(graph, vertex, done, level, order, end_vertex)
         call number_from(graph, end_vertex, done, level, order, last)
         done = last
      end do
      order = order(graph%n_rows:1:-1)
   end subroutine reverse_cuthill_mckee

   !> A vertex nearly as far from the others as can be: the least connected one of the last level, until the number of
   !> levels grows no more.
   pure subroutine find_peripheral_vertex(graph, start, done, level, order, vertex)
      type(csr_matrix_t), intent(in) :: graph
      !> Vertex to begin with
      integer, intent(in) :: start
      !> Vertices numbered before; `order` is scratch beyond, `level` comes back as it was
      integer, intent(in) :: done
      !> Breadth-first level of each vertex, from 1 (n); 0: not reached. Comes back as it was
      integer, intent(inout) :: level(:)
      !> Vertices in the order of their numbers (n); scratch beyond `done`
      integer, intent(inout) :: order(:)
      !> The vertex that was found, of the part of the graph that `start` belongs to
      integer, intent(out) :: vertex
      integer :: candidate, height, last, k

      candidate = start
      height = 0
      do
         call number_from(graph, candidate, done, level, order, last)
         vertex = candidate
         k = level(order(last))
         if (k > height) candidate = least_connected_of_last_level(graph, level, order(done + 1:last))
         level(order(done + 1:last)) = 0
         if (k <= height) return
         height = k
      end do
   end subroutine find_peripheral_vertex

   pure integer function least_connected_of_last_level(graph, level, vertices) result(vertex)
      type(csr_matrix_t), intent(in) :: graph
      !> Breadth-first level of each vertex, from 1 (n); 0: not reached
      integer, intent(in) :: level(:)
      !> Vertices (n) in the order of their levels
      integer, intent(in) :: vertices(:)
      integer :: k

      vertex = vertices(size(vertices))
      do k = size(vertices) - 1, 1, -1
         if (level(vertices(k)) < level(vertex)) return
         if (degree(graph, vertices(k)) < degree(graph, vertex)) vertex = vertices(k)
      end do
   end function least_connected_of_last_level

   !> Breadth-first numbering of the part of the graph that `start` belongs to, into `order(done+1:last)`.
   pure subroutine number_from(graph, start, done, level, order, last)
      type(csr_matrix_t), intent(in) :: graph
      !> Vertex to begin with
      integer, intent(in) :: start
      !> Number of vertices numbered before, which stand in `order(:done)`
      integer, intent(in) :: done
      !> Breadth-first level of each vertex, from 1 (n); 0: not reached
      integer, intent(inout) :: level(:)
      !> Vertices in the order of their numbers (n)
      integer, intent(inout) :: order(:)
      !> Number of vertices numbered with these
      integer, intent(out) :: last
      integer :: current, first_new, k, neighbour

      last = done + 1
      order(last) = start
      level(start) = 1
      current = done
      do while (current < last)
         current = current + 1
         first_new = last + 1
         do k = graph%row_start(order(current)), graph%row_start(order(current) + 1) - 1
            neighbour = graph%column(k)
            if (level(neighbour) > 0) cycle
            level(neighbour) = level(order(current)) + 1
            last = last + 1
            order(last) = neighbour
         end do
         call sort_by_degree(graph, order(first_new:last))
      end do
   end subroutine number_from

   !> Ascending degree, equal degrees in the order they came (insertion: a vertex has few new neighbours).
   pure subroutine sort_by_degree(graph, vertices)
      type(csr_matrix_t), intent(in) :: graph
      !> Vertices (n) to be sorted in place
      integer, intent(inout) :: vertices(:)
      integer :: i, j, vertex

      do i = 2, size(vertices)
         vertex = vertices(i)
         do j = i - 1, 1, -1
            if (degree(graph, vertices(j)) <= degree(graph, vertex)) exit
            vertices(j + 1) = vertices(j)
         end do
         vertices(j + 1) = vertex
      end do
   end subroutine sort_by_degree

   pure integer function degree(graph, vertex)
      type(csr_matrix_t), intent(in) :: graph
      !> The vertex whose neighbours are counted
      integer, intent(in) :: vertex

      degree = graph%row_start(vertex + 1) - graph%row_start(vertex)
   end function degree

end module litz_reverse_cuthill_mckee
