"""What wires are made of, and their cross-sections."""

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any

from ..deck.keyword_table import check_card, check_name
from ..deck.lines import CardSpec


@dataclass(frozen=True)
class Material:
    """A linear elastic material, a conductor where it has a conductivity.

    Attributes
    ----------
    name : str
        Name in the deck.
    young : float
        Young's modulus [Pa].
    poisson : float
        Poisson's ratio [-].
    conductivity : float, optional
        Electrical conductivity [S/m]; None for an insulator.

    Examples
    --------
    >>> Material("BRASS", young=100e9, poisson=0.6)
    Traceback (most recent call last):
    ...
    ValueError: nu of *ELASTIC must be between -1 and 0.5, not 0.6 (Poisson's ratio [-])
    """

    name: str
    young: float
    poisson: float
    conductivity: float | None = None

    def __post_init__(self) -> None:
        """Checks the values."""
        check_name(self.name, "the name of a material")
        for card in self.cards():
            check_card(*card)

    def cards(self) -> Iterator[CardSpec]:
        """The cards of the material."""
        yield "MATERIAL", {"NAME": self.name}, []
        yield "ELASTIC", {}, [[self.young, self.poisson]]
        if self.conductivity is not None:
            yield "ELECTRICAL CONDUCTIVITY", {}, [[self.conductivity]]


def predefined(kind: type, **values: Any) -> Any:
    """A constant of this package, created without the checks that need the keyword table of the program; a test checks it."""
    constant: Any = object.__new__(kind)
    constant.__dict__.update(values)
    return constant


#: Pure copper at room temperature
COPPER: Material = predefined(Material, name="COPPER", young=120e9, poisson=0.34, conductivity=58.8e6)
#: Pure silver at room temperature
SILVER: Material = predefined(Material, name="SILVER", young=83e9, poisson=0.37, conductivity=63e6)
#: Spring steel at room temperature, here an insulator
STEEL: Material = predefined(Material, name="STEEL", young=200e9, poisson=0.3, conductivity=None)


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
    """

    radius: float
    contact_radius: float | None = None
    conduction: str = "REFERENCE LENGTH"

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
        Second moments for bending about the first and the second axis, which are principal axes [m^4].
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
    """

    area: float
    i11: float
    i22: float
    j: float
    n1: tuple[float, float, float] | None = None
    shear: tuple[float, float] | None = None
    contact_radius: float | None = None
    conduction: str = "REFERENCE LENGTH"

    def __post_init__(self) -> None:
        """Checks the values."""
        for name in ("n1", "shear"):
            given: Iterable[float] | None = getattr(self, name)
            if given is not None:
                object.__setattr__(self, name, tuple(float(value) for value in given))
        for card in self.cards("ALL", "ANY"):
            check_card(*card)

    def cards(self, elset: str, material: str) -> Iterator[CardSpec]:
        """The cards of the section."""
        rows: list = [[self.area, self.i11, 0, self.i22, self.j]]
        if self.n1 is not None:
            rows.append(list(self.n1))
        yield "BEAM SECTION", _parameters(self, elset, material, "GENERAL"), rows
        if self.shear is not None:
            yield "TRANSVERSE SHEAR STIFFNESS", {}, [list(self.shear)]

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
    return parameters
