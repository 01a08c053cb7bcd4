"""Films of nanowires between two electrodes."""

import math

import numpy as np

from ..model import HERTZ_AND_HOLM, SILVER, Interaction, Material, Model
from .deposition import SLACK, Rules, build, check_reach, drop, pile_up
from .geometry import sides

#: Minimum distance of the end of a wire from any other wire, seen from above [radii]
_MARGIN = 4.0


def nanowire_film(
    size: tuple[float, float],
    n_wires: int,
    *,
    length: float,
    radius: float,
    seed: int,
    reach: float | None = None,
    clearance: float | None = None,
    smallest_angle: float = math.radians(15),
    n_elements: int | None = None,
    material: Material = SILVER,
    interaction: Interaction = HERTZ_AND_HOLM,
    element: str = "B33",
) -> Model:
    """Nanowires dropped at random on a plane, with an electrode at each end of the film.

    Centres and directions in the plane are uniform. Each wire comes to lie above all wires dropped before that it crosses:
    level, or bent over them. No end lies on another wire: it is four radii away, seen from above, for which wires get a little
    shorter or longer. Wires are cut where they leave the film; the cut ends at x = 0 and x = size[0] are the electrodes. All ends
    are held in the plane and follow a pressing according to their height (`model.press`).

    Parameters
    ----------
    size : tuple of float
        Length along x, between the electrodes, and width along y [m].
    n_wires : int
        Number of wires.
    length, radius : float
        Length of a wire that is not cut, and its radius [m].
    seed : int
        Seed of the random numbers: the same seed and arguments give the same model.
    reach : float, optional
        Length over which a wire bends down from one that it lies on [m], at least ten radii: the shorter, the more crossings
        touch. Left out: wires stay level.
    clearance : float, optional
        Gap where a wire lies on another one [m]; a hundredth of the radius when left out.
    smallest_angle : float
        Wires that cross do so at this angle or more [rad], others are dropped anew: contacts are points.
    n_elements : int, optional
        Elements of each wire. Left out: 12 of level wires, and of others as many as are not longer than half the reach.
    material, interaction, element
        What the wires are made of, the laws of their contacts, type of the elements.

    Returns
    -------
    Model
        Group FILM; node sets MINUS (x = 0) and PLUS (x = size[0]). `model.comments` say how many crossings touch.

    Raises
    ------
    ValueError
        For arguments out of range, when the wires do not fit, and when an electrode touches no wire.

    Notes
    -----
    Level wires that lie directly on each other touch first, others the later the more levels are between them: a film conducts
    well when it is pressed by 0.8 to 0.95 of `model.height`. Nearly flat it becomes stiff, and a run may give up.

    With `reach` wires are elastic beams that springs draw to the ground: `a = (4 E I/k)^(1/4)`, with the stiffness k per length
    of
    what draws them there, such as a liquid that dries.

    Wires that would cross at less than the smallest angle are dropped anew, which makes crossings rarer: see `litz.percolation`
    for what that does to the threshold.

    Spots of nanowires are smaller than the mean free path of the electrons, 53 nm in silver. Their resistance is then that of
    Sharvin, `4 rho l/(3 A)` for the area A, where the product of resistivity and free path, `rho l`, is a constant
    of the metal: 8.46e-16 ohm m^2 for silver (Gall, J. Appl. Phys. 119, 085101, 2016). That is the law of a film:
    `litz.FilmSpot(4 / 3 * 8.46e-16)`; `HertzSpot` alone gives a small part of it.

    Examples
    --------
    >>> import litz
    >>> spots = litz.Interaction("TOUCH", conductance=litz.FilmSpot(4 / 3 * 8.46e-16))
    >>> film = nanowire_film((20e-6, 20e-6), 40, length=10e-6, radius=30e-9, seed=1, interaction=spots)
    >>> step = film.press(0.9 * film.height, voltage=1e-3)
    """
    box = sides(size, "xy", "a film")
    if n_wires < 1 or not radius > 0 or not length > 4 * radius or not min(box) > 4 * radius:
        raise ValueError("a film needs wires of positive radius; wires and film must be longer than two diameters")
    clearance = radius / 100 if clearance is None else clearance
    if not clearance > 0:
        raise ValueError(f"clearance must be greater than 0, not {clearance:g}")
    check_reach(reach, radius, length)
    if not 0 <= smallest_angle < math.pi / 2:
        raise ValueError(f"smallest_angle must be at least 0 and less than a right angle [rad], not {smallest_angle:g}")
    rules = Rules(box, length, radius, smallest_angle, _MARGIN * radius)
    layout = drop(np.random.default_rng(seed), n_wires, rules)
    return build(
        f"Film of {n_wires} nanowires, seed {seed}",
        "FILM",
        lambda gap: pile_up(layout, 2 * radius + gap, SLACK * clearance, reach, n_elements),
        clearance=clearance,
        length=size[0],
        rounding=max(size),
        interaction=interaction,
        radius=radius,
        material=material,
        element=element,
    )
