"""Sections whose centroid or shear centre is beside the node, or whose axes are not principal ones: L, unlike boxes, offsets."""

import itertools
import math
import re

import numpy as np
import pytest

from litz import General, Results

E, NU, LENGTH = 210000.0, 0.3, 1000.0
G = E / (2 * (1 + NU))
#: a, b, t1, t2
LEGS = (40.0, 60.0, 3.0, 5.0)


class Polygons:
    """Moments of an area of rectangles (x1, x2 from, to; sign), integrated by Green's theorem along their outline."""

    def __init__(self, *rectangles):
        self.area, self.first, self.second = 0.0, np.zeros(2), np.zeros((2, 2))
        place, weight = np.polynomial.legendre.leggauss(6)
        for (left, right, low, high), sign in rectangles:
            for x, wx in zip(place, weight, strict=True):
                for y, wy in zip(place, weight, strict=True):
                    point = np.array([left + right + x * (right - left), low + high + y * (high - low)]) / 2
                    part = sign * wx * wy * (right - left) * (high - low) / 4
                    self.area += part
                    self.first += part * point
                    self.second += part * np.outer(point, point)
        self.centroid = self.first / self.area
        #: Integrals of x_i x_j about the centroid
        self.second -= self.area * np.outer(self.centroid, self.centroid)


def l_area(a, b, t1, t2):
    return Polygons(((-t2 / 2, a - t2 / 2, -t1 / 2, t1 / 2), 1), ((-t2 / 2, t2 / 2, t1 / 2, b - t1 / 2), 1))


def l_torsion(a, b, t1, t2):
    return ((a - t2 / 2) * t1**3 + (b - t1 / 2) * t2**3) / 3


def deck(section, loads, n=4, element="B33", parameters="", more="", ask=""):
    """A cantilever along x whose section axes n1 and n2 are y and z."""
    nodes = "".join(f" {i + 1}, {LENGTH * i / n!r}, 0, 0\n" for i in range(n + 1))
    elements = "".join(f" {i}, {i}, {i + 1}\n" for i in range(1, n + 1))
    return (
        f"*UNITS, SYSTEM=SI\n*NODE\n{nodes}*ELEMENT, TYPE={element}, ELSET=BEAM\n{elements}"
        f"*MATERIAL, NAME=STEEL\n*ELASTIC\n {E}, {NU}\n*EXPANSION\n 1e-5\n"
        f"*BEAM SECTION, ELSET=BEAM, MATERIAL=STEEL, SECTION={section[0]}{parameters}\n {section[1]}\n 0, 1, 0\n{more}"
        f"*BOUNDARY\n 1, ENCASTRE\n*STEP, NLGEOM, INC=100\n*STATIC\n{loads}*EL PRINT, ELSET=BEAM\n SF{ask}\n*END STEP\n"
    )


@pytest.fixture
def tip(litz, tmp_path):
    """Displacement and rotation of the end of a run, and its results."""
    number = itertools.count()

    def of(text, node=None):
        name = f"deck{next(number)}"
        (tmp_path / f"{name}.inp").write_text(text)
        done = litz("run", f"{name}.inp", "-o", name, cwd=tmp_path)
        assert done.returncode == 0, done.stderr
        results = Results(tmp_path / name)
        row = -1 if node is None else list(results.field("node_id")).index(node)
        return results.field("displacement")[row], results.field("rotation")[row], results

    return of


def lines_of(node, values):
    """Lines of *CLOAD for forces and moments along 1 to 6."""
    return "*CLOAD\n" + "".join(f" {node}, {dof}, {float(value)!r}\n" for dof, value in enumerate(values, 1) if value)


L = ("L", ", ".join(map(str, LEGS)))
#: Forces so small that deflections are linear to 1e-6
SMALL = 1e-4
#: Axial forces: stretch that is a million times the round-off of the places of nodes, and 1e-7 of the buckling load
PULL = 0.01


@pytest.mark.parametrize("force", [(1.0, 0.0), (0.0, 1.0), (0.6, -0.8)])
def test_an_l_bends_out_of_the_plane_of_its_load(tip, force):
    """A force at the node, which is the shear centre: L^3/(3 E) I^-1 F, no twist; fibres at the centroid keep their length."""
    area = l_area(*LEGS)
    u, rotation, _ = tip(deck(L, lines_of(5, [0, *(SMALL * np.array(force))])))
    expected = SMALL * LENGTH**3 / (3 * E) * np.linalg.solve(area.second, force)
    np.testing.assert_allclose(u[1:], expected, rtol=1e-6, atol=1e-6 * np.abs(expected).max())
    # both components are there: a fifth of the larger one at least
    assert np.abs(expected).min() > 0.2 * np.abs(expected).max() or force == (0.6, -0.8)
    assert abs(rotation[0]) < 1e-5 * np.abs(rotation[1:]).max()
    slope = 1.5 * expected / LENGTH
    assert u[0] == pytest.approx(slope @ area.centroid, rel=1e-5)


def test_a_force_at_the_centroid_twists_an_l(tip):
    """That is the force at the node and its moment about it: T = y1 F2 - y2 F1."""
    area = l_area(*LEGS)
    force = SMALL * np.array([0.0, 1.0])
    torque = area.centroid[0] * force[1] - area.centroid[1] * force[0]
    u, rotation, _ = tip(deck(L, lines_of(5, [0, *force, torque])))
    assert rotation[0] == pytest.approx(torque * LENGTH / (G * l_torsion(*LEGS)), rel=1e-5)
    np.testing.assert_allclose(u[1:], LENGTH**3 / (3 * E) * np.linalg.solve(area.second, force), rtol=1e-4)


@pytest.mark.parametrize("element", ["B33", "B31"])
def test_an_axial_force_at_the_node_bends_an_l(tip, element):
    """Its moment about the centroid is constant: curvature E I k = N c; at the centroid it would only stretch."""
    area = l_area(*LEGS)
    curvature = PULL / E * np.linalg.solve(area.second, area.centroid)
    u, _, results = tip(deck(L, lines_of(5, [PULL]), element=element, ask=", SFN, SE, SK, E11, S11"))
    np.testing.assert_allclose(u[1:], curvature * LENGTH**2 / 2, rtol=1e-6)
    stretch = PULL / (E * area.area)
    assert u[0] / LENGTH == pytest.approx(stretch + curvature @ area.centroid, rel=1e-6)
    # N and moments at the centroid, strains of fibres at the corners
    assert results.field("axial_force")[0] == pytest.approx(PULL, rel=2e-6)
    assert results.field("axial_strain")[0] == pytest.approx(stretch, rel=1e-6)
    moments = [results.field(f"bending_moment_{i}")[0] for i in (2, 3)]
    np.testing.assert_allclose(moments, PULL * np.array([-area.centroid[1], area.centroid[0]]), rtol=1e-6)
    np.testing.assert_allclose(results.field("end_moment_1")[0], [0, *moments], atol=1e-6 * PULL * 20)
    curvatures = [results.field(f"curvature_{i}")[0] for i in (2, 3)]
    np.testing.assert_allclose(curvatures, [-curvature[1], curvature[0]], rtol=1e-6)
    a, b, t1, t2 = LEGS
    corners = np.array([(-t2, -t1), (2 * a - t2, -t1), (2 * a - t2, t1), (t2, 2 * b - t1), (-t2, 2 * b - t1)]) / 2
    fibres = stretch - (corners - area.centroid) @ curvature
    assert results.field("strain_max")[0] == pytest.approx(fibres.max(), rel=1e-5)
    assert results.field("strain_min")[0] == pytest.approx(fibres.min(), rel=1e-5)
    assert results.field("stress_max")[0] == pytest.approx(E * fibres.max(), rel=1e-5)


def test_an_axial_force_at_the_centroid_only_stretches_an_l(tip):
    area = l_area(*LEGS)
    loads = lines_of(5, [PULL, 0, 0, 0, PULL * area.centroid[1], -PULL * area.centroid[0]])
    u, _, _ = tip(deck(L, loads))
    stretch = PULL * LENGTH / (E * area.area)
    np.testing.assert_allclose(u, [stretch, 0, 0], atol=1e-6 * stretch)


def test_a_warm_l_gets_longer_and_stays_straight(tip):
    u, _, _ = tip(deck(L, "*TEMPERATURE\n ALL, 50\n", more="*NSET, NSET=ALL, GENERATE\n 1, 5\n"))
    np.testing.assert_allclose(u, [5e-4 * LENGTH, 0, 0], atol=1e-9 * LENGTH)


def test_b31_adds_the_shear_of_both_legs(tip):
    """A short angle of equal legs, bent in its symmetry plane: energy of the shear flow, integrated here."""
    leg, t, n = 40.0, 2.0, 64
    # V across the axis of symmetry and along it; the flow from the free ends over mean lines
    middle = leg - t / 2
    area = l_area(leg, leg, t, t)
    shear = {}
    for sign in (1, -1):
        axis = np.array([1, sign]) / np.sqrt(2)
        s = np.linspace(0, middle, 20001)
        places = np.array([[middle - s, 0 * s], [0 * s, middle - s]])
        mean = np.array([1, 1]) * middle / 4
        along = [axis @ (one - mean[:, None]) for one in places]
        inertia = 2 * t * np.trapezoid(along[0] ** 2, s)
        flow = (
            np.array([t * np.concatenate([[0], np.cumsum((y[1:] + y[:-1]) / 2 * (s[1] - s[0]))]) for y in along])
            / inertia
        )
        shear[sign] = sum(np.trapezoid(one**2 / t, s) for one in flow)
    short = 60.0
    for sign in (1, -1):
        axis = np.array([1, sign]) / np.sqrt(2)
        text = deck(("L", f"{leg}, {leg}, {t}, {t}"), lines_of(n + 1, [0, *(SMALL * axis)]), n=n, element="B31")
        for i in range(n + 1):
            text = text.replace(f" {i + 1}, {LENGTH * i / n!r}, 0, 0\n", f" {i + 1}, {short * i / n!r}, 0, 0\n")
        u, _, _ = tip(text)
        inertia = axis @ area.second @ axis
        bending, shearing = short**3 / (3 * E * inertia), short * shear[sign] / G
        assert shearing > 0.04 * bending
        # the element has the moment of its middle: 1/(4 n^2) of the bending; walls that are a twentieth as thick as long
        # have areas that differ from those of their mean lines by 1e-3
        assert u[1:] @ axis / SMALL == pytest.approx(bending * (1 - 1 / (4 * n**2)) + shearing, rel=2e-4)


def test_a_general_section_has_its_product_of_inertia(tip):
    """The numbers of the L, at the centroid: the same bending out of the plane, no twist and no axial coupling."""
    area = l_area(*LEGS)
    data = f"{area.area}, {area.second[1, 1]}, {area.second[0, 1]}, {area.second[0, 0]}, {l_torsion(*LEGS)}"
    force = SMALL * np.array([1.0, 0.5])
    for element, n, tolerance in (("B33", 4, 1e-6), ("B31", 64, 2e-6)):
        u, rotation, _ = tip(deck(("GENERAL", data), lines_of(n + 1, [0, *force]), n=n, element=element))
        expected = LENGTH**3 / (3 * E) * np.linalg.solve(area.second, force)
        if element == "B31":
            # the moment of the middle of each element, and the shear of the whole area
            expected = expected * (1 - 1 / (4 * n**2)) + force * LENGTH / (G * area.area)
        np.testing.assert_allclose(u, [0, *expected], rtol=tolerance, atol=1e-5 * np.abs(expected).max())
        assert abs(rotation[0]) < 1e-6 * np.abs(rotation[1:]).max()


def test_a_general_section_with_centroid_and_shear_centre_is_the_l(tip):
    """All numbers given: the node where it is, the same bending and twist as the shape has."""
    area = l_area(*LEGS)
    data = f"{area.area}, {area.second[1, 1]}, {area.second[0, 1]}, {area.second[0, 0]}, {l_torsion(*LEGS)}"
    loads = lines_of(5, [300.0, 20.0, -30.0, 500.0, 2e4])
    u, rotation, _ = tip(deck(L, loads))
    more = f"*CENTROID\n {area.centroid[0]}, {area.centroid[1]}\n"
    v, turned, _ = tip(deck(("GENERAL", data), loads, more=more))
    # both runs converge to residuals of round-off
    np.testing.assert_allclose([*u, *rotation], [*v, *turned], rtol=1e-5)
    # shifted by hand: the node on the other side of the section, loads moved to the same place
    shift = np.array([-7.0, 11.0])
    more = (
        f"*SHEAR CENTER\n {shift[0]}, {shift[1]}\n*CENTROID\n {area.centroid[0] + shift[0]}, {area.centroid[1] + shift[1]}\n"
        f"*NODE\n 99, {LENGTH}, {shift[0]}, {shift[1]}\n*NSET, NSET=TIP\n 5\n*RIGID BODY, REF NODE=99, TIE NSET=TIP\n"
    )
    w, turned, _ = tip(deck(("GENERAL", data), loads.replace(" 5, ", " 99, "), more=more), node=99)
    np.testing.assert_allclose([*u, *rotation], [*w, *turned], rtol=1e-5)


@pytest.mark.parametrize("side", [0, 1])
def test_a_box_of_unlike_walls(tip, side):
    """Along its axis of symmetry; the shear centre is where the energy of the shear flow does not change with the twist."""
    a, b, thin, thick = 40.0, 60.0, 1.0, 3.0
    # the wall at n1, or at n2, is thicker than the one opposite to it
    walls = [thick, 2.0, thin, 2.0] if side == 0 else [2.0, thick, 2.0, thin]
    t1, t2, t3, t4 = walls
    area = Polygons(((-a / 2, a / 2, -b / 2, b / 2), 1), ((-a / 2 + t3, a / 2 - t1, -b / 2 + t4, b / 2 - t2), -1))
    assert area.centroid[side] > 1
    section = ("BOX", f"{a}, {b}, {t1}, {t2}, {t3}, {t4}")
    u, _, _ = tip(deck(section, lines_of(5, [SMALL])))
    curvature = SMALL / E * np.linalg.solve(area.second, area.centroid)
    np.testing.assert_allclose(u[1:], curvature * LENGTH**2 / 2, rtol=1e-5, atol=1e-9 * LENGTH * SMALL)
    # a force across the axis of symmetry, at the node: shear flow of mean lines with constant start
    width, height = (a - (t1 + t3) / 2, b - (t2 + t4) / 2)
    h, web = ((height, (thick, thin)), (width, (thick, thin)))[side]
    flange, along = (2.0, width) if side == 0 else (2.0, height)
    inertia = 2 * flange * along * (h / 2) ** 2 + sum(web) * h**3 / 12
    s = np.linspace(0, 1, 4001)
    # from the middle of the thick web outwards, cut there: antisymmetric walls, the cut has a flow q0
    half = h / 2 * s
    q_thick = -web[0] * half**2 / 2
    q_flange = q_thick[-1] - flange * along * s * h / 2
    q_thin = q_flange[-1] - web[1] * (h / 2 * half - half**2 / 2)

    def integral(y, length):
        return np.trapezoid(y, s) * length

    around = 2 * (
        integral(q_thick, h / 2) / web[0] + integral(q_flange, along) / flange + integral(q_thin, h / 2) / web[1]
    )
    q0 = -around / (h / web[0] + 2 * along / flange + h / web[1])
    force = 2 * integral(q_thick + q0, h / 2) - 2 * integral(q_thin + q0, h / 2)
    moment = 2 * integral(q_thick + q0, h / 2) * along + 2 * integral(q_flange + q0, along) * h / 2
    # about the corner of the thin web: its arm gives the shear centre from the mean line of the thin web
    arm = moment / force
    middle = (-a / 2 + t3 / 2) if side == 0 else (-b / 2 + t4 / 2)
    centre = middle + arm
    torsion = 4 * (width * height) ** 2 / (height / t1 + width / t2 + height / t3 + width / t4)
    torsion += (height * (t1**3 + t3**3) + width * (t2**3 + t4**3)) / 3
    assert inertia > 0
    values = [0, 0, SMALL] if side == 0 else [0, SMALL]
    _, rotation, _ = tip(deck(section, lines_of(5, values)))
    torque = -centre * SMALL * (1 if side == 0 else -1)
    assert rotation[0] == pytest.approx(torque * LENGTH / (G * torsion), rel=1e-4)


def test_an_i_whose_node_is_on_its_lower_side(tip):
    """Bending by an axial force at h/2 from the centroid."""
    u, _, results = tip(deck(("I", "0.001, 200, 100, 100, 8.5, 8.5, 5.6"), lines_of(5, [PULL]), ask=", SE"))
    area = 2 * 100 * 8.5 + 183 * 5.6
    inertia = (100 * 200**3 - (100 - 5.6) * 183**3) / 12
    assert u[2] == pytest.approx(PULL * 99.999 * LENGTH**2 / (2 * E * inertia), rel=1e-6)
    assert results.field("axial_strain")[0] == pytest.approx(PULL / (E * area), rel=1e-6)


RECT = ("RECT", "20, 50")


@pytest.mark.parametrize("element", ["B31", "B33"])
def test_a_beam_beside_its_nodes_is_one_on_rigid_arms(tip, element):
    """OFFSET as CalculiX has it, the node so many sides from the middle, against a rigid body, at large rotations."""
    offset = np.array([0.7, -1.5])
    arm = -offset * [20, 50]
    parameters = f", OFFSET1={offset[0]}, OFFSET2={offset[1]}"
    loads = lines_of(5, [-2e4, 1.5e4, 2.5e4, 4e6, -3e6, 2e6])
    u, rotation, results = tip(deck(RECT, loads, element=element, parameters=parameters))
    assert np.abs(rotation).max() > 1
    more = f"*NODE\n 99, {LENGTH}, {-arm[0]}, {-arm[1]}\n*NSET, NSET=TIP\n 5\n*RIGID BODY, REF NODE=99, TIE NSET=TIP\n"
    other = deck(RECT, loads.replace(" 5, ", " 99, "), element=element, more=more)
    v, turned, reference = tip(other, node=99)
    np.testing.assert_allclose(u, v, rtol=1e-6)
    np.testing.assert_allclose(rotation, turned, rtol=1e-6)
    for name in ("axial_force", "shear_force_2", "torsion_moment", "bending_moment_2", "bending_moment_3"):
        expected = reference.field(name)[:4]
        np.testing.assert_allclose(results.field(name), expected, rtol=1e-5, atol=1e-6 * np.abs(expected).max())


def test_two_beams_on_the_same_nodes_are_a_composite(tip):
    """A stiff one above the nodes and a soft one below: the deck beamcom of CalculiX's tests."""
    text = deck(RECT, lines_of(5, [SMALL]), parameters=", OFFSET2=-0.5")
    soft = (
        "*ELEMENT, TYPE=B33, ELSET=SOFT\n" + "".join(f" {10 + i}, {i}, {i + 1}\n" for i in range(1, 5)) +
        "*MATERIAL, NAME=SOFT\n*ELASTIC\n 110000, 0.3\n*BEAM SECTION, ELSET=SOFT, MATERIAL=SOFT, SECTION=RECT, OFFSET2=0.5\n"
        " 20, 50\n 0, 1, 0\n"
    )  # fmt: skip
    u, _, _ = tip(text.replace("*BOUNDARY", soft + "*BOUNDARY"))
    stiffness = np.array([E, 110000]) * 1000
    middle = stiffness @ [25, -25] / stiffness.sum()
    bending = np.array([E, 110000]).sum() * 20 * 50**3 / 12 + stiffness @ (np.array([25, -25]) - middle) ** 2
    assert u[2] == pytest.approx(SMALL * middle * LENGTH**2 / (2 * bending), rel=1e-6)
    assert u[2] > 0


#: What is refused, and why
REFUSED = {
    "legs without length": (("L", "3, 60, 3, 5"), "", "the legs of the L are no longer than the other one is thick"),
    "walls of a box": (("BOX", "10, 60, 8, 2, 3, 2"), "", "t1 + t3 must be smaller than a"),
    "product of inertia": (("GENERAL", "10, 4, 3, 2, 5"), "", "no section has the product of inertia I12 = 3"),
    "offset without sides": (("GENERAL", "10, 4, 0, 2, 5"), ", OFFSET1=0.5", "OFFSET1 and OFFSET2 count sides"),
}


@pytest.mark.parametrize("case", REFUSED)
def test_refused(litz, tmp_path, case):
    section, parameters, message = REFUSED[case]
    (tmp_path / "deck.inp").write_text(deck(section, "", parameters=parameters))
    told = litz("check", "deck.inp", cwd=tmp_path)
    assert told.returncode == 1
    assert message in told.stderr
    assert told.stderr.count("error: ") == 1, told.stderr


def test_centroids_are_given_for_general_sections_with_an_axis(litz, tmp_path):
    general = deck(("GENERAL", "10, 4, 0, 2, 5"), "", more="*CENTROID\n 1, 0\n")
    for text, message in (
        (deck(L, "", more="*SHEAR CENTER\n 1, 0\n"), "*SHEAR CENTER is for SECTION=GENERAL"),
        (general.replace(" 0, 1, 0\n", ""), "*CENTROID is along the section axes: give the first one"),
    ):
        (tmp_path / "deck.inp").write_text(text)
        told = litz("check", "deck.inp", cwd=tmp_path)
        assert message in told.stderr
        assert told.stderr.count("error: ") == 1, told.stderr


def test_python_has_general_sections_with_all_of_them():
    axis = (0.0, 1.0, 0.0)
    section = General(10, 4, 2, 5, n1=axis, i12=1, centroid=[1, 2], shear_center=[3, 4])
    cards = list(section.cards("BEAM", "STEEL"))
    assert cards[0][2] == [[10, 4, 1, 2, 5], [0, 1, 0]]
    assert [(name, rows) for name, _, rows in cards[1:]] == [("CENTROID", [[1, 2]]), ("SHEAR CENTER", [[3, 4]])]
    with pytest.raises(ValueError, match="give n1"):
        General(10, 4, 2, 5, centroid=[1, 2])


def test_shear_stiffnesses_are_given_along_principal_axes(litz, tmp_path):
    (tmp_path / "deck.inp").write_text(deck(L, "", more="*TRANSVERSE SHEAR STIFFNESS\n 1e5, 1e5\n"))
    told = litz("check", "deck.inp", cwd=tmp_path)
    assert "shear stiffnesses along n1 and n2 are given where these are principal axes" in told.stderr


def test_a_round_wire_beside_its_nodes_touches_where_a_contact_radius_is_given(litz, tmp_path):
    more = "*SURFACE INTERACTION, NAME=TOUCH\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HERTZ\n"
    more += "*CONTACT PAIR, INTERACTION=TOUCH\n BEAM\n"
    (tmp_path / "deck.inp").write_text(deck(("CIRC", "5"), "", parameters=", OFFSET1=0.5", more=more))
    told = litz("check", "deck.inp", cwd=tmp_path)
    assert "has no CONTACT RADIUS" in told.stderr


def test_a_check_tells_where_the_axes_and_centres_of_an_l_are(litz, tmp_path):
    (tmp_path / "deck.inp").write_text(deck(("L", ", ".join(map(str, LEGS))), "*CLOAD\n 5, 2, 1\n"))
    told = litz("check", "deck.inp", cwd=tmp_path)
    line = next(line for line in told.stdout.splitlines() if line.startswith("section of BEAM"))
    found = re.search(r"turned by (\S+) degrees from n1, centroid \((\S+), (\S+)\) m and shear centre \(0, 0\) m", line)
    (i22, i12), (_, i11) = l_area(*LEGS).second
    assert math.tan(math.radians(2 * float(found[1]))) == pytest.approx(2 * i12 / (i22 - i11), rel=1e-5)
    assert [float(found[2]), float(found[3])] == pytest.approx(l_area(*LEGS).centroid, rel=1e-5)
