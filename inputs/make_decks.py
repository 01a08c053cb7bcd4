"""Writes the decks that are too long to write by hand: `python inputs/make_decks.py`."""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np

import litz
from litz import FilmSpot, GapConductance, HertzSpot, Interaction, Material, Model, Superconductor, build
from litz.model import HERTZ_AND_HOLM

INPUTS = Path(__file__).parent

# What the heads of decks expect, from the tests that compute it
HEATED_MAT = ("1.5      11.5857           302.41", "2        12.1486           328.99")
WIPER = ("1.5      296.30    301.68", "2        296.64    307.00")


def fibre_mat() -> build.Model:
    """128 copper fibres in eight layers, pressed between two electrodes."""
    model = build.fibre_mat((30e-3, 30e-3), 16, radius=0.1e-3, seed=1, n_layers=8, clearance=5e-6, spread=0.5)
    model.title = "A mat of 128 copper fibres pressed between two electrodes"
    add_step(model, 0.1e-3)
    model.comments = """\
Model    Eight layers of 16 straight copper fibres of 0.1 mm radius, layers along x and y in turn, each fibre rotated at
         random by up to 0.5 rad (29 degrees). Electrodes of six rigid bars each lie below and above. The ends of the
         fibres are held in a frame of 30 mm x 30 mm that is pressed together with the upper electrode: without friction,
         fibres with free ends would slide off each other. The gaps of 5 microns all close at once, at time 0.45.
         1 mV between the electrodes.
Contact  Hertz and Holm, between neighbouring layers. Real copper this thin would yield: the forces are those of elastic wires.
Source   litz.build.fibre_mat, called in inputs/make_decks.py.
Expect   The resistance falls at every increment after first contact, to 0.13 mohm. Kirchhoff's laws for the wires and contacts
         of `contact_network` of `litz.Results` give the same to nine digits. Each contact has Holm's resistance for
         its force. The forces on electrodes and frame are in balance.""".splitlines()
    return model


def woven_fabric() -> build.Model:
    """A plain weave of 8 x 8 copper yarns, pressed between two plates of stiff wires."""
    model = build.woven_fabric(8, 8, pitch=1e-3, radius=0.1e-3, clearance=1e-6, elements_per_pitch=8)
    model.title = "A plain-woven fabric pressed between two plates"
    add_step(model, 6.5e-6)
    model.comments = """\
Model    8 x 8 copper wires of 0.1 mm radius at a pitch of 1 mm, woven one over one, with axes z = +-a cos(pi s/pitch).
         Each plate conducts: it is a row of straight wires, with all nodes prescribed, one along each
         diagonal of crests, crossing the wires at 45 degrees. The upper plate moves down by 6.5 microns, of which 3 close
         the gaps. The ends of the wires are held laterally and move down by half, the middles are held along the wire.
         1 mV between the plates.
Contact  Hertz and Holm, plates with wires at 45 degrees, wires with each other at 90 degrees: bent at their crests,
         away from the plates and about each other, with a (pi/pitch)^2.
Source   litz.build.woven_fabric, called in inputs/make_decks.py. By symmetry all crossings far from the edge are equal:
         plate on wire (force F), wire on wire (force N), and wires that bend from crest to crest,
            delta_45(F) + u = d,  delta_90(N) = 2 u - c,  F - N = 4 u/f,  f = integral of (pitch/2 - s)^2 dl/(E I),
         with d = 2.25 microns, the approach of the plates to the middle without the gap, and c = 1 micron. f is that of the
         curved wire. Resistance: Kirchhoff's laws for 64 crossings of two points each, and for the plate elements,
         two radii long, that carry the current to each contact.
Expect   forces at the four crossings in the middle: plate F = 1.4582 N, wires N = 1.0033 N, both within 0.5 %
         resistance between the plates 0.02499 mohm, within 2 % (two contacts share an element of each wire)""".splitlines()
    return model


def strand() -> build.Model:
    """Six wires laid on a core between two clamps: pulled, twisted and bent, with a current."""
    model = clamped_strand(HERTZ_AND_HOLM)
    model.title = "A strand of 1 + 6 wires is pulled, twisted and bent by clamps"
    model.comments = """\
Model    A core of 0.52 mm radius with six copper wires of 0.5 mm, laid at 8 degrees over two thirds of a lay of 45 mm.
         The ends are tied to two rigid clamps. One is fixed, the other one is pulled by 0.05 %, then turned by 0.05 rad in the
         sense of the lay, and then moved across by 0.3 mm. 1 mV between the ends.
Contact  Hertz and Holm per length, along the helices on which the wires touch the core. They do not touch each other.
Source   litz.build.strand, called in inputs/make_decks.py; references/helical_rods.py of the verification for long strands.
Expect   axial force on the moving clamp [N], that of a long strand to 0.1 %
         time s   force N
         1        324.781
         2        457.746
         The resistance of the strand is that of its seven wires side by side, 92.52 microohm. All wires touch the core
         from end to end, with 5.4 N per mm in all when pulled and 8.5 N per mm when twisted, too.""".splitlines()
    move_clamp(model, PULL={"z": 15e-6}, TWIST={"rz": 0.05}, BEND={"y": 0.3e-3})
    return model


def bent_strand() -> build.Model:
    """The same strand with friction, bent forth and back."""
    model = clamped_strand(Interaction(conductance=HertzSpot(), friction=0.2))
    model.title = "A strand of 1 + 6 wires with friction is pulled, and bent forth and back"
    model.comments = """\
Model    The strand of 14_strand.inp, pulled by 0.05 %. Then its clamp is moved across by 0.3 mm and back.
Contact  Hertz and Holm per length; friction 0.2 between the surfaces of the wires, which stick and slip along the core.
Source   litz.build.strand, called in inputs/make_decks.py; a tensioned beam, clamped and guided, whose section is that of
         seven wires without contact, or that of a rod of them, in which nothing slips (for strands: K. O. Papailiou, IEEE
         Trans. Power Delivery 12 (1997) 1576-1588).
Expect   force across on the moving clamp, between that of the wires and that of the rod, both under 324.78 N
         time s   wires N    rod N
         2        9.4990     48.747
         The wires slip: back in the middle, the clamp must be held against them. A dozen iterations each increment, of any
         size, as wires stick and slip at two thousand places: hence the limits in *CONTROLS.""".splitlines()
    move_clamp(model, PULL={"z": 15e-6}, BEND={"y": 0.3e-3}, BACK={"y": 0.0})
    model.steps[0].controls("TIME INCREMENTATION", i_c=24, i_l=16, i_g=8)
    return model


def clamped_strand(interaction: Interaction) -> build.Model:
    """Two thirds of a lay between a fixed clamp and the node set CLAMP, with 1 mV in between."""
    length = 30e-3
    model = build.strand([1, 6], radius=[0.52e-3, 0.5e-3], lay_length=45e-3, length=length, interaction=interaction)
    model.supports = []
    model.fix(model.rigid_body((0, 0, 0), tie="MINUS"), "encastre")
    model.node_set("CLAMP", model.rigid_body((0, 0, length), tie="PLUS"))
    model.fix("MINUS", "potential")
    return model


def move_clamp(model: build.Model, **steps: dict[str, float]) -> None:
    """Steps that move the clamp in the directions given, and hold it in the others from the start."""
    for name, motion in steps.items():
        step = model.step(name, increment=0.25)
        if not model.steps[1:]:
            step.potential("PLUS", 1e-3)
            step.hold("CLAMP", "x", "y", "rotations")
        for direction, value in motion.items():
            step.move("CLAMP", direction, value)
        step.node_print("CLAMP", "RF")
        step.electrode_print("PLUS", "MINUS")


def lap_joint() -> Model:
    """Two wires side by side, pressed together by jaws over 20 mm; the current passes from one into the other."""
    radius, lap, free = 0.5e-3, 20e-3, 10e-3
    model = Model("Two copper wires lapped and pressed together by jaws", units="SI")
    model.comments = """\
Model    Two copper wires of 0.5 mm radius lie side by side over 20 mm. Each goes on for 10 mm, in opposite directions.
         Over the lap they are held by two rigid jaws; one is fixed, the other one presses by up to 0.4 micrometres.
         The current enters one wire at its far end and leaves the other one there; 1 mV between the ends.
Contact  Along a line: Hertz, and a film of 1e-11 ohm m^2 on tarnished copper.
Source   Force and conductance per length of parallel wires (K. L. Johnson, Contact Mechanics, sections 4.2 and 5.6; potential
         of a disc), and the transmission line of two wires that conduct into each other,
            R = r lap/2 + r/m coth(m lap/2) + 2 r free,  m^2 = 2 r g,  r = resistivity/area,
         in verification/references/parallel_wires.py and line_joints.py. Written by inputs/make_decks.py.
Expect   Between wires that touch all over the lap the current passes mostly near its ends. Force of the jaw, with
         half of Hertz's contact of the round end of either wire, and resistance between the ends, to 0.1 %
         time s   force N    resistance mohm
         0.25     37.938     0.799172
         0.5      81.435     0.769118
         1        175.865    0.746741""".splitlines()
    copper = model.material("COPPER", young=120e9, poisson=0.34, conductivity=58.8e6)
    lower = model.wire("LOWER", (-free, 0, 0), (lap, 0, 0), radius=radius, material=copper, elements=30)
    upper = model.wire(
        "UPPER", (0, 0, 2 * radius), (lap + free, 0, 2 * radius), radius=radius, material=copper, elements=30
    )
    model.contact(lower, upper, conductance=FilmSpot(1e-11))
    model.node_set("PLUS", lower.start)
    model.node_set("MINUS", upper.end)
    in_lap = [np.abs(model.x[np.array(wire.nodes) - 1, 0] - lap / 2) < lap / 2 + 1e-6 for wire in (lower, upper)]
    for name, wire, held in zip(("BELOW", "ABOVE"), (lower, upper), in_lap, strict=True):
        model.node_set(name, np.array(wire.nodes)[held].tolist())
    model.fix(model.rigid_body((lap / 2, 0, 0), tie="BELOW"), "encastre")
    jaw = model.rigid_body((lap / 2, 0, 2 * radius), tie="ABOVE")
    model.node_set("JAW", jaw)
    model.fix(jaw, "x", "y", "rotations")
    step = model.step("PRESS", increment=0.25)
    step.move(jaw, "z", -0.4e-6)
    step.potential("PLUS", 1e-3)
    step.potential("MINUS", 0)
    step.node_print("JAW", "RF")
    step.electrode_print("PLUS", "MINUS")
    return model


def rod_over_drum() -> build.Model:
    """A steel rod hangs over a rigid drum by two weights, and one end is drawn down."""
    radius, on_drum, tension = 0.5e-3, 50e-3, 19.6349540849
    model = build.Model("A rod with bending stiffness is drawn over a rigid drum", units="SI")
    model.comments = """\
Model    A straight steel rod of 0.5 mm radius is laid on a rigid drum, hung over it by a weight of 5 B/R^2 = 19.635 N at either
         end, where R = 50 mm is the radius of its axis on the drum and B its bending stiffness, and then drawn down by
         one end, against the other weight, until it slips on the whole arc. Friction 0.3.
Contact  Hertz per length on a *RIGID SURFACE, along an arc with a point force at either end of it. The drum has a reference
         node on its axis, which is held: its reactions are what the rod does to the drum.
Source   inputs/make_decks.py; references/capstan.py of the verification: H. Singh, J. Elast. 151 (2022) 321-346, with friction
         on the surface of the rod, 0.5 mm off its axis.
Expect   tension of the drawn end [N] and moment on the drum about its axis [N m], (T2 - T1) R, both to 0.05 %
         time s   tension N   moment N m
         3        47.171      1.3768
         Contact along an arc of 137.7 degrees, within an element of 3.3 degrees; without bending stiffness it would be 180
         degrees, and T2/T1 2.566, Euler's, in place of 2.402.""".splitlines()
    rod = model.wire(
        "ROD",
        (-0.2285, 0, on_drum),
        (0.2285, 0, on_drum),
        elements=160,
        radius=radius,
        material=model.material("STEEL", young=200e9, poisson=0.3),
    )
    drum = model.cylinder("DRUM", (0, 0, -1e-7), (0, 1, 0), on_drum - radius, reference=(0, 0, 0))
    model.contact(rod, drum, friction=0.3)
    model.fix(rod, "y", "rx", "rz")
    model.fix(drum)
    lay = model.step("LAY")
    lay.hold(rod.middle, "x", "ry")
    lay.move(rod.ends, "z", -2e-4)
    hang = model.step("HANG", first=0.01, largest=0.1, inc=400, boundary_op="NEW")
    draw = model.step("DRAW", first=0.02, largest=0.2, inc=400, boundary_op="NEW", cload_op="NEW")
    for step in (hang, draw):
        step.hold(rod, "y", "rx", "rz")
        step.hold(drum)
    hang.hold(rod.middle, "x", "ry")
    hang.force(rod.ends, "z", -tension)
    draw.force(rod.start, "z", -tension)
    draw.move(rod.end, "z", -0.2015)
    draw.node_print(rod.end, "RF")
    draw.node_print(drum, "RF", "RM")
    return model


def knot() -> litz.Model:
    """A wire with an overhand knot is pulled tight, with a current."""
    radius, pull = 0.25e-3, 14e-3
    model = litz.Model("A knot in a wire is pulled tight", units="SI")
    model.comments = """\
Model    A wire of nitinol, 0.5 mm thick and 87 mm long, that has the shape of a loose overhand knot without stress: 3 mm times
         (t^3 - 3t, t^4/2 - 2t^2, 1.2 sin 3t), with round and then straight ends along x. The ends are led apart by 14 mm
         each, with 1 mV between them.
Contact  Hertz and Holm, of the wire with itself, without friction. First it touches itself at two crossings, which slide towards
         each other; from time 0.7 on its strands wind around each other and touch along two lines.
Source   overhand in inputs/make_decks.py. Half a turn about the y axis leaves the knot as it is. Without contact the resistance
         is that of the length of the curve, with contacts that of Kirchhoff's laws for the wire between them.
Expect   The knot short-circuits its loop: the resistance falls from 353.0 mohm, that of the whole wire, to 215 mohm at first
         contact, and rises to 274.5 mohm as the loop shrinks. The ends are pulled by 17.9 N in the end (17.86 N with twice as
         many elements), and the wire is strained by 6.5 % in bending, about as much as nitinol bears.""".splitlines()
    nitinol = model.material("NITINOL", young=60e9, poisson=0.33, conductivity=1.25e6)
    wire = model.wire("WIRE", curve=overhand, span=(-4.0, 4.0), elements=160, radius=radius, material=nitinol)
    model.contact(wire, conductance=litz.HertzSpot())
    model.fix(wire.ends, "y", "z", "rotations")
    step = model.step("PULL", increment=0.05)
    step.move(wire.start, "x", -pull)
    step.move(wire.end, "x", pull)
    step.potential(wire.start, 1e-3)
    step.potential(wire.end, 0.0)
    step.node_print(wire.end, "RF")
    step.electrode_print(wire.start, wire.end)
    step.energy_print()
    return model


def overhand(t: float) -> list[float]:
    """An overhand knot: a curve that crosses itself three times, and beyond |t| = 2 pi/3 an arc and a straight end."""
    size, bend, last = 3e-3, 6e-3, 2 * np.pi / 3
    u = min(abs(t), last)
    x = size * np.array([u**3 - 3 * u, (u**4 - 4 * u**2) / 2, 1.2 * np.sin(3 * u)])
    along = size * np.array([3 * u**2 - 3, 2 * u**3 - 4 * u, 3.6 * np.cos(3 * u)])
    if abs(t) > last:
        along /= np.linalg.norm(along)
        inwards = np.array([1.0, 0.0, 0.0]) - along[0] * along
        inwards /= np.linalg.norm(inwards)
        full = np.arccos(along[0])
        angle = min(abs(t) - last, full)
        x += bend * (np.sin(angle) * along + (1 - np.cos(angle)) * inwards)
        x[0] += bend * (abs(t) - last - angle)
    return [float(np.copysign(1, t) * x[0]), float(x[1]), float(np.copysign(1, t) * x[2])]


def _nb3sn_strand() -> Material:
    """Strands half of Nb3Sn, half of copper, by the parametrization of ITER; the filaments are 0.3 % shorter than the rest."""
    nb3sn = (4e10, 32.57, 17.17, 0.7, 2.1, 45.74, 4.431, 2.32e-3, -0.61e-3)
    filaments = Superconductor(n=20, nb3sn=nb3sn, ratio=1.0, strain=-3e-3)
    return Material("STRAND", 110e9, 0.3, 5e9, expansion=10e-6, superconductor=filaments, units="SI")


def _load_in_cycles(model: build.Model, count: int, increment: float) -> None:
    """75 A in each strand, in 11.5 T, switched on and off."""
    for cycle in range(1, count + 1):
        load = model.step(f"LOAD{cycle}", increment=increment)
        load.current("PLUS", -75.0)
        load.lorentz("WIRES", (11.5, 0, 0))
        model.step(f"UNLOAD{cycle}", increment=increment).current("PLUS", 0.0)


def compacted_cable() -> build.Model:
    """A cable of Nb3Sn strands that is compacted, cooled down and loaded in cycles."""
    radius, length, held = 0.41e-3, 20e-3, 4
    model = build.cable(
        [[3], [3]],
        radius=radius,
        lay_lengths=[80e-3, 140e-3],
        length=length,
        material=_nb3sn_strand(),
        interaction=Interaction(conductance=FilmSpot(1e-11), friction=0.3),
    )
    strands = model.groups["LAYER1"]
    model.fix("MINUS", "potential")
    model.initial_temperature(923.0)
    model.element_set("MIDDLE", [element for wire in strands.wires for element in wire.elements[held:-held]])
    size = float((np.hypot(model.x[:, 0], model.x[:, 1]) + radius).max())
    shrinks = model.amplitude("JACKET", [0, 1, 2], [1, 0.96, 0.96 * (1 - 0.0165)], time="TOTAL TIME")
    jacket = model.bore("JACKET", (0, 0, 0), (0, 0, 1), size, radius_amplitude=shrinks)
    model.contact("MIDDLE", jacket, friction=0.1)
    compact = model.step("COMPACT", increment=1 / 12)
    compact.controls("STABILIZE", factor=1e-4)
    compact.controls("TIME INCREMENTATION", i_c=24, i_l=16, i_g=8)
    cool = model.step("COOL", increment=0.25)
    cool.controls("STABILIZE", factor=0.0)
    cool.temperature(strands, 4.5)
    cool.move("PLUS", "z", -(10e-6 * 918.5 + 3e-3) * length)
    _load_in_cycles(model, 2, 0.25)
    model.title = "A cable of nine strands is compacted, cooled down, and loaded by its current in cycles"
    model.comments = """\
Model    3 x 3 strands of Nb3Sn and copper, 0.82 mm, with lays of 80 and 140 mm, over 20 mm. A round jacket shrinks by 4 %
         about all but the four elements next to the clamps at both ends. They cool down from 923 K to 4.5 K with the steel
         of the jacket, which leaves them 0.3 % shorter than they would be alone; copper has left 0.3 % in the filaments.
         Then 75 A in each strand, in 11.5 T, are switched on and off twice. Results give the resistances between the
         strands: litz network --superconducting.
Contact  Hertz, an oxide of 1e-11 ohm m2, friction of 0.3, and 0.1 on the jacket. Elastic strands: those of a real cable, at
         void fractions of a third, yield.
Source   litz.build.cable, called in inputs/make_decks.py. Equilibrium of the cable: jacket and clamps carry the Lorentz
         force. L. Bottura, B. Bordini, IEEE Trans. Appl. Supercond. 19 (2009) 1521-1524, at the strain of each element.
Expect   Lorentz force 153.36 N, 9 x 75 A x 11.5 T over the 20 mm of the cable less the 1.2 % by which it gets shorter,
         which clamps and jacket carry. It presses the bundles together, which do not touch without it: two of them,
         soldered, have 0.8 mohm between them (superconducting) under load, and no contact before.
         The strands are strained by up to -0.31 %, less where they bend beside the clamps, the filaments by 0.3 % more:
         critical currents of 87 to 103 A under load.""".splitlines()
    return model


def cable_of_45_strands() -> build.Model:
    """A cable of three stages that is compacted from end to end, cooled down, soldered, and loaded by its current ten times."""
    radius, length, void, steel = 0.41e-3, 12e-3, 0.5, 10e-6 * 918.5 + 3e-3
    model = build.cable(
        [[3], [3], [5]],
        radius=radius,
        lay_lengths=[80e-3, 140e-3, 190e-3],
        length=length,
        material=_nb3sn_strand(),
        interaction=Interaction(conductance=FilmSpot(1e-11), friction=0.3),
        ends="sliding",
    )
    strands = model.groups["LAYER1"]
    model.fix("MINUS", "potential")
    model.initial_temperature(923.0)
    size = float((np.hypot(model.x[:, 0], model.x[:, 1]) + radius).max())
    metal = np.linalg.norm(np.diff(model.x[model.connectivity], axis=1), axis=2).sum() * radius**2 / length
    shrunk = math.sqrt(metal / (1 - void)) / size
    shrinks = model.amplitude("JACKET", [0, 1, 2], [1, shrunk, shrunk * (1 - steel)], time="TOTAL TIME")
    jacket = model.bore("JACKET", (0, 0, 0), (0, 0, 1), size, radius_amplitude=shrinks)
    model.contact(strands, jacket, friction=0.1)
    compact = model.step("COMPACT", increment=0.05)
    compact.controls("STABILIZE", factor=1e-4)
    compact.controls("TIME INCREMENTATION", i_c=24, i_l=16, i_g=8)
    cool = model.step("COOL", increment=0.25)
    cool.temperature(strands, 4.5)
    cool.move("PLUS", "z", -steel * length)
    solder = model.step("SOLDER", increment=0.25)
    solder.controls("STABILIZE", factor=0.0)
    for ends in ("MINUS", "PLUS"):
        solder.hold_here(ends, "x", "y")
    _load_in_cycles(model, 10, 0.25)
    model.title = "A cable of 45 strands is compacted, cooled down, and loaded by its current ten times"
    model.comments = """\
Model    3 x 3 x 5 strands of Nb3Sn and copper, 0.82 mm, with lays of 80, 140 and 190 mm, over 12 mm. A round jacket shrinks
         from end to end until half of its section is metal: the strands are laid on each other in the first increments, and
         five bundles of nine are pressed together. They cool down from 923 K to 4.5 K with the steel of the jacket, which
         leaves them 0.3 % shorter than they would be alone; copper has left 0.3 % in the filaments. Their ends are then
         soldered where they are, and 75 A in each strand, in 11.5 T, are switched on and off ten times. Results give the
         resistances between strands and bundles over the cycles: litz network --superconducting.
Contact  Hertz, an oxide of 1e-11 ohm m2, friction of 0.3, and 0.1 on the jacket. Elastic strands: those of a real cable, at
         void fractions of a third, yield.
Source   litz.build.cable, called in inputs/make_decks.py. Equilibrium of the cable: jacket and ends carry the Lorentz force.
Expect   Lorentz force 460.07 N, 45 x 75 A x 11.5 T over the 12 mm of the cable less the 1.2 % by which it gets shorter. The
         bundles, each soldered, have 0.36 to 0.82 mohm from one to the next under load, and 0.38 to 1.04 mohm without
         (superconducting). Over ten cycles that changes by up to 11 %, by less with each: friction lets strands settle.
         It takes seven minutes on one processor: 2000 iterations with up to 4500 contacts.""".splitlines()
    return model


def heated_mat() -> build.Model:
    """A mat of nichrome fibres between two electrodes, that its current heats."""
    nichrome = Material(
        "NICHROME", young=220e9, poisson=0.3, conductivity=0.9e6, thermal_conductivity=11.3, expansion=14e-6, units="SI"
    )
    model = build.fibre_mat(
        (10e-3, 10e-3),
        6,
        radius=0.1e-3,
        seed=1,
        n_layers=4,
        clearance=5e-6,
        spread=0.5,
        material=nichrome,
        interaction=replace(HERTZ_AND_HOLM, heat=GapConductance("CONDUCTIVITY")),
    )
    model.title = "A mat of nichrome fibres is pressed, and heated by its current"
    model.initial_temperature(293.15)
    model.press(40e-6, voltage=1e-3)
    heat = model.step("HEAT", procedure="COUPLED TEMPERATURE-DISPLACEMENT", steady_state=True, increment=0.25)
    for electrode in ("PLATE_BOTTOM", "PLATE_TOP"):
        heat.temperature(electrode, 293.15)
    heat.potential("PLUS", 0.06)
    for electrode in ("PLATE_BOTTOM", "PLATE_TOP"):
        heat.node_print(electrode, "RFL", totals="ONLY")
    model.comments = """\
Model    Four layers of six straight nichrome fibres of 0.1 mm radius between two electrodes of rigid bars, made and held as
         those of 11_fibre_mat. First pressed, with 1 mV; then the voltage rises to 60 mV. Steady.
         The electrodes stay at 293.15 K: all heat leaves through the contacts with them.
Contact  Hertz and Holm; heat passes where the current does, by the conductivity of the metal in the spot.
Source   litz.build.fibre_mat, called in inputs/make_decks.py. Resistivity and heat conductivity are constant, so that wires
         and contacts are two networks, one of resistances to the current and one to heat: what the current makes in a
         contact enters both wires half and half, what it makes between two contacts of a wire half at either.
Expect   The temperatures of all contacts and the current are those of the networks, to 1e-6 K and nine digits. The fibres,
         which cannot get longer between the ends that are held, bend aside: the forces fall as the mat gets hot.
         time s   resistance mohm   hottest contact K
{}""".format("\n".join(f"         {row}" for row in HEATED_MAT)).splitlines()
    return model


def wiper() -> Model:
    """A spring of bronze slides along a track with a current: friction and current heat both."""
    radius, track_length, travel, time = 0.5e-3, 40e-3, 20e-3, 1.0
    bronze = Material(
        "BRONZE",
        young=110e9,
        poisson=0.34,
        conductivity=8e6,
        thermal_conductivity=62.0,
        density=8800.0,
        specific_heat=380.0,
        expansion=18e-6,
    )
    model = Model("A wiper slides along a track with a current", units="SI")
    track = model.wire("TRACK", (0, 0, 0), (track_length, 0, 0), radius=radius, material=bronze, elements=80)
    at = 10.3e-3
    arm = model.wire(
        "ARM", (at, -20e-3, 2 * radius), (at, 1.3e-3, 2 * radius), radius=radius, material=bronze, elements=21
    )
    model.contact(track, arm, conductance=HertzSpot(), heat=GapConductance("CONDUCTIVITY"), friction=0.3)
    model.fix(track)
    model.fix(arm.start)
    model.fix(track.start, "potential")
    model.initial_temperature(293.15)
    press = model.step("PRESS", increment=0.1)
    press.move(arm.start, "z", -1e-3)
    slide = model.step("SLIDE", procedure="COUPLED TEMPERATURE-DISPLACEMENT", total=time, increment=0.01)
    motion = model.amplitude("MOTION", (0.0, time), (0.0, 1.0))
    slide.move(arm.start, "x", travel, amplitude=motion)
    slide.temperature(track.ends, 293.15)
    slide.temperature(arm.start, 293.15)
    slide.current(arm.start, 10.0)
    slide.energy_print()
    slide.node_print(arm.start, "RF")
    slide.electrode_print(arm.start, track.start)
    model.comments = """\
Model    A round spring of bronze, 0.5 mm in radius, is pressed with 2 N across a track of the same wire by its clamp, 20 mm
         away, and drawn along it by 20 mm within a second, while 10 A flow from the clamp through the contact to the
         near end of the track. The track does not move. Both of its ends and the clamp stay at 293.15 K.
Contact  Hertz and Holm, friction of 0.3; heat passes by the conductivity of the metal in the spot.
Source   Series of sines for the temperatures along both wires, with sources that move with the contact: half of the heat
         of friction, mu F v, and of the spot, I^2 rho/(2 a), in either wire, the current in the wires as far as it
         flows, and 2 a k between them; a of Hertz, F that of the run.
Expect   Temperatures at the contact, of the track to 0.2 K, of the spring to 0.15 K. Friction dissipates mu F times
         the path of the slip.
         time s   track K   spring K
{}""".format("\n".join(f"         {row}" for row in WIPER)).splitlines()
    return model


def add_step(model: build.Model, displacement: float) -> None:
    """Press, with 1 mV between the electrodes, and request the forces on both."""
    step = model.press(displacement, voltage=1e-3)
    for electrode in ("PLUS", "MINUS"):
        step.node_print(electrode, "RF", totals="ONLY")


if __name__ == "__main__":
    fibre_mat().write(INPUTS / "11_fibre_mat.inp")
    woven_fabric().write(INPUTS / "12_woven_fabric.inp")
    strand().write(INPUTS / "14_strand.inp")
    lap_joint().write(INPUTS / "15_lap_joint.inp")
    bent_strand().write(INPUTS / "16_bent_strand.inp")
    rod_over_drum().write(INPUTS / "18_rod_over_drum.inp")
    knot().write(INPUTS / "17_knot.inp")
    heated_mat().write(INPUTS / "21_heated_mat.inp")
    wiper().write(INPUTS / "22_wiper.inp")
    compacted_cable().write(INPUTS / "24_compacted_cable.inp")
    cable_of_45_strands().write(INPUTS / "25_cable_of_45_strands.inp")
