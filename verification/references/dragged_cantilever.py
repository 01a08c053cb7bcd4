"""A cantilever dragged across another one: stick, then slip, with the force of a semi-analytic solution.

The lower wire lies along x, clamped at x = 0, and touches the upper one at `a` from its clamp; the upper wire lies along
y, its clamp at `b` from the crossing. The clamp of the upper wire goes down by `w`, then moves by `u` along x. Small
deflections of straight beams:

- height: the wires bend by V (c_l + c_u) and approach each other by Hertz's delta(N). The friction T acts between the
  surfaces, a radius r above the lower axis and below the upper one: it bends the lower wire down by T r a^2/(2 E I) and
  stiffens it as its tension, c_l = a^3/(3 E I) (1 - 2 T a^2/(5 E I)). It leans with the slope theta of the lower wire:
  V = N + T theta;
- along x: the upper wire gives way by c_u times the force on it, -T + N theta, as the normal of the contact leans with
  the slope theta of the lower wire, and T twists it, so that its surface gives way by r^2 b/(G J) T besides. The slip s
  is what its axis moves, and what the lower wire draws back as it bends by f, 3 f^2/(5 a), less the radius times the
  slope, by which the surface of the lower wire goes along; it takes the contact to a + s.
- friction: T = T_0 + k_t (s - s_0) while |T| <= mu N, and |T| = mu N in slip, along the slip. It acts from first touch:
  while the clamp goes down the contact sticks, and holds the wires back by the same T along both. The part across the
  way, to which the wires give way alike (b = a), stays until the contact slips, and then fades as they spring back
  across: c dT_y = -ds T_y/|T_x|.

Each branch is solved by fixed-point iteration, which contracts by better than 1/30 a turn.
"""

import math
from dataclasses import dataclass

#: Steps of the clamp in which slip is followed [m]: the friction across the way fades over c mu N, 30 microns
LONGEST_STEP = 1e-7


@dataclass(frozen=True)
class DraggedCantilever:
    """Two equal wires; lengths [m], stiffness E I and G J [N m^2], approach delta = `hertz` N^(2/3) [m]."""

    a: float
    b: float
    ei: float
    gj: float
    radius: float
    hertz: float
    #: Tangential over normal stiffness of the contact, 2 (1 - nu)/(2 - nu) (Mindlin)
    stick_ratio: float
    mu: float
    w: float

    @property
    def sideways(self):
        """What the surface of the upper wire gives way by under a force on it along x [m/N]."""
        return self.b**3 / (3 * self.ei) + self.radius**2 * self.b / self.gj

    def normal_force(self, slip, traction):
        """N for a contact that has slipped, under friction."""
        a, ei = self.a + slip, self.ei
        compliance = (a**3 * (1 - 2 * traction * a**2 / (5 * ei)) + self.b**3) / (3 * ei)
        force = self.w / compliance
        for _ in range(12):
            lowered = self.w - traction * self.radius * a**2 / (2 * ei)
            vertical = (lowered - self.hertz * force ** (2 / 3)) / compliance
            force = vertical - traction * self.slope(a, vertical, traction)
        return force

    def slope(self, a, force, traction):
        """Slope of the lower wire at the contact, downwards."""
        return (force * a**2 / 2 + traction * self.radius * a) / self.ei

    def lean(self, slip, traction):
        """Force along x on the upper wire from the lean of the normal."""
        force, a = self.normal_force(slip, traction), self.a + slip
        return force * self.slope(a, force, traction)

    def free_slip(self, u, slip, traction):
        """Slip without the part that the upper wire gives way under friction."""
        lean = self.b**3 / (3 * self.ei) * self.lean(slip, traction)
        force, a = self.normal_force(slip, traction), self.a + slip
        turn = self.radius * self.slope(a, force, traction)
        shortening = 3 * (force * a**3 / (3 * self.ei)) ** 2 / (5 * a)
        return u + lean - turn + shortening

    def pressed(self):
        """Slip and traction along each wire when the clamp is down: stuck since the wires have touched."""
        return self.stuck(0.0, 0.0, 0.0)

    def path(self, displacements):
        """Friction and force on the upper support at each of `displacements` of it, which begin at 0 or near it."""
        slip, traction = self.pressed()
        across, u_before, forces = traction, 0.0, []
        for u in displacements:
            count = max(1, math.ceil(abs(u - u_before) / LONGEST_STEP))
            for i in range(1, count + 1):
                slip, traction, across = self.step(u_before + (u - u_before) * i / count, slip, traction, across)
            u_before = u
            forces.append((traction, traction - self.lean(slip, traction)))
        return forces

    def stuck(self, u, slip_before, traction_before):
        """Slip and traction along the way after the support has moved to u, for a contact that sticks."""
        c = self.sideways
        slip, traction = slip_before, traction_before
        for _ in range(25):
            force = self.normal_force(slip, traction)
            stiffness = self.stick_ratio * 1.5 * force ** (1 / 3) / self.hertz
            free = self.free_slip(u, slip, traction)
            # T = T_0 + k (s - s_0), s = free - c T
            traction = (traction_before + stiffness * (free - slip_before)) / (1 + stiffness * c)
            slip = free - c * traction
        return slip, traction

    def step(self, u, slip_before, traction_before, across_before):
        """Slip, traction along the way and across it after the support has moved to u: stuck, or else slipped."""
        c = self.sideways
        slip, traction = self.stuck(u, slip_before, traction_before)
        if math.hypot(traction, across_before) <= self.mu * self.normal_force(slip, traction):
            return slip, traction, across_before
        sign = 1 if traction > 0 else -1
        across = across_before
        for _ in range(25):
            limit = self.mu * self.normal_force(slip, traction)
            # the slip is along the traction: across the way the upper wire is stiff, the lower one gives way by c T
            across = across_before / (1 + abs(slip - slip_before) / (c * abs(traction)))
            traction = sign * math.sqrt(limit**2 - across**2)
            slip = self.free_slip(u, slip, traction) - c * traction
        return slip, traction, across
