"""Two strands with one joint between them, as a circuit of five resistances.

Both strands, of the resistances r_1 and r_2 per length [ohm/m], are at one potential at their far ends. The joint, of the
resistance R [ohm], lies at the distance a_1 and a_2 from their near ends, and b_1 and b_2 from the far ones [m].

Source: Kirchhoff's laws (G. Kirchhoff, Ann. Phys. 140 (1845) 497-514).
"""

from dataclasses import dataclass


@dataclass(frozen=True)
class TwoStrands:
    """Resistances per length [ohm/m], of the joint [ohm]; distances of the joint from the near and the far ends [m]."""

    per_length: tuple
    joint: float
    near: tuple
    far: tuple

    def between(self):
        """From the near end of one strand to that of the other, the far ends by themselves [ohm]."""
        (r1, r2), (a1, a2) = self.per_length, self.near
        return r1 * a1 + self.joint + r2 * a2

    def share(self):
        """Part of a current that enters the first strand at its near end which leaves the second one at its far end."""
        (r1, r2), (b1, b2) = self.per_length, self.far
        return r1 * b1 / (r1 * b1 + self.joint + r2 * b2)

    def resistance(self):
        """From the near end of the first strand to both far ends [ohm]."""
        direct, detour = self.per_length[0] * self.far[0], self.joint + self.per_length[1] * self.far[1]
        return self.per_length[0] * self.near[0] + direct * detour / (direct + detour)
