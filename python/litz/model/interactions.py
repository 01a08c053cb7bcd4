"""What a contact is: its laws together, and which wires or surfaces have them."""

from collections.abc import Iterator
from dataclasses import dataclass, field

from ..deck.keyword_table import check_card, check_name
from ..deck.lines import CardSpec
from .laws import Friction, GapConductance, Hertz, HertzSpot, Linear, NamedBehaviour, _Law, _Spot, _unless
from .materials import predefined


@dataclass(frozen=True)
class Interaction:
    """The laws of a contact.

    Attributes
    ----------
    name : str
        Name in the deck.
    behaviour : Hertz, Linear or NamedBehaviour
        Contact force over penetration.
    conductance : HertzSpot, PaperSpot, PlasticSpot, FilmSpot, SharvinSpot, ClusterSpot, ConstantSpot or TableSpot, optional
        Resistance of the spot; None: no current crosses.
    friction : Friction or float, optional
        Friction, or its coefficient alone; None: the wires slide freely.
    axis : {"HERMITE", "LINEAR"}
        Interpolation of the axes that touch.
    heat : GapConductance, optional
        Heat through the contact; None: it passes where a current can.
    """

    name: str = "TOUCH"
    behaviour: Hertz | Linear | NamedBehaviour = field(default_factory=Hertz)
    conductance: _Spot | None = None
    friction: Friction | float | None = None
    axis: str = "HERMITE"
    heat: GapConductance | None = None

    def __post_init__(self) -> None:
        """Checks the values."""
        check_name(self.name, "the name of an interaction")
        if not isinstance(self.behaviour, Hertz | Linear | NamedBehaviour):
            raise ValueError(
                f"behaviour must be Hertz(), Linear(penalty) or NamedBehaviour(law, data), not {self.behaviour!r}"
            )
        if not (self.conductance is None or isinstance(self.conductance, _Spot)):
            raise ValueError(
                "conductance must be None, HertzSpot(), PaperSpot(), PlasticSpot(hardness), FilmSpot(film_resistivity), "
                "SharvinSpot(resistivity_path), ClusterSpot(hardness, spots), "
                f"ConstantSpot(resistance), TableSpot(force, resistance) or NamedSpot(law, data), not {self.conductance!r}"
            )
        if not (self.heat is None or isinstance(self.heat, GapConductance)):
            raise ValueError(f"heat must be None or GapConductance(law, data), not {self.heat!r}")
        if not (self.friction is None or isinstance(self.friction, Friction)):
            object.__setattr__(self, "friction", Friction(self.friction))
        for card in self.cards():
            check_card(*card)

    def cards(self) -> Iterator[CardSpec]:
        """The cards of the interaction."""
        yield "SURFACE INTERACTION", {"NAME": self.name, **_unless(self, axis="HERMITE")}, []
        for law in (self.behaviour, self.friction, self.conductance, self.heat):
            if isinstance(law, _Law):
                yield law.card()
        if isinstance(self.friction, Friction) and self.friction.heat_fraction != 1:
            yield "GAP HEAT GENERATION", {}, [[self.friction.heat_fraction]]


#: Elastic wires of clean metal: the forces of Hertz, the spots of Hertz and Holm
HERTZ_AND_HOLM: Interaction = predefined(
    Interaction,
    name="TOUCH",
    behaviour=predefined(Hertz, penetration="LIMITED"),
    conductance=predefined(
        HertzSpot, voltage="CORRECTED", spot="PRESENT FORCE", mutual_resistance="NO", supertemperature="NO"
    ),
    friction=None,
    axis="HERMITE",
    heat=None,
)


@dataclass(frozen=True)
class ContactPair:
    """Two element sets that may touch, or an element set and a rigid surface.

    Attributes
    ----------
    interaction : Interaction
        The laws of the contact.
    first, second : str
        Names of groups or element sets; `second` is None for contact within the first, or a rigid surface.
    interference_fit : bool
        Initial overlaps of the wires are intended.
    """

    interaction: Interaction
    first: str
    second: str | None = None
    interference_fit: bool = False

    def cards(self) -> Iterator[CardSpec]:
        """The card of the pair."""
        parameters: dict = {"INTERACTION": self.interaction.name}
        if self.interference_fit:
            parameters["INTERFERENCE FIT"] = True
        yield "CONTACT PAIR", parameters, [[self.first] if self.second is None else [self.first, self.second]]
