"""The contact spot of two wires: from force to conductance."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import _core
from . import checks
from .batch import Batch, Floats
from .laws import CONDUCTANCE_LAWS, SPOT_FIELDS, SPOT_LAWS, SPOT_NEEDED, law_data, law_per_spot
from .wire_pair import Numbers, take_properties
from .yielding import refuse, refuse_wide, take_crossing_angle, take_yielding

#: "none", or the name of a law of `*GAP ELECTRICAL CONDUCTANCE` in lower case
SpotLaw = str

#: Spot laws that have the ellipse of the mechanics, elastic or not
_ELASTIC_SPOTS = ("hertz", "film")
_SPOT_LAWS = {"none": 0} | SPOT_LAWS
#: The argument that has the numbers of each spot law that has some: one of its own, or `law_value`
_LAW_VALUES = {
    **{law: "law_value" for law, fields in SPOT_FIELDS.items() if fields and law != "table"},
    "plastic": "hardness",
    "film": "film_resistivity",
    "constant": "resistance",
}


class ContactSpot(NamedTuple):
    """Contact spot under a given force; of many contacts each number is an array."""

    #: Larger half axis of the spot [m]; 0 for laws without a spot (constant, table)
    semi_major: float | Floats
    #: Smaller half axis [m]
    semi_minor: float | Floats
    #: Elastic approach of the two axes [m]; 0 for laws without one (plastic, constant, table)
    approach: float | Floats
    #: Conductance of the spot [S]
    conductance: float | Floats
    #: Derivative of the conductance by the force at fixed angle [S/N]
    dconductance_dforce: float | Floats
    #: Derivative of the conductance by the angle at fixed force [S/rad]
    dconductance_dangle: float | Floats


def contact_spot(
    force: Numbers,
    *,
    radius: Numbers,
    young: Numbers,
    poisson: Numbers,
    resistivity: Numbers,
    angle: Numbers,
    law: SpotLaw = "hertz",
    hardness: Numbers | None = None,
    film_resistivity: Numbers | None = None,
    resistance: Numbers | None = None,
    law_value: Numbers | None = None,
    table: ArrayLike | None = None,
    yield_stress: Numbers | None = None,
    largest_force: Numbers = 0.0,
    mean_free_path: Numbers = 0.0,
) -> ContactSpot:
    """Spot and conductance of two round wires pressed together.

    Parameters
    ----------
    force : float or array_like
        Contact force [N]; all arguments that hold numbers may have leading axes, see `litz.kernels`. Without a positive
        force there is no spot: all results are 0, although the slope of the conductance over the force is infinite there
        for most laws.
    radius, young, poisson, resistivity : float or array_like, shape (2,)
        Radii [m], Young's moduli [Pa], Poisson's ratios [-] and resistivities [ohm m] of the barred and the unbarred
        wire; one number serves both.
    angle : float
        Angle between the axes [rad], in (0, pi).
    law : {"hertz", "paper", "plastic", "film", "constant", "table", "sharvin", "cluster", "none"}
        - "hertz": exact ellipse with Holm's constriction resistance ``(rho1 + rho2) K(m)/(2 pi a)``;
        - "paper": circle of Hertz's contact of two spheres, ``r* = r rb/(r + rb)``. At 90 degrees the spot of equal
          wires is 21 % too small and the resistance 26 % too large;
        - "plastic": circle with ``F = pi a^2 hardness``;
        - "film": as "hertz", with ``film_resistivity/(pi a b)`` in series;
        - "constant": `resistance` under any positive force;
        - "table": through the pairs of `table`;
        - "sharvin": as "hertz" or "film", with the resistance of spots that are not large against the mean free path of
          the electrons: `mean_free_path`, or `law_value` with its product with the resistivity, the same in both
          wires, and the film if there is one;
        - "cluster": many plastic spots within the ellipse of "hertz": `law_value` with hardness, number, and the film
          if there is one.
    hardness : float, optional
        For "plastic" [Pa]; with `yield_stress` for "hertz" and "film": see `normal_law`.
    film_resistivity : float, optional
        For "film" [ohm m^2], of both faces together; of a coating its resistivity times its thickness.
    resistance : float, optional
        For "constant" [ohm].
    law_value : float or array_like, optional
        The number, or the numbers, of a law that has no argument of its own among these.
    table : array_like, shape (2, n), optional
        For "table": forces [N], ascending, and resistances [ohm]. Interpolated smoothly and monotonically in
        logarithms; beyond its ends the power law of the end slope continues; a single pair is a constant.
    yield_stress : float or array_like, shape (2,), optional
        For "hertz", "film" and "sharvin": yield stress of each wire [Pa], see `normal_law`. The spot grows as the metal
        yields, and shrinks along another path when the force falls. Without it the wires stay elastic.
    largest_force : float
        With `yield_stress`: largest force that the contact has had [N].
    mean_free_path : float or array_like, shape (2,)
        For "hertz", "film" and "sharvin": mean free path of the electrons in each wire [m]. Spots that are not much larger have
        Sharvin's resistance besides a part of Holm's; 0: only Holm's.

    Returns
    -------
    ContactSpot
        `semi_major`, `semi_minor`, `approach`, `conductance`, `dconductance_dforce`, `dconductance_dangle`.

    Raises
    ------
    ValueError
        A value that is missing, not finite or out of its range; an unknown law.

    Notes
    -----
    K. L. Johnson, Contact Mechanics, ch. 4; R. Holm, Electric Contacts. The elastic contact and the conductance obey
    Barber's identity ``G = 2/(E* (rho1 + rho2)) dF/dapproach`` (Proc. R. Soc. A 459 (2003) 53-66). The formulas are in
    ``fortran/laws``.

    Examples
    --------
    >>> from math import pi
    >>> wires = dict(radius=1e-3, young=120e9, poisson=0.34, resistivity=1.7e-8)
    >>> spot = contact_spot(1.0, angle=pi / 2, **wires)
    >>> print(f"{spot.semi_major:.4g} m, {1 / spot.conductance:.4g} ohm")
    2.228e-05 m, 0.0003816 ohm

    Soft copper yields: its spot is larger, and stays larger when the force falls to a tenth:

    >>> soft = dict(yield_stress=50e6, hardness=450e6, angle=pi / 2, **wires)
    >>> pressed, released = contact_spot(1.0, **soft), contact_spot(0.1, largest_force=1.0, **soft)
    >>> print(f"{1 / pressed.conductance:.4g} ohm, {1 / released.conductance:.4g} ohm")
    0.0002373 ohm, 0.000462 ohm
    """
    if law == "sharvin":
        law, film_resistivity, law_value, mean_free_path = _sharvin_numbers(
            law_value, mean_free_path, film_resistivity, resistivity, yields=yield_stress is not None
        )
    of = Batch()
    of.array("force", force)
    radii = take_properties(of, radius, young, poisson, resistivity)
    take_crossing_angle(of, angle)
    law_number, data = spot_law_data(
        "law",
        law,
        hardness=None if yield_stress is not None and law in _ELASTIC_SPOTS else hardness,
        film_resistivity=film_resistivity,
        resistance=resistance,
        law_value=law_value,
        table=table,
    )
    paths = checks.leading_pair("mean_free_path", mean_free_path)
    if yield_stress is None and not paths.any():
        if np.any(checks.leading("largest_force", largest_force, ())):
            raise ValueError("largest_force needs yield_stress: elastic wires remember none")
        of.share("data of the law", data, 1)
        values, info = of.call(
            [(6,), ()], _core.f2py_contact.contact_spots, law_number, *of.shared_columns(), *of.columns()
        )
        refuse(of, info)
        return ContactSpot(*of.results(values))
    if law not in _ELASTIC_SPOTS:
        names = "yield_stress belongs" if yield_stress is not None else "mean_free_path belongs"
        raise ValueError(f'{names} to the spot laws "hertz" and "film", not to "{law}"')
    take_yielding(of, yield_stress, hardness)
    checks.refuse("mean_free_path", paths, paths < 0, 1, "must not be negative, but holds {value:g}")
    of.take("mean_free_path", paths, 1)
    of.not_negative("film_resistivity", 0.0 if film_resistivity is None else film_resistivity)
    of.not_negative("largest_force", largest_force)
    *most, largest = of.columns()
    values, widest, yield_pressure, info = of.call(
        [(6,), (), (), ()], _core.f2py_yielding.spots_of_forces, most[0], largest, *most[1:]
    )
    refuse(of, info, yield_pressure)
    refuse_wide(of, widest, radii)
    return ContactSpot(*of.results(values))


def _sharvin_numbers(
    law_value: Numbers | None,
    mean_free_path: Numbers,
    film_resistivity: Numbers | None,
    resistivity: Numbers,
    *,
    yields: bool,
) -> tuple[SpotLaw, Numbers | None, Numbers | None, Numbers]:
    """Law, film, data and mean free paths that stand for "sharvin", whose path is given as such or times resistivity."""
    has_path = bool(np.any(mean_free_path))
    if (law_value is None) == (not has_path):
        given = "both are given" if has_path else "neither is given"
        raise ValueError(f'the spot law "sharvin" takes law_value, with rho_l, or mean_free_path: {given}')
    if has_path:
        return ("hertz" if film_resistivity is None else "film"), film_resistivity, None, mean_free_path
    if not yields:
        return "sharvin", film_resistivity, law_value, 0.0
    fields, needed = SPOT_FIELDS["sharvin"], SPOT_NEEDED["sharvin"]
    numbers = law_data('the spot law "sharvin"', "law_value", {"law_value": law_value}, fields, needed)
    paths = numbers[..., :1] / checks.leading_pair("resistivity", resistivity)
    return ("film", numbers[..., 1], None, paths) if numbers.shape[-1] > 1 else ("hertz", None, None, paths)


def spot_law_data(
    parameter: str, law: SpotLaw, *, table: ArrayLike | None, **values: Numbers | None
) -> tuple[int, NDArray[np.float64]]:
    """Number of a spot law and its data; refuses data that belong to another law."""
    number = law_per_spot(parameter, law, _SPOT_LAWS, CONDUCTANCE_LAWS)
    wanted = _LAW_VALUES.get(law)
    for name, value in values.items():
        if value is not None and name != wanted:
            owners = [f'"{key}"' for key, needed in _LAW_VALUES.items() if needed == name]
            owner = f"the spot law {owners[0]}" if owners else "other laws"
            raise ValueError(f'{name} belongs to {owner}, not to "{law}"')
    if table is not None and law != "table":
        raise ValueError(f'table belongs to the spot law "table", not to "{law}"')
    if law == "table":
        return number, _table(table)
    return number, law_data(f'the spot law "{law}"', wanted, values, SPOT_FIELDS.get(law, []), SPOT_NEEDED.get(law))


def _table(table: ArrayLike | None) -> Floats:
    """Pairs of force and resistance of a table, one after the other, after checking them."""
    if table is None:
        raise ValueError('the spot law "table" needs table: forces [N] and resistances [ohm], shape (2, n)')
    shape = np.shape(table)
    if len(shape) < 2 or shape[-2] != 2 or shape[-1] < 1:
        raise ValueError(f"table must have shape (2, n), forces and resistances, not {shape}")
    values = checks.leading("table", table, shape[-2:])
    if not (values > 0).all():
        raise ValueError("table must hold positive forces and resistances only")
    if (np.diff(values[..., 0, :]) <= 0).any():
        raise ValueError("the forces of table must ascend")
    return np.swapaxes(values, -1, -2).reshape(*shape[:-2], 2 * shape[-1])
