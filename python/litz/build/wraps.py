"""Tapes wound around the bundles of a cable, and how current passes from bundle to bundle through them."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from ..model import Hertz, Interaction, Material, Model, WireGroup
from ..model.laws import FilmSpot, TableSpot

#: Forces per length of the tables, in powers of ten [N/m]: from less than strands of micrometres weigh to more than strands bear
_POWERS = np.linspace(-4, 8, 37)
#: pi times half width over thickness, from which edges of strips do not see each other to the last digit
_WIDE = 36.0


@dataclass(frozen=True)
class Wrap:
    """A thin tape of a metal that conducts badly, wound around each bundle of the last stage of a cable.

    Attributes
    ----------
    thickness : float
        Of the tape [m].
    resistivity : float
        Of its metal [ohm m], at the temperature of the run.
    cover : float
        Part of the surface of a bundle that is under the tape, greater than 0, at most 1.
    film : float
        What separates a strand from the tape: resistance times area [ohm m^2].
    young, poisson : float
        Of the tape [Pa], [-].

    Notes
    -----
    Where strands of two bundles touch, no tape, one or two lie between them: the tapes of different bundles are taken as
    independent of each other, so that `cover` c makes that (1 - c)^2, 2 c (1 - c) and c^2 of all places, and conductances per
    length are the mean with these weights. Bare strands have the film of their own interaction over Hertz's strip, of two
    strands. A strand on a tape has a strip of a half width b with the elasticity of both, the film, and the tape, through
    which the current spreads from strip to opposite strip: `resistivity` times K'(k)/K(k), with the complete elliptic
    integrals and k = tanh(pi b/t) for tapes of the thickness t in all. Resistances to the strands within are small beside these.

    Tapes are infinitely thin for motions: bundles lie on each other as without, and nothing is held together by a tape.
    Along itself a tape carries no current, and heat passes as if there were none.

    Examples
    --------
    >>> steel = Wrap(thickness=0.1e-3, resistivity=5.3e-7, cover=0.5)
    >>> f"{1e9 / steel.through(10e-6, tapes=2):.0f} nohm m through two tapes, from strips 20 micrometres wide"
    '1093 nohm m through two tapes, from strips 20 micrometres wide'
    """

    thickness: float
    resistivity: float
    cover: float = 1.0
    film: float = 0.0
    young: float = 200e9
    poisson: float = 0.3

    def __post_init__(self) -> None:
        """Checks the values."""
        for name in ("thickness", "resistivity", "young"):
            if not (math.isfinite(getattr(self, name)) and getattr(self, name) > 0):
                raise ValueError(f"the {name} of a wrap must be greater than 0, not {getattr(self, name):g}")
        if not 0 < self.cover <= 1:
            raise ValueError(f"the cover of a wrap is a part greater than 0 and at most 1, not {self.cover:g}")
        if not (math.isfinite(self.film) and self.film >= 0):
            raise ValueError(f"the film of a wrap must not be negative, found {self.film:g}")
        if not -1 < self.poisson <= 0.5:
            raise ValueError(f"the poisson of a wrap must be greater than -1 and at most 0.5, not {self.poisson:g}")

    def through(self, half_width: float, tapes: int) -> float:
        """Conductance per length of one or two tapes between two strips that lie opposite each other [S/m].

        Parameters
        ----------
        half_width : float
            Of the strips [m].
        tapes : int
            Number of tapes between them, 1 or 2.
        """
        wide = math.pi * half_width / (tapes * self.thickness)
        if wide < _WIDE:
            squares = _mean(1.0, math.tanh(wide)) / _mean(1.0, 1 / math.cosh(wide))
        else:
            squares = 2 / math.pi * (wide + math.log(2))
        spreads = self.resistivity / squares
        return 1 / (spreads + 2 * self.film / (2 * half_width))

    def between(self, force: float, radius: float, compliance: float, strand_film: float) -> float:
        """Conductance per length between strands of two bundles [S/m].

        Parameters
        ----------
        force : float
            Per length [N/m].
        radius : float
            Of the strands [m].
        compliance : float
            (1 - poisson^2)/young of the strands [1/Pa].
        strand_film : float
            What separates bare strands [ohm m^2].
        """
        c = self.cover
        bare = (1 - c) ** 2
        total = bare * 2 * _half_width(force, radius / 2, 2 * compliance) / strand_film if bare > 0 else 0.0
        strip = _half_width(force, radius, compliance + (1 - self.poisson**2) / self.young)
        return total + 2 * c * (1 - c) * self.through(strip, 1) + c**2 * self.through(strip, 2)


def wrap_bundles(model: Model, wrap: Wrap | Interaction, interaction: Interaction, bundles: int) -> Interaction:
    """Let the strands of different bundles touch through tapes; the laws by which they do.

    Parameters
    ----------
    model : Model
        A cable with element sets BUNDLE1, BUNDLE2, ... whose strands touch each other already.
    wrap : Wrap or Interaction
        The tape, or all laws between the bundles.
    interaction : Interaction
        The laws within the bundles.
    bundles : int
        Number of bundles.
    """
    if bundles < 2:
        raise ValueError("a wrap is between the bundles of the last stage, of which there must be two or more")
    laws = wrap if isinstance(wrap, Interaction) else _laws(wrap, interaction, list(model.groups.values()))
    if laws.name == interaction.name:
        laws = replace(laws, name="WRAP" if interaction.name != "WRAP" else "WRAP_2")
    for first, second in combinations(range(1, bundles + 1), 2):
        model.contact(f"BUNDLE{first}", f"BUNDLE{second}", interaction=laws)
    return laws


def _laws(wrap: Wrap, interaction: Interaction, groups: list[WireGroup]) -> Interaction:
    """The laws between strands of wrapped bundles, those of all strands taken together."""
    own = interaction.conductance
    if not isinstance(interaction.behaviour, Hertz) or interaction.behaviour.yield_stress is not None:
        raise ValueError(
            "a Wrap is for elastic strands, Hertz(); give the laws between bundles as an Interaction instead"
        )
    if wrap.cover < 1 and not isinstance(own, FilmSpot):
        raise ValueError(
            f"where a wrap of the cover {wrap.cover:g} is not, strands touch each other, by a FilmSpot; the interaction has "
            f"{own!r}. Give it a FilmSpot, the wrap a cover of 1, or the laws between bundles as an Interaction instead"
        )
    number = np.array([len(group.wires) for group in groups])
    radius = float(np.average([group.radius for group in groups], weights=number))
    compliance = float(np.average([_compliance(group.material) for group in groups], weights=number))
    film = own.film_resistivity if isinstance(own, FilmSpot) else 0.0
    forces: NDArray = 10.0**_POWERS
    resistance = [1 / wrap.between(force, radius, compliance, film) for force in forces.tolist()]
    options = {"spot": own.spot, "voltage": own.voltage} if own is not None else {}
    return replace(
        interaction, name="WRAP", conductance=TableSpot(forces.tolist(), resistance, per_length=True, **options)
    )


def _compliance(material: Material) -> float:
    """(1 - poisson^2)/young [1/Pa]."""
    return float((1 - material.poisson**2) / material.young)


def _half_width(force: float, radius: float, compliance: float) -> float:
    """Of Hertz's strip between cylinders [m]. Source: K. L. Johnson, Contact Mechanics, (4.43).

    Parameters
    ----------
    force : float
        Per length [N/m].
    radius : float
        1/(1/R1 + 1/R2) [m].
    compliance : float
        Sum of (1 - poisson^2)/young of both [1/Pa].
    """
    return math.sqrt(4 * force * radius * compliance / math.pi)


def _mean(a: float, b: float) -> float:
    """The arithmetic-geometric mean of two numbers."""
    while abs(a - b) > 1e-15 * a:
        a, b = (a + b) / 2, math.sqrt(a * b)
    return a
