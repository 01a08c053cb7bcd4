"""The kernels of litz: plain arrays in, residual and tangent out.

For teaching, tests and other programs. `R` is internal minus external, `K` its
derivative; Newton's method solves ``K dq = -R``. Nodes have the unknowns ``ux uy uz phix phiy phiz``; rotational rows
and columns refer to spins, small rotations that turn a node on from where it is, unless something else is asked for.
Any units that fit together will do. The formulas are in ``docs/theory.md``.

One call takes one element, pair or point, or many: every argument that holds numbers may have any leading axes in front of
the shape that the function names, and these broadcast against each other as those of numpy's functions do. With ``x`` of
shape (n, 4, 3) and ``radius=1e-3`` there are n pairs of wires of the same radius; a radius for each wire of each pair has
the shape (n, 2), one for both wires of each pair (n, 1), a single number for each call, such as `force`, the shape (n,).
Results have the same leading axes, and are to the last bit those of single calls, which take 25 to 60 times as long.
Threads share the work of many crossings, points of lines, closest points and beams (``OMP_NUM_THREADS``).
`contact_search` takes all elements at once in any case.

The contact of two wires: `contact_em` (the 28 x 28 element), `contact_coupling` (its coupling block in the parts of the
paper), `closest_points`, `normal_law` (overlap to force), `contact_spot` (force to
conductance), of elastic wires or of metal that yields and keeps a dent, `contact_search` (which elements are near each other).
Wires that touch along a line: `line_law` (force to approach and conductance, per length), `line_point` (one point of it).
Surfaces of solids in the plane that touch, with laws per area: `node_to_segment_em`, `segment_to_segment_em`.
The wires: `beam_b31`, `beam_b33`, their strains and `beam_forces_by_temperature`, `conductor`, `potential_rise`.
Heat: `conductor_heat` (current and heat along a wire, with a film), `wire_radiation`, `heat_capacity`, `spot_heat` (heat and
hottest place of a contact spot), `hot_conductance`, `hot_spot`.
Superconductors: `nb3sn`, `nbti` and `critical_table` (critical current density), `parallel_field` (electric field of a current
that filaments and metal share), `superconductor` (the wire).
"""

from .axes import ClosestPoints, closest_points
from .beams import (
    Beam,
    BeamStrains,
    Conductor,
    beam_b31,
    beam_b31_strains,
    beam_b33,
    beam_b33_strains,
    beam_forces_by_temperature,
    conductor,
    potential_rise,
)
from .contact import ContactCoupling, ContactEM, contact_coupling, contact_em
from .heat import (
    ConductorHeat,
    HeatCapacity,
    HotConductance,
    SpotHeat,
    WireRadiation,
    conductor_heat,
    heat_capacity,
    hot_conductance,
    spot_heat,
    wire_radiation,
)
from .line import LineLaw, LinePoint, line_law, line_point
from .search import contact_search
from .spot import ContactSpot, contact_spot
from .superconductors import (
    CriticalDensity,
    ParallelField,
    Superconductor,
    critical_table,
    nb3sn,
    nbti,
    parallel_field,
    superconductor,
)
from .surface import NodeToSegment, SegmentToSegment, node_to_segment_em, segment_to_segment_em
from .warmed_spots import HotSpot, hot_spot
from .yielding import NormalForce, normal_law

__all__ = [
    "Beam",
    "BeamStrains",
    "ClosestPoints",
    "Conductor",
    "ConductorHeat",
    "ContactCoupling",
    "ContactEM",
    "ContactSpot",
    "CriticalDensity",
    "HeatCapacity",
    "HotConductance",
    "HotSpot",
    "LineLaw",
    "LinePoint",
    "NodeToSegment",
    "NormalForce",
    "ParallelField",
    "SegmentToSegment",
    "SpotHeat",
    "Superconductor",
    "WireRadiation",
    "beam_b31",
    "beam_b31_strains",
    "beam_b33",
    "beam_b33_strains",
    "beam_forces_by_temperature",
    "closest_points",
    "conductor",
    "conductor_heat",
    "contact_coupling",
    "contact_em",
    "contact_search",
    "contact_spot",
    "critical_table",
    "heat_capacity",
    "hot_conductance",
    "hot_spot",
    "line_law",
    "line_point",
    "nb3sn",
    "nbti",
    "node_to_segment_em",
    "normal_law",
    "parallel_field",
    "potential_rise",
    "segment_to_segment_em",
    "spot_heat",
    "superconductor",
    "wire_radiation",
]
