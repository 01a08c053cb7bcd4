"""The laws of a contact: force over penetration, resistance of the spot, friction."""

from collections.abc import Sequence
from dataclasses import dataclass, field

from ..deck.keyword_table import check_card
from ..deck.lines import CardSpec


class _Law:
    """A law is checked when it is made."""

    def __post_init__(self) -> None:
        """Checks the values."""
        check_card(*self.card())

    def card(self) -> CardSpec:
        """The card of the law."""
        raise NotImplementedError


# Contact force over penetration


@dataclass(frozen=True)
class Hertz(_Law):
    """Approach of two wires by Hertz, elastic or with metal that yields in the spot.

    Attributes
    ----------
    penetration : {"LIMITED", "UNLIMITED"}
        UNLIMITED: deep penetration is no error.
    yield_stress : float, optional
        Yield stress of the softer metal [Pa]; without it the wires are elastic.
    hardness : float, optional
        Mean pressure of a spot that has wholly yielded [Pa]; without it 2.8 times the yield stress.
    """

    penetration: str = "LIMITED"
    yield_stress: float | None = None
    hardness: float | None = None

    def card(self) -> CardSpec:
        """The card of the law."""
        given = {"YIELD": self.yield_stress, "HARDNESS": self.hardness}
        parameters = {
            "PRESSURE-OVERCLOSURE": "HERTZ",
            **_unless(self, penetration="LIMITED"),
            **{name: value for name, value in given.items() if value is not None},
        }
        return "SURFACE BEHAVIOR", parameters, []


@dataclass(frozen=True)
class Linear(_Law):
    """Contact force in proportion to the penetration.

    Attributes
    ----------
    penalty : float, optional
        Contact force per penetration where wires cross [N/m]; without it that follows from `line_penalty`.
    penetration : {"LIMITED", "UNLIMITED"}
        UNLIMITED: the soft penalty is meant, deep penetration is no error.
    line_penalty : float, optional
        Contact force per length and penetration [N/m^2]: for contact along lines, and on rigid surfaces.
    """

    penalty: float | None = None
    penetration: str = "LIMITED"
    line_penalty: float | None = None

    def card(self) -> CardSpec:
        """The card of the law."""
        parameters = {"PRESSURE-OVERCLOSURE": "LINEAR", **_unless(self, penetration="LIMITED")}
        if self.penalty is None and self.line_penalty is None:
            raise ValueError("Linear needs a penalty, a line_penalty, or both")
        line = [] if self.line_penalty is None else [self.line_penalty]
        return "SURFACE BEHAVIOR", parameters, [[self.penalty, *line]]


@dataclass(frozen=True)
class NamedBehaviour(_Law):
    """Any other law that the keyword table has.

    Attributes
    ----------
    law : str
        `PRESSURE-OVERCLOSURE` of `*SURFACE BEHAVIOR`.
    data : sequence of sequences of float
        Its data lines.
    penetration : {"LIMITED", "UNLIMITED"}
        UNLIMITED: deep penetration is no error.
    """

    law: str
    data: Sequence[Sequence[float]] = ()
    penetration: str = "LIMITED"

    def __post_init__(self) -> None:
        """Checks the values."""
        object.__setattr__(self, "data", tuple(tuple(float(value) for value in row) for row in self.data))
        super().__post_init__()

    def card(self) -> CardSpec:
        """The card of the law."""
        parameters = {"PRESSURE-OVERCLOSURE": self.law.upper(), **_unless(self, penetration="LIMITED")}
        return "SURFACE BEHAVIOR", parameters, [list(row) for row in self.data]


# Resistance of the spot


@dataclass(frozen=True, kw_only=True)
class _Spot(_Law):
    """What all laws of the spot share.

    Attributes
    ----------
    voltage : {"CORRECTED", "LINEAR"}
        CORRECTED adds the resistance that the linear voltage within an element misses.
    spot : {"PRESENT FORCE", "LARGEST FORCE"}
        LARGEST FORCE: a spot that has been pressed stays, with the resistance of the largest force since the contact
        closed, slipped, or without friction moved by more than the spot.
    mutual_resistance : {"NO", "YES"}
        YES: contacts that are near each other on one wire, not across a kink, raise each other's potential.
    supertemperature : {"NO", "YES"}
        YES: a spot that its current warms resists more, in steps that solve for temperatures.
    """

    voltage: str = "CORRECTED"
    spot: str = "PRESENT FORCE"
    mutual_resistance: str = "NO"
    supertemperature: str = "NO"

    def card(self) -> CardSpec:
        """The card of the law."""
        law, rows = self._law()
        usual = {"voltage": "CORRECTED", "spot": "PRESENT FORCE", "mutual_resistance": "NO", "supertemperature": "NO"}
        per = {"PER": "LENGTH"} if getattr(self, "per_length", False) else {}
        parameters = {"LAW": law, **_unless(self, **usual), **per}
        return "GAP ELECTRICAL CONDUCTANCE", parameters, rows

    def _law(self) -> tuple[str, Sequence[Sequence[float | None]]]:
        raise NotImplementedError


@dataclass(frozen=True)
class HertzSpot(_Spot):
    """Elliptic spot of Hertz with Holm's constriction resistance; it has no data."""

    def _law(self) -> tuple[str, list[list[float]]]:
        return "HERTZ", []


@dataclass(frozen=True)
class PaperSpot(_Spot):
    """Circular spot of the paper by Boso, Litewka, Schrefler and Wriggers, to replay it."""

    def _law(self) -> tuple[str, list[list[float]]]:
        return "PAPER", []


@dataclass(frozen=True)
class PlasticSpot(_Spot):
    """Spot whose area is force over hardness.

    Attributes
    ----------
    hardness : float
        Hardness [Pa].
    """

    hardness: float

    def _law(self) -> tuple[str, list[list[float]]]:
        return "PLASTIC", [[self.hardness]]


@dataclass(frozen=True)
class FilmSpot(_Spot):
    """Spot of Hertz with a film in series: an oxide, or a coating.

    Attributes
    ----------
    film_resistivity : float
        Film resistance times area, of both faces together [ohm m^2]. Of a coating of tin, nickel or silver it is its
        resistivity times its thickness; 2 micrometres of nickel on each wire have `2 * 7e-8 * 2e-6`.
    """

    film_resistivity: float

    def _law(self) -> tuple[str, list[list[float]]]:
        return "FILM", [[self.film_resistivity]]


@dataclass(frozen=True)
class SharvinSpot(_Spot):
    """Spot of Hertz that may be small against the mean free path of the electrons.

    Attributes
    ----------
    resistivity_path : float, optional
        Resistivity times mean free path [ohm m^2], a constant of the metal: 8.46e-16 of silver, 6.7e-16 of copper.
    film_resistivity : float, optional
        Film resistance times area, of both faces together [ohm m^2]; of a coating its resistivity times its thickness.
    mean_free_path : float, optional
        Mean free path of the electrons [m] in place of `resistivity_path`, in both wires and at their resistivity, which
        must not depend on the temperature.
    """

    resistivity_path: float | None = None
    film_resistivity: float | None = None
    mean_free_path: float | None = None

    def card(self) -> CardSpec:
        """The card of the law."""
        if (self.resistivity_path is None) == (self.mean_free_path is None):
            raise ValueError("SharvinSpot needs resistivity_path or mean_free_path, not both")
        keyword, parameters, rows = super().card()
        path = {} if self.mean_free_path is None else {"MEAN FREE PATH": self.mean_free_path}
        return keyword, {**parameters, **path}, rows

    def _law(self) -> tuple[str, Sequence[Sequence[float | None]]]:
        film = [] if self.film_resistivity is None else [self.film_resistivity]
        row = [self.resistivity_path, *film]
        return "SHARVIN", [row] if any(value is not None for value in row) else []


@dataclass(frozen=True)
class ClusterSpot(_Spot):
    """Many plastic spots within the ellipse of Hertz, and a film if there is one.

    Attributes
    ----------
    hardness : float
        Hardness [Pa]: force over the area of all spots.
    spots : float
        Their number, 1 or more.
    film_resistivity : float, optional
        Film resistance times area, of both faces together [ohm m^2], on the area of the spots; of a coating its
        resistivity times its thickness.
    """

    hardness: float
    spots: float
    film_resistivity: float | None = None

    def _law(self) -> tuple[str, list[list[float]]]:
        film = [] if self.film_resistivity is None else [self.film_resistivity]
        return "CLUSTER", [[self.hardness, self.spots, *film]]


@dataclass(frozen=True)
class ConstantSpot(_Spot):
    """Given resistance.

    Attributes
    ----------
    resistance : float
        Resistance of a contact [ohm].
    per_length : bool
        It is resistance times length [ohm m], of wires that touch along lines and on rigid surfaces.
    """

    resistance: float
    per_length: bool = field(default=False, kw_only=True)

    def _law(self) -> tuple[str, list[list[float]]]:
        return "CONSTANT", [[self.resistance]]


@dataclass(frozen=True)
class TableSpot(_Spot):
    """Measured resistance over force; outside its forces the power law of the first, or last, two values goes on, with a warning.

    Attributes
    ----------
    force : sequence of float
        Contact forces, ascending [N].
    resistance : sequence of float
        Resistance of a contact at each [ohm].
    per_length : bool
        Forces are per length [N/m], resistances times length [ohm m], of wires that touch along lines and on rigid surfaces.
    """

    force: Sequence[float]
    resistance: Sequence[float]
    per_length: bool = field(default=False, kw_only=True)

    def __post_init__(self) -> None:
        """Checks the values."""
        for name in ("force", "resistance"):
            object.__setattr__(self, name, tuple(float(value) for value in getattr(self, name)))
        if len(self.force) != len(self.resistance):
            raise ValueError(f"{len(self.force)} forces need as many resistances, not {len(self.resistance)}")
        for i in range(1, len(self.force)):
            if not self.force[i] > self.force[i - 1]:
                raise ValueError(f"the forces of a table must ascend; {self.force[i]:g} follows {self.force[i - 1]:g}")
        super().__post_init__()

    def _law(self) -> tuple[str, list[list[float]]]:
        return "TABLE", [list(row) for row in zip(self.force, self.resistance, strict=True)]


@dataclass(frozen=True)
class NamedSpot(_Spot):
    """Any other law that the keyword table has.

    Attributes
    ----------
    law : str
        `LAW` of `*GAP ELECTRICAL CONDUCTANCE`.
    data : sequence of sequences of float
        Its data lines.
    """

    law: str
    data: Sequence[Sequence[float]] = ()

    def __post_init__(self) -> None:
        """Checks the values."""
        object.__setattr__(self, "data", tuple(tuple(float(value) for value in row) for row in self.data))
        super().__post_init__()

    def _law(self) -> tuple[str, list[list[float]]]:
        return self.law.upper(), [list(row) for row in self.data]


# Heat


@dataclass(frozen=True)
class GapConductance(_Law):
    """Heat through a contact.

    Attributes
    ----------
    law : {"CONDUCTIVITY", "METAL", "CONSTANT", "TABLE"}
        By the heat conductivities of the wires, the same of Wiedemann-Franz metals, given, or given over the contact force.
    data : sequence of sequences of float
        The heat conductance of CONSTANT ``[[h]]`` [W/K], or the lines ``[F, h]`` of TABLE [N, W/K].
    lorenz : float, optional
        Lorenz number of METAL [V^2/K^2]; without it that of each wire from its properties.
    softening, melting : float, optional
        Temperatures of the spot above which its metal softens, a warning, and melts, the end of the run [K].
    may_melt : bool
        A spot that melts is a warning, too.
    per_length : bool
        The heat conductance, and the force of TABLE, are per length of wires that touch along lines and on rigid surfaces.
    film : float, optional
        Resistance to heat of a film in the spot, times area, of CONDUCTIVITY and METAL [K m^2/W].
    """

    law: str = "CONDUCTIVITY"
    data: Sequence[Sequence[float]] = ()
    lorenz: float | None = None
    softening: float | None = None
    melting: float | None = None
    may_melt: bool = False
    per_length: bool = False
    film: float | None = None

    def __post_init__(self) -> None:
        """Checks the values."""
        object.__setattr__(self, "data", tuple(tuple(float(value) for value in row) for row in self.data))
        super().__post_init__()

    def card(self) -> CardSpec:
        """The card of the law."""
        numbers = {"LORENZ": self.lorenz, "FILM": self.film, "TSOFT": self.softening, "TMELT": self.melting}
        words = {"PER": "LENGTH" if self.per_length else None, "MELTING": "WARN" if self.may_melt else None}
        given = {name: value for name, value in (numbers | words).items() if value is not None}
        return "GAP CONDUCTANCE", {"LAW": self.law.upper(), **given}, [list(row) for row in self.data]


# Friction


@dataclass(frozen=True)
class Friction(_Law):
    """Coulomb friction, the same in every direction of the plane of the two wires.

    Attributes
    ----------
    mu : float
        Coefficient of friction [-].
    elastic_slip : float, optional
        Slip at which friction reaches its limit [m]; without it and `stick_stiffness`, Mindlin's stiffness.
    stick_stiffness : float, optional
        Tangential stiffness of a contact [N/m].
    heat_fraction : float
        Part of the work of friction that becomes heat [-].
    """

    mu: float
    elastic_slip: float | None = None
    stick_stiffness: float | None = None
    heat_fraction: float = 1.0

    def __post_init__(self) -> None:
        """Checks the values."""
        if self.elastic_slip is not None and self.stick_stiffness is not None:
            raise ValueError("friction takes elastic_slip or stick_stiffness, not both")
        if not 0 <= self.heat_fraction <= 1:
            raise ValueError(f"heat_fraction must be from 0 to 1, not {self.heat_fraction:g}")
        super().__post_init__()

    def card(self) -> CardSpec:
        """The card of the law."""
        parameters = {"ELASTIC SLIP": self.elastic_slip, "STICK STIFFNESS": self.stick_stiffness}
        return "FRICTION", {name: value for name, value in parameters.items() if value is not None}, [[self.mu]]


def _unless(law: object, **defaults: str) -> dict[str, str]:
    """Parameters that differ from what the deck takes without them; their names are those of the deck in lower case."""
    return {
        name.upper().replace("_", " "): getattr(law, name)
        for name, usual in defaults.items()
        if getattr(law, name) != usual
    }
