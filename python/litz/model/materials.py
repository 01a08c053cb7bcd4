"""What wires are made of, and their cross-sections."""

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import MISSING, dataclass, fields
from typing import Any

from ..deck.keyword_table import check_card, check_name
from ..deck.lines import CardSpec

#: A number, or a table over the temperature: lines of the value and the temperature [K], which ascends
OverTemperature = float | Sequence[tuple[float, float]]


@dataclass(frozen=True)
class Superconductor:
    """Superconducting filaments in the metal of a material: ``E = criterion (J/jc)^n`` in parallel with that metal.

    One of `jc`, `nb3sn` and `nbti` gives the critical current density, and one of `fraction` and `ratio` the area.

    Attributes
    ----------
    n : float
        Exponent of the power law, 1 or more.
    jc : float or lines of 3 float, optional
        Critical current density [A/m^2]: a number, or lines of it, of temperature [K] and of flux density [T].
    nb3sn : tuple of 9 float, optional
        C [A T/m^2], Bc20 [T], Tc0 [K], p, q, Ca1, Ca2, e0, em of the ITER-2008 parametrization.
    nbti : tuple of 7 float, optional
        jref [A/m^2], C0 [T], Bc20 [T], Tc0 [K], alpha, beta, gamma of Bottura's fit.
    fraction : float, optional
        Part of the cross-section that is superconductor, to which jc refers.
    ratio : float, optional
        Area of normal metal over that of superconductor.
    criterion : float
        Electric field at the critical current [V/m].
    field : float
        Flux density where no ``*LORENTZ`` gives one [T].
    strain : float
        Axial strain of the filaments in a beam without strain, as by cool-down.

    Examples
    --------
    >>> filaments = Superconductor(n=30, nbti=(3e9, 27.04, 14.5, 9.2, 0.57, 0.9, 2.32), ratio=1.6, field=5.0)
    >>> [card[0] for card in Material("STRAND", 100e9, 0.3, 5e9, superconductor=filaments).cards()]
    ['MATERIAL', 'ELASTIC', 'ELECTRICAL CONDUCTIVITY', 'SUPERCONDUCTOR']
    """

    n: float
    jc: float | Sequence[tuple[float, float, float]] | None = None
    nb3sn: Sequence[float] | None = None
    nbti: Sequence[float] | None = None
    fraction: float | None = None
    ratio: float | None = None
    criterion: float = 1e-4
    field: float = 0.0
    strain: float = 0.0

    def __post_init__(self) -> None:
        """Checks the values."""
        if [self.jc, self.nb3sn, self.nbti].count(None) != 2:
            raise ValueError("a superconductor needs one of jc, nb3sn and nbti")
        if (self.fraction is None) == (self.ratio is None):
            raise ValueError("a superconductor needs either fraction or ratio")
        if self.fraction is not None and self.fraction >= 1:
            raise ValueError(f"the fraction of the superconductor must be less than 1, not {self.fraction:g}")
        if self.jc is not None:
            object.__setattr__(self, "jc", _hashable(self.jc))
        for name in ("nb3sn", "nbti"):
            values = getattr(self, name)
            if values is not None:
                object.__setattr__(self, name, tuple(float(value) for value in values))
        check_card(*self.card())

    def card(self) -> CardSpec:
        """The card of the material."""
        law = "TABLE"
        rows: list[list[float]]
        if self.nb3sn is not None:
            law, rows = "NB3SN", [list(self.nb3sn)]
        elif self.nbti is not None:
            law, rows = "NBTI", [list(self.nbti)]
        elif isinstance(self.jc, Iterable):
            rows = [list(row) for row in self.jc]
        else:
            rows = [[self.jc or 0.0]]
        parameters: dict[str, Any] = {"LAW": law, "N": self.n}
        for name in ("fraction", "ratio"):
            if getattr(self, name) is not None:
                parameters[name.upper()] = getattr(self, name)
        for name, keyword in (("criterion", "EC"), ("field", "FIELD"), ("strain", "STRAIN")):
            if getattr(self, name) != type(self).__dataclass_fields__[name].default:
                parameters[keyword] = getattr(self, name)
        return "SUPERCONDUCTOR", parameters, rows


@dataclass(frozen=True)
class Material:
    """A linear elastic material, a conductor where it has a conductivity.

    What is given as a table over the temperature is linear between its lines and constant beyond them; of the conductivity
    that holds for its inverse, the resistivity.

    Attributes
    ----------
    name : str
        Name in the deck.
    young : float
        Young's modulus [Pa].
    poisson : float
        Poisson's ratio [-].
    conductivity : float or table, optional
        Electrical conductivity [S/m]; None for an insulator.
    expansion : float or table, optional
        Secant coefficient of thermal expansion from the initial temperature [1/K].
    thermal_conductivity : float or table, optional
        Conductivity for heat [W/(m K)].
    density : float, optional
        Mass per volume [kg/m^3].
    specific_heat : float or table, optional
        Heat stored per mass and kelvin [J/(kg K)].
    latent_heat : tuple of 3 float, optional
        Heat of melting [J/kg], taken up between solidus and liquidus [K].
    superconductor : Superconductor, optional
        Superconducting filaments; the conductivity is that of the metal around them.
    units : {"SI"}, optional
        The numbers are in SI: so is a model with this material, whose results then have the units of SI in their tables
        and pictures. None: they are in the units of the model.

    Examples
    --------
    Copper whose resistivity rises by 0.39 % per kelvin:

    >>> rho = {293.0: 1.7e-8, 1350.0: 1.7e-8 * (1 + 3.9e-3 * 1057)}
    >>> copper = Material("COPPER", 120e9, 0.34, [(1 / r, t) for t, r in rho.items()], thermal_conductivity=390.0)
    >>> [name for name, _, _ in copper.cards()]
    ['MATERIAL', 'ELASTIC', 'ELECTRICAL CONDUCTIVITY', 'CONDUCTIVITY']

    >>> Material("BRASS", young=100e9, poisson=0.6)
    Traceback (most recent call last):
    ...
    ValueError: nu of *ELASTIC must be between -1 and 0.5, not 0.6 (Poisson's ratio [-])
    """

    name: str
    young: float
    poisson: float
    conductivity: OverTemperature | None = None
    expansion: OverTemperature | None = None
    thermal_conductivity: OverTemperature | None = None
    density: float | None = None
    specific_heat: OverTemperature | None = None
    latent_heat: tuple[float, float, float] | None = None
    superconductor: Superconductor | None = None
    units: str | None = None

    def __post_init__(self) -> None:
        """Checks the values."""
        check_name(self.name, "the name of a material")
        if self.units not in (None, "SI"):
            raise ValueError(f'units of a material must be "SI" or None, not {self.units!r}')
        for name in _OVER_TEMPERATURE:
            value = getattr(self, name)
            if value is not None:
                object.__setattr__(self, name, _hashable(value))
        if self.superconductor is not None and self.conductivity is None:
            raise ValueError(f"the superconductor of {self.name} needs the conductivity of the metal around it")
        for card in self.cards():
            check_card(*card)

    def cards(self) -> Iterator[CardSpec]:
        """The cards of the material."""
        yield "MATERIAL", {"NAME": self.name}, []
        yield "ELASTIC", {}, [[self.young, self.poisson]]
        for name, keyword in _OVER_TEMPERATURE.items():
            value = getattr(self, name)
            if value is not None:
                yield keyword, {}, [[value]] if isinstance(value, float | int) else [list(row) for row in value]
        if self.density is not None:
            yield "DENSITY", {}, [[self.density]]
        if self.latent_heat is not None:
            yield "LATENT HEAT", {}, [list(self.latent_heat)]
        if self.superconductor is not None:
            yield self.superconductor.card()


#: Properties that may depend on the temperature, and their keywords
_OVER_TEMPERATURE = {
    "conductivity": "ELECTRICAL CONDUCTIVITY",
    "expansion": "EXPANSION",
    "thermal_conductivity": "CONDUCTIVITY",
    "specific_heat": "SPECIFIC HEAT",
}


def _hashable(value: float | Iterable[Sequence[float]]) -> Any:
    """The number as it is, or the table as tuples."""
    return value if not isinstance(value, Iterable) else tuple(tuple(float(one) for one in row) for row in value)


def predefined(kind: type, **values: Any) -> Any:
    """A constant of this package, created without the checks that need the keyword table of the program; a test checks it."""
    constant: Any = object.__new__(kind)
    optional = {field.name: field.default for field in fields(kind) if field.default is not MISSING}
    constant.__dict__.update(optional | values)
    return constant


#: Pure copper at room temperature
COPPER: Material = predefined(Material, name="COPPER", young=120e9, poisson=0.34, conductivity=58.8e6, units="SI")
#: Pure silver at room temperature
SILVER: Material = predefined(Material, name="SILVER", young=83e9, poisson=0.37, conductivity=63e6, units="SI")
#: Spring steel at room temperature, here an insulator
STEEL: Material = predefined(Material, name="STEEL", young=200e9, poisson=0.3, conductivity=None, units="SI")


@dataclass(frozen=True)
class Circular:
    """Solid round cross-section.

    Attributes
    ----------
    radius : float
        Radius of the wire [m].
    contact_radius : float, optional
        Radius of the surface that touches others [m]; the radius when left out.
    conduction : {"REFERENCE LENGTH", "CURRENT LENGTH"}
        Length that the resistance of an element is taken over.
    stiffness : float
        Factor of the stiffnesses of the beams; contacts, currents, heat and weight do not have it.
    """

    radius: float
    contact_radius: float | None = None
    conduction: str = "REFERENCE LENGTH"
    stiffness: float = 1.0

    def __post_init__(self) -> None:
        """Checks the values."""
        for card in self.cards("ALL", "ANY"):
            check_card(*card)

    def cards(self, elset: str, material: str) -> Iterator[CardSpec]:
        """The cards of the section."""
        yield "BEAM SECTION", _parameters(self, elset, material, "CIRC"), [[self.radius]]

    @property
    def surface_radius(self) -> float:
        """Radius of the round surface [m]."""
        return self.radius if self.contact_radius is None else self.contact_radius


@dataclass(frozen=True)
class General:
    """Cross-section of given stiffnesses.

    Attributes
    ----------
    area : float
        Area [m^2].
    i11, i22 : float
        Second moments for bending about the first and the second axis [m^4].
    j : float
        Torsion constant [m^4].
    n1 : tuple of 3 float, optional
        Direction of the first axis [-]; chosen by litz when left out.
    shear : tuple of 2 float, optional
        Shear stiffnesses of B31 elements along the first and the second axis [N]; G times area when left out.
    contact_radius : float, optional
        Radius of the round surface that touches others [m]; needed for wires in a contact pair.
    conduction : {"REFERENCE LENGTH", "CURRENT LENGTH"}
        Length that the resistance of an element is taken over.
    i12 : float
        Product of inertia, the integral of x1 x2 [m^4]; 0: the axes are principal ones.
    centroid, shear_center : tuple of 2 float, optional
        Where axial forces act, and what the section twists about, from the node along both axes [m]; they need `n1`.
    stiffness : float
        Factor of the stiffnesses of the beams; contacts, currents, heat and weight do not have it.
    """

    area: float
    i11: float
    i22: float
    j: float
    n1: tuple[float, float, float] | None = None
    shear: tuple[float, float] | None = None
    contact_radius: float | None = None
    conduction: str = "REFERENCE LENGTH"
    i12: float = 0.0
    centroid: tuple[float, float] | None = None
    shear_center: tuple[float, float] | None = None
    stiffness: float = 1.0

    def __post_init__(self) -> None:
        """Checks the values."""
        for name in ("n1", "shear", "centroid", "shear_center"):
            given: Iterable[float] | None = getattr(self, name)
            if given is not None:
                object.__setattr__(self, name, tuple(float(value) for value in given))
        if self.n1 is None and (self.centroid is not None or self.shear_center is not None):
            raise ValueError(
                "centroid and shear_center are along the section axes: give n1, the direction of the first one"
            )
        if self.shear is not None and (len(self.shear) != 2 or not min(self.shear) > 0):
            raise ValueError(
                f"shear: two stiffnesses greater than 0, along the first and the second axis, not {self.shear}"
            )
        for card in self.cards("ALL", "ANY"):
            check_card(*card)

    def cards(self, elset: str, material: str) -> Iterator[CardSpec]:
        """The cards of the section."""
        rows: list = [[self.area, self.i11, self.i12, self.i22, self.j]]
        if self.n1 is not None:
            rows.append(list(self.n1))
        yield "BEAM SECTION", _parameters(self, elset, material, "GENERAL"), rows
        if self.shear is not None:
            # the second axis comes first
            yield "TRANSVERSE SHEAR STIFFNESS", {}, [list(self.shear[::-1])]
        if self.centroid is not None:
            yield "CENTROID", {}, [list(self.centroid)]
        if self.shear_center is not None:
            yield "SHEAR CENTER", {}, [list(self.shear_center)]

    @property
    def surface_radius(self) -> float:
        """Radius of the round surface; without one, that of a circle of the same area [m]."""
        return math.sqrt(self.area / math.pi) if self.contact_radius is None else self.contact_radius


Section = Circular | General


def _parameters(section: Section, elset: str, material: str, shape: str) -> dict:
    parameters: dict[str, str | float] = {"ELSET": elset, "MATERIAL": material, "SECTION": shape}
    if section.contact_radius is not None:
        parameters["CONTACT RADIUS"] = section.contact_radius
    if section.conduction != "REFERENCE LENGTH":
        parameters["CONDUCTION"] = section.conduction
    if section.stiffness != 1.0:
        parameters["STIFFNESS"] = section.stiffness
    return parameters
