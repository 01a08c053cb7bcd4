"""Cross-sections that decks describe by their shape: stiffnesses, axes, stresses, and what is refused."""

import re

import numpy as np
import pytest

from litz import Results

E, NU, LENGTH = 210000.0, 0.3, 100.0
G = E / (2 * (1 + NU))

#: A cantilever along x, with a force at its end
DECK = """\
*UNITS, SYSTEM=SI
*NODE, NSET=ALL
 1, 0, 0, 0
 2, 50, 0, 0
 3, 100, 0, 0
*ELEMENT, TYPE={element}, ELSET=BEAM
 1, 1, 2
 2, 2, 3
*MATERIAL, NAME=STEEL
*ELASTIC
 210000, 0.3
{section}
*BOUNDARY
 1, ENCASTRE
*STEP, NLGEOM
*STATIC
*CLOAD
 3, {load}
*EL PRINT, ELSET=BEAM
 S11
*END STEP
"""


@pytest.fixture
def check(litz, tmp_path):
    def of(section, change=("B33", "B31")):
        (tmp_path / "deck.inp").write_text(DECK.format(section=section, element="B33", load="1, 0.").replace(*change))
        return litz("check", "deck.inp", cwd=tmp_path)

    return of


@pytest.fixture
def values(check):
    """A, I2, I3, J, GA2, GA3 of a section, as the program prints them: six digits."""

    def of(shape, data, nu=NU):
        card = f"*BEAM SECTION, ELSET=BEAM, MATERIAL=STEEL, SECTION={shape}\n {', '.join(map(repr, data))}"
        told = check(card, change=(" 210000, 0.3\n", f" 210000, {nu}\n"))
        assert told.returncode == 0, told.stderr
        line = next(line for line in told.stdout.splitlines() if line.startswith("section of BEAM"))
        found = dict(re.findall(r"(\w+) = ([-+.e\d]+) ", line))
        return [float(found[name]) for name in ("A", "I2", "I3", "J", "GA2", "GA3")]

    return of


#: Digits of the program's text
PRINTED = 1e-5


@pytest.mark.parametrize(
    ("ratio", "beta"),
    # Timoshenko and Goodier, Theory of Elasticity, 3rd edition, section 109, table of k1; the first one is known to more
    # digits from its series
    [
        (1, 0.140577),
        (1.2, 0.166),
        (1.5, 0.196),
        (2, 0.229),
        (2.5, 0.249),
        (3, 0.263),
        (4, 0.281),
        (5, 0.291),
        (10, 0.312),
    ],
)
def test_a_rectangle(values, ratio, beta):
    a, b = 2.0, 2.0 * ratio
    area, i2, i3, j, ga2, ga3 = values("RECT", [a, b])
    assert area == pytest.approx(a * b, rel=PRINTED)
    # bending about n1 is stiff by the side along n2
    assert (i2, i3) == pytest.approx((a * b**3 / 12, b * a**3 / 12), rel=PRINTED)
    # the digits of the table
    assert j / (b * a**3) == pytest.approx(beta, abs=5e-7 if ratio == 1 else 6e-4)
    assert values("RECT", [b, a])[3] == j
    # Cowper
    assert (ga2 / (G * area), ga3 / (G * area)) == pytest.approx((10 * 1.3 / 15.3,) * 2, rel=2 * PRINTED)


def test_a_rectangle_of_one_side_is_a_square_as_in_calculix(values):
    assert values("RECT", [3.0]) == values("RECT", [3.0, 3.0])


def test_a_thin_strip_twists_as_thin_walls_do(values):
    j = values("RECT", [100.0, 0.5])[3]
    assert j == pytest.approx(100 * 0.5**3 / 3 * (1 - 0.63025 * 0.5 / 100), rel=PRINTED)


def test_a_pipe(values):
    area, i2, i3, j, ga2, ga3 = values("PIPE", [5.0, 1.0])
    assert area == pytest.approx(np.pi * (25 - 16), rel=PRINTED)
    assert (i2, i3, j) == pytest.approx(np.pi / 4 * (625 - 256) * np.array([1, 1, 2]), rel=PRINTED)
    assert ga2 == ga3
    # full: the circle; thin: Cowper's round tube
    assert values("PIPE", [2.0, 2.0]) == values("CIRC", [2.0])
    area, *_, ga2, _ = values("PIPE", [5.0, 1e-3])
    assert ga2 / (G * area) == pytest.approx(2 * 1.3 / 4.9, rel=1e-4)


def test_a_box(values):
    a, b, t1, t2 = 40.0, 60.0, 2.0, 3.0
    area, i2, i3, j, _, _ = values("BOX", [a, b, t1, t2, t1, t2])
    # walls t1 are on the sides of n1, as long as b
    assert area == pytest.approx(2 * t1 * b + 2 * t2 * (a - 2 * t1), rel=PRINTED)
    wall, plate = 2 * t1 * b**3 / 12, 2 * ((a - 2 * t1) * t2**3 / 12 + (a - 2 * t1) * t2 * ((b - t2) / 2) ** 2)
    assert i2 == pytest.approx(wall + plate, rel=PRINTED)
    wall, plate = 2 * (b * t1**3 / 12 + b * t1 * ((a - t1) / 2) ** 2), 2 * t2 * (a - 2 * t1) ** 3 / 12
    assert i3 == pytest.approx(wall + plate, rel=PRINTED)
    # Bredt: shear flow around the mean line
    enclosed = (a - t1) * (b - t2)
    assert j == pytest.approx(4 * enclosed**2 / (2 * (b - t2) / t1 + 2 * (a - t1) / t2), rel=PRINTED)
    # a thin square tube: side^3 times thickness
    assert values("BOX", [10.0, 10.0, 1e-3, 1e-3, 1e-3, 1e-3])[3] == pytest.approx(10**3 * 1e-3, rel=4e-4)


def test_an_i(values):
    h, b, flange, web = 200.0, 100.0, 8.5, 5.6
    area, i2, i3, j, _, _ = values("I", [h / 2, h, b, b, flange, flange, web])
    # as tables of profiles have an IPE 200 without its fillets
    assert area == pytest.approx(2 * 100 * 8.5 + 183 * 5.6, rel=PRINTED)
    assert i2 == pytest.approx((b * h**3 - (b - web) * 183**3) / 12, rel=PRINTED)
    assert i3 == pytest.approx((2 * flange * b**3 + 183 * web**3) / 12, rel=PRINTED)
    assert j == pytest.approx((2 * b * flange**3 + (h - flange) * web**3) / 3, rel=PRINTED)


def shear_energy_factor(walls, inertia, area):
    """I^2 over A times the integral of Q^2/t along thin walls: the shear factor of the energy of the shear flow."""
    return inertia**2 / (area * sum(walls))


@pytest.mark.parametrize(("h", "b", "flange", "web"), [(100.0, 50.0, 0.1, 0.06), (100.0, 150.0, 0.05, 0.1)])
def test_shear_of_thin_walls_is_that_of_the_energy_where_poisson_s_ratio_is_zero(values, h, b, flange, web):
    """Cowper's factors with nu = 0, against the shear flow integrated here. Walls of 1e-3 of the height are thin."""
    place = np.linspace(0, 1, 20001)

    def integral(moment, thickness, length):
        energy = moment**2 / thickness
        return length * (energy.sum() - (energy[0] + energy[-1]) / 2) / 20000

    # half flanges from their free ends, or from the middle of the plates of a box
    tips = integral(flange * place * b / 2 * h / 2, flange, b / 2)
    inertia = 2 * b * flange * (h / 2) ** 2 + web * h**3 / 12
    y = (place - 0.5) * h
    middle = integral(b * flange * h / 2 + web * ((h / 2) ** 2 - y**2) / 2, web, h)
    area, *_, ga3 = values("I", [(h + flange) / 2, h + flange, b, b, flange, flange, web], nu=0)
    expected = shear_energy_factor([4 * tips, middle], inertia, 2 * b * flange + h * web)
    assert ga3 / (E / 2 * area) == pytest.approx(expected, rel=3e-3)
    inertia = 2 * b * flange * (h / 2) ** 2 + 2 * web * h**3 / 12
    middle = integral(b / 2 * flange * h / 2 + web * ((h / 2) ** 2 - y**2) / 2, web, h)
    area, *_, ga3 = values("BOX", [b + web, h + flange, web, flange, web, flange], nu=0)
    expected = shear_energy_factor([4 * tips, 2 * middle], inertia, 2 * b * flange + 2 * h * web)
    assert ga3 / (E / 2 * area) == pytest.approx(expected, rel=3e-3)


@pytest.mark.parametrize("axis", ["", "\n 0., 1., 0."], ids=["default axis", "axis along y"])
def test_a_cantilever_bends_about_the_axes_of_its_section(litz, tmp_path, axis):
    """The side a = 2 lies along n1: along z by default, as in Abaqus, where n1 is (0, 0, -1)."""
    section = "*BEAM SECTION, ELSET=BEAM, MATERIAL=STEEL, SECTION=RECT\n 2., 6." + axis
    along_z = 6 if axis else 2
    for dof, depth in ((2, 8 - along_z), (3, along_z)):
        (tmp_path / "deck.inp").write_text(DECK.format(section=section, element="B33", load=f"{dof}, 1e-3"))
        assert litz("run", "deck.inp", "-o", f"out{dof}", cwd=tmp_path).returncode == 0
        sag = 1e-3 * LENGTH**3 / (3 * E * (12 / depth) * depth**3 / 12)
        # a deflection of at most 4e-6 of the length
        assert Results(tmp_path / f"out{dof}").field("displacement")[2, dof - 1] == pytest.approx(sag, rel=1e-8)


def test_the_largest_stress_of_a_rectangle_is_at_its_corner(litz, tmp_path):
    section = "*BEAM SECTION, ELSET=BEAM, MATERIAL=STEEL, SECTION=RECT\n 2., 6."
    load = "1, 12.\n 3, 2, 1e-3\n 3, 3, 2e-3"
    (tmp_path / "deck.inp").write_text(DECK.format(section=section, element="B33", load=load))
    assert litz("run", "deck.inp", "-o", "out", cwd=tmp_path).returncode == 0
    stress = 12 / 12 + 1e-3 * LENGTH / (2 * 6**2 / 6) + 2e-3 * LENGTH / (6 * 2**2 / 6)
    # the tension takes moment as the beam bends: its arm is the deflection, at most 8e-4, over 12 of area
    assert Results(tmp_path / "out").field("stress_max")[0] == pytest.approx(stress, rel=1e-2)


@pytest.mark.parametrize("material", [True, False])
@pytest.mark.parametrize("axis", [" 0., 0., -1.", "", "** none\n  \n** of its own", " , ,"])
@pytest.mark.parametrize("warping", ["", ", 0., 0.", ", 0."])
def test_a_general_section_of_abaqus(litz, tmp_path, material, axis, warping):
    """E and G on its third line, or a material; the first axis comes before, or a line without it, which is (0, 0, -1)."""
    head = "*BEAM GENERAL SECTION, ELSET=BEAM, SECTION=GENERAL"
    data = f" 12., 36., 0., 4., 12.5{warping}\n{axis}"
    section = f"{head}, MATERIAL=STEEL\n{data}" if material else f"{head}\n{data}\n 210000., 80769.23076923"
    text = DECK.format(section=section, element="B33", load="2, 1e-3\n 3, 4, 1.")
    if not material:
        text = text.replace("*MATERIAL, NAME=STEEL\n*ELASTIC\n 210000, 0.3\n", "")
    (tmp_path / "deck.inp").write_text(text)
    done = litz("run", "deck.inp", "-o", "out", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    results = Results(tmp_path / "out")
    assert results.field("displacement")[2, 1] == pytest.approx(1e-3 * LENGTH**3 / (3 * E * 36), rel=1e-4)
    assert results.field("rotation")[2, 0] == pytest.approx(1.0 * LENGTH / (G * 12.5), rel=1e-6)


@pytest.mark.parametrize("element", ["B33", "B31"])
@pytest.mark.parametrize(
    "section",
    [
        "CIRC{}\n 2.",
        "RECT{}\n 2., 6.",
        "GENERAL{}\n 12., 36., 0., 4., 12.5\n 0, 0, -1\n*TRANSVERSE SHEAR STIFFNESS\n 3e5, 2e5",
    ],
)
def test_beams_have_a_factor_of_their_stiffness(litz, tmp_path, element, section):
    """A quarter of all stiffnesses moves under a quarter of the load as all of them do under all of it."""
    moved = []
    for name, factor, part in (("whole", "", 1.0), ("quarter", ", STIFFNESS=0.25", 0.25)):
        card = "*BEAM SECTION, ELSET=BEAM, MATERIAL=STEEL, SECTION=" + section.format(factor)
        load = "\n".join(f" 3, {dof}, {part * force}" for dof, force in enumerate((12, 1e-3, 2e-3, 2e-2), 1))
        deck = DECK.format(section=card, element=element, load=load.lstrip(" ")[3:])
        (tmp_path / "deck.inp").write_text(deck)
        done = litz("run", "deck.inp", "-o", name, cwd=tmp_path)
        assert done.returncode == 0, done.stderr
        results = Results(tmp_path / name)
        moved.append(np.column_stack([results.field("displacement")[1:], results.field("rotation")[1:]]))
    np.testing.assert_allclose(moved[1], moved[0], rtol=1e-8)


def test_a_factor_of_stiffness_is_told_and_greater_than_zero(check):
    card = "*BEAM SECTION, ELSET=BEAM, MATERIAL=STEEL, SECTION=CIRC, STIFFNESS={}\n 2."
    told = re.search(r"stiffnesses times ([-+.eE\d]+)", check(card.format("0.25")).stdout)
    assert float(told[1]) == 0.25
    assert "stiffnesses" not in check(card.format("1")).stdout
    for wrong in ("0", "-1"):
        done = check(card.format(wrong))
        assert done.returncode == 1
        assert "it must be greater than 0" in done.stderr


#: Section card and data, what is said
REFUSED = {
    "box without room": ("SECTION=BOX\n 4, 60, 2, 3, 2, 3", "leave no room between them"),
    "pipe thicker than its radius": ("SECTION=PIPE\n 2, 3", "at most as thick as its outer radius, 2; found 3"),
    "I of unlike flanges": ("SECTION=I\n 100, 200, 100, 80, 8, 8, 5", "both flanges of an I must be alike"),
    "I without a web": ("SECTION=I\n 5, 10, 100, 100, 5, 5, 5", "leave no room for its web"),
    "trapezoid": ("SECTION=TRAPEZOID\n 4, 4, 4, 1", "use GENERAL with A, I11"),
    "shear factor in place of J": (
        "SECTION=GENERAL\n 12., 0.36, 0., 0.04, 0.85",
        "no section has the torsion constant J",
    ),
    "nodal thickness": ("SECTION=RECT, NODAL THICKNESS\n 2, 6", "a section is the same along an element"),
    "zero axis": ("SECTION=RECT\n 2, 6\n 0, 0, 0", "the first section axis n1 is zero"),
    "axis along the beam": ("SECTION=RECT\n 2, 6\n 1, 0, 0", "n1 is parallel to element 1"),
    "material missing": ("SECTION=RECT\n 2, 6", "*BEAM SECTION needs the parameter MATERIAL"),
}


@pytest.mark.parametrize("case", REFUSED)
def test_sections_that_are_refused(check, case):
    section, message = REFUSED[case]
    material = "" if case == "material missing" else ", MATERIAL=STEEL"
    told = check(f"*BEAM SECTION, ELSET=BEAM{material}, {section}")
    assert told.returncode == 1
    assert message in told.stderr
    assert told.stderr.count("error: ") == 1, told.stderr


@pytest.mark.parametrize(
    ("section", "message"),
    [
        (" 12, 36, 0, 4, 12.5\n 0, 0, -1\n 210000, 1000", "Poisson's ratio, is 104; it must be between -1 and 0.5"),
        (" 12, 36, 0, 4, 12.5\n 0, 0, -1", "needs a MATERIAL, or three data lines"),
        (
            " 12, 36, 0, 4, 12.5\n 210000, 80000",
            "three data lines: dimensions, the first axis n1 or a blank line, and E, G",
        ),
        (
            " 12, 36, 0, 4, 12.5, 0, 7\n\n 210000, 80000",
            "litz has no warping of sections: its constants behind J must be 0",
        ),
        (
            " 12, 36, 0, 4, 12.5, 7\n\n 210000, 80000",
            "litz has no warping of sections: its constants behind J must be 0",
        ),
        (" 12, 36, 13, 4, 12.5\n 0, 0, -1\n 210000, 80000", "no section has the product of inertia I12 = 13"),
    ],
)
def test_general_sections_that_are_refused(check, section, message):
    change = ("*MATERIAL, NAME=STEEL\n*ELASTIC\n 210000, 0.3\n", "")
    told = check(f"*BEAM GENERAL SECTION, ELSET=BEAM\n{section}", change=change)
    assert told.returncode == 1
    assert message in told.stderr
    assert told.stderr.count("error: ") == 1, told.stderr


def test_a_section_along_z_needs_its_first_axis(check):
    """Abaqus's default (0, 0, -1) is along the beam."""
    upright = ("2, 50, 0, 0\n 3, 100, 0, 0", "2, 0, 0, 50\n 3, 0, 0, 100")
    told = check("*BEAM SECTION, ELSET=BEAM, MATERIAL=STEEL, SECTION=RECT\n 2, 6", change=upright)
    assert told.returncode == 1
    assert "n1 (0, 0, -1 without a second data line) is parallel to element 1" in told.stderr
    round_one = check("*BEAM SECTION, ELSET=BEAM, MATERIAL=STEEL, SECTION=CIRC\n 2", change=upright)
    assert round_one.returncode == 0, round_one.stderr


def test_sections_that_are_not_round_touch_where_a_contact_radius_is_given(check):
    """Laws of contact are those of round surfaces."""
    pair = "*SURFACE INTERACTION, NAME=TOUCH\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HERTZ\n"
    pair += "*CONTACT PAIR, INTERACTION=TOUCH\n BEAM"
    for shape in ("RECT\n 2, 6", "PIPE\n 2, 0.5"):
        told = check(f"*BEAM SECTION, ELSET=BEAM, MATERIAL=STEEL, SECTION={shape}\n{pair}")
        assert told.returncode == 1
        assert "can touch others here, but its *BEAM SECTION of BEAM has no CONTACT RADIUS" in told.stderr
        card = f"*BEAM SECTION, ELSET=BEAM, MATERIAL=STEEL, CONTACT RADIUS=1, SECTION={shape}\n{pair}"
        assert check(card).returncode == 0


@pytest.mark.parametrize(("given", "load"), [("200., 1e9", "2, 1."), ("1e9, 200.", "3, 1.")])
def test_the_first_shear_stiffness_is_for_forces_along_the_second_axis(litz, tmp_path, given, load):
    """As Abaqus orders them: K23, K13. A cantilever that shears alone, n1 along z and n2 along -y."""
    section = "*BEAM SECTION, ELSET=BEAM, MATERIAL=STEEL, SECTION=RECT\n 60, 60\n 0, 0, 1\n"
    section += f"*TRANSVERSE SHEAR STIFFNESS\n {given}, 0.25"
    (tmp_path / "deck.inp").write_text(DECK.format(section=section, element="B31", load=load))
    done = litz("run", "deck.inp", "-o", "out", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    deflection = Results(tmp_path / "out").field("displacement")[2, int(load[0]) - 1]
    # F L/K; bending and large displacements add less
    assert deflection == pytest.approx(LENGTH / 200, rel=1e-4)


def test_shear_stiffness_follows_a_general_section(check):
    told = check(
        "*BEAM GENERAL SECTION, ELSET=BEAM, MATERIAL=STEEL\n 12, 36, 0, 4, 12.5\n*TRANSVERSE SHEAR STIFFNESS\n 1e5, 2e5"
    )
    assert told.returncode == 0, told.stderr
    assert "GA2 = 200000 N, GA3 = 100000 N" in told.stdout
