"""`litz convert` of whole decks of Abaqus and CalculiX: what litz has stays, the rest is told and becomes a comment."""

import re

import numpy as np
import pytest

from in_process import command
from litz import Results
from test_cli import command as process

#: As Abaqus/CAE writes a model of a part with two instances, the second one turned about z and shifted
CAE = """\
*Heading
** Job name: Job-1 Model name: Model-1
*Preprint, echo=NO, model=NO, history=NO, contact=NO
*Part, name=Bar
*Node
 1, 0., 0., 0.
 2, 50., 0., 0.
 3, 100., 0., 0.
*Element, type=B33
1, 1, 2
2, 2, 3
*Nset, nset=Set-1, generate
 1, 3, 1
*Elset, elset=Set-1, generate
 1, 2, 1
** Section: Section-1
*Beam Section, elset=Set-1, material=Steel, temperature=GRADIENTS, section=RECT
2., 6.
0.,1.,0.
*End Part
*Assembly, name=Assembly
*Instance, name=Bar-1, part=Bar
*End Instance
*Instance, name=Bar-2, part=Bar
 0., 0., 40.
 0., 0., 40., 0., 0., 41., 90.
*End Instance
*Nset, nset=Roots, instance=Bar-1
 1,
*Nset, nset=Roots, instance=Bar-2
 1,
*Nset, nset=Tip-2, instance=Bar-2
 3,
*End Assembly
*Amplitude, name=Amp-1
0., 0., 1., 1.
*Material, name=Steel
*Elastic
210000., 0.3
*Boundary
Roots, ENCASTRE
*Step, name=Modes, perturbation
*Frequency, eigensolver=Lanczos
10, , , , ,
*End Step
*Step, name=Load, nlgeom=YES
*Static
1., 1., 1e-05, 1.
*Cload, amplitude=Amp-1
Bar-1.3, 3, 1e-3
Tip-2, 3, 2e-3
*Output, field, variable=PRESELECT
*End Step
"""


@pytest.fixture
def convert(litz, tmp_path):
    """Converts a text; a deck without a word of what is missing is one that the program takes."""

    def of(text, *options):
        (tmp_path / "foreign.inp").write_text(text)
        (tmp_path / "new.inp").unlink(missing_ok=True)
        done = command("convert", "foreign.inp", "new.inp", *options, cwd=tmp_path)
        is_complete = done.returncode == 0 and "supports, contacts and loads are missing" not in done.stdout
        assert not is_complete or litz("check", "new.inp", cwd=tmp_path).returncode == 0
        return done, (tmp_path / "new.inp").read_text() if (tmp_path / "new.inp").exists() else ""

    return of


def test_supports_loads_amplitudes_and_steps_are_kept_and_the_deck_runs(convert, litz, tmp_path):
    done, _ = convert(CAE)
    assert done.returncode == 0, done.stderr
    run = litz("run", "new.inp", "-o", "out", cwd=tmp_path)
    assert run.returncode == 0, run.stderr
    results = Results(tmp_path / "out")
    place, moved = results.field("reference_position"), results.field("displacement")
    np.testing.assert_allclose(place[3:], [[0, 0, 40], [0, 50, 40], [0, 100, 40]], atol=1e-12)
    # n1 lies along y, and along -x where it was turned: the side of 6 is the depth of both for forces along z
    sag = 1e-3 * 100**3 / (3 * 210000 * 2 * 6**3 / 12)
    # a deflection of 4e-5 of the length
    np.testing.assert_allclose(moved[[2, 5], 2], [sag, 2 * sag], rtol=1e-7)


def test_what_is_left_out_is_told_with_its_reason_and_stands_as_a_comment(convert):
    done, text = convert(CAE.replace("*Output", "*Dsload\nSurf-1, P, 1.\n*Output"))
    # the deck is written, but results without the load are others: a script must not go on
    assert done.returncode == 1
    same, others = done.stderr.split("comments, WITHOUT WHICH THE RESULTS ARE OTHERS:\n")
    assert [re.search(r"\*[A-Z]+", line)[0] for line in same.splitlines()[1:]] == [
        "*BEAM",
        "*STEP",
        "*PREPRINT",
        "*OUTPUT",
    ]
    assert [re.search(r"\*[A-Z]+", line)[0] for line in others.splitlines()] == ["*DSLOAD"]
    assert (
        "** litz has no *DSLOAD: beams have no surfaces: *DLOAD gives forces per length:\n** *Dsload\n** Surf-1, P, 1.\n"
        in text
    )
    assert (
        "** *Step, name=Modes, perturbation\n** *Frequency, eigensolver=Lanczos\n** 10, , , , ,\n** *End Step\n" in text
    )
    # the user's own comments stay
    assert "** Section: Section-1\n" in text


def test_a_deck_without_a_step_that_litz_has_says_so_and_nothing_that_follows_from_it(convert, litz, tmp_path):
    text = CAE[: CAE.index("*Step, name=Load")]
    text = text.replace("10, , , , ,\n", "10, , , , ,\n*Base Motion, dof=1, amplitude=Amp-1\n")
    done, new = convert(text)
    assert done.returncode == 1
    _, others = done.stderr.split("comments, WITHOUT WHICH THE RESULTS ARE OTHERS:\n")
    assert others.split("new.inp CANNOT RUN")[0].splitlines()[-1].strip() == "no *STEP is left: write one with *STATIC"
    assert "** *Amplitude, name=Amp-1\n" in new
    told = litz("check", "new.inp", cwd=tmp_path)
    assert told.stderr.count("error:") == 1
    assert "the deck ends without any *STEP" in told.stderr


#: A reference point 20 behind the tip of the first bar, and what Abaqus/CAE writes of its coupling
COUPLED = CAE.replace(
    "*End Assembly",
    "*Node\n 1, 120., 0., 0.\n*Nset, nset=RP-1\n 1,\n*Nset, nset=Tip-1, instance=Bar-1\n 3,\n"
    "*Elset, elset=Last, instance=Bar-1\n 2,\n"
    "*Surface, type=NODE, name=Tip-1_CNS_, internal\nTip-1, 1.\n"
    "*Coupling, constraint name=Constraint-1, ref node=RP-1, surface=Tip-1_CNS_\n*Kinematic\n*End Assembly",
).replace("Bar-1.3, 3, 1e-3", "RP-1, 3, 1e-3")


def test_a_kinematic_coupling_is_a_rigid_body(convert, litz, tmp_path):
    done, _ = convert(COUPLED)
    assert done.returncode == 0, done.stderr
    assert "*COUPLING of RP-1 and Tip-1_CNS_ is a *RIGID BODY, TIE NSET=Tip-1_CNS_" in done.stderr
    run = litz("run", "new.inp", "-o", "out", cwd=tmp_path)
    assert run.returncode == 0, run.stderr
    moved = Results(tmp_path / "out").field("displacement")
    bending = 210000 * 2 * 6**3 / 12
    # the force, and its moment about the tip
    sag = 1e-3 * (100**3 / 3 + 20 * 100**2 / 2) / bending
    slope = 1e-3 * (100**2 / 2 + 20 * 100) / bending
    np.testing.assert_allclose(moved[[2, 6], 2], [sag, sag + 20 * slope], rtol=1e-7)


@pytest.mark.parametrize(
    ("old", "new", "cards"),
    [
        ("*Kinematic\n", "*Kinematic\n1, 6\n", ["*NSET, NSET=Tip-1_CNS_\n", "*RIGID BODY, REF NODE=RP-1, TIE NSET=Tip-1_CNS_\n"]),
        ("*Kinematic\n", "*Kinematic\n1, 1\n2, 3\n", ["*RIGID BODY, REF NODE=RP-1, PIN NSET=Tip-1_CNS_\n"]),
        (
            "type=NODE, name=Tip-1_CNS_, internal\nTip-1, 1.",
            "type=ELEMENT, name=Tip-1_CNS_\nLast,",
            ["*NSET, NSET=Tip-1_CNS_, ELSET=Last\n", "*RIGID BODY, REF NODE=RP-1, TIE NSET=Tip-1_CNS_\n"],
        ),
    ],
)  # fmt: skip
def test_nodes_of_couplings_are_tied_or_pinned(convert, litz, tmp_path, old, new, cards):
    done, text = convert(COUPLED.replace(old, new))
    assert done.returncode == 0, done.stderr
    assert all(card in text for card in cards)
    assert litz("check", "new.inp", cwd=tmp_path).returncode == 0


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("*Kinematic\n", "*Kinematic\n2, 3\n"),
        ("*Kinematic\n", "*Distributing\n"),
        ("surface=Tip-1_CNS_", "surface=Tip-1_CNS_, influence radius=3."),
        ("type=NODE, name=Tip-1_CNS_, internal\nTip-1, 1.", "type=ELEMENT, name=Tip-1_CNS_\nBar-1.Set-1, END2"),
    ],
)
def test_other_couplings_are_comments_that_matter(convert, old, new):
    done, text = convert(COUPLED.replace(old, new))
    assert done.returncode == 1
    assert "*COUPLING" in done.stderr.split("RESULTS ARE OTHERS")[1]
    assert "** *Coupling, " in text


def test_parameters_that_say_what_litz_does_anyway_are_taken_away(convert, litz, tmp_path):
    text = CAE.replace("name=Amp-1", "name=Amp-1, value=relative").replace(
        "*Boundary\n", "*Boundary, type=DISPLACEMENT\n"
    )
    done, new = convert(text.replace("name=Load, nlgeom=YES", "name=Load, nlgeom=YES, amplitude=RAMP"))
    assert done.returncode == 0, done.stderr
    assert all(word not in new for word in ("relative", "DISPLACEMENT", "RAMP"))
    assert litz("check", "new.inp", cwd=tmp_path).returncode == 0


def test_sets_in_an_order_of_their_own_are_paired_in_it(convert, litz, tmp_path):
    """Members of two sets belong together in their order in Abaqus, and by their numbers in litz: node 2 moves with node 1."""
    sets = "*Nset, nset=A, unsorted\n 2, 3\n*Nset, nset=B, unsorted\n 1, 2\n"
    text = CCX.replace("*BOUNDARY", sets + "*Equation\n2\nA, 2, 1., B, 2, -1.\n*BOUNDARY", 1)
    done, new = convert(text, "--dialect", "ccx")
    assert "*EQUATION of A, B is one of each pair of nodes, in the order of UNSORTED sets" in done.stderr
    numbers = [
        float(one) for one in re.search(r"\*Equation\n([^*]*)", new)[1].replace("\n", ",").split(",") if one.strip()
    ]
    assert numbers == [2, 2, 2, 1, 1, 2, -1, 2, 3, 2, 1, 2, 2, -1]
    assert "unsorted" not in new


def test_sets_of_an_equation_that_cannot_be_paired_are_told(convert):
    sets = "*Nset, nset=A, unsorted\n 2, 1, 3\n*Nset, nset=B\n 1, 2\n"
    text = CCX.replace("*BOUNDARY", sets + "*Equation\n2\nA, 2, 1., B, 2, -1.\n*BOUNDARY", 1)
    done, _ = convert(text, "--dialect", "ccx")
    reason = "UNSORTED of *NSET, NSET=A: *EQUATION takes the members of sets by their numbers"
    assert reason in done.stderr.split("WITHOUT WHICH THE RESULTS ARE OTHERS")[1]


def test_controls_of_other_programs_are_comments_unless_litz_has_them(convert, litz, tmp_path):
    more = (
        "*Controls, reset\n*Controls, analysis=DISCONTINUOUS\n*Controls, parameters=LINE SEARCH\n4, , , , \n"
        "*Controls, parameters=FIELD, field=DISPLACEMENT\n0.01, 1., , , 0.02, , , \n"
        "*Controls, parameters=TIME INCREMENTATION\n, , , , , , , 20, , , \n"
    )
    done, new = convert(CAE.replace("*Cload", more + "*Cload"))
    assert done.returncode == 0, done.stderr
    assert done.stderr.count("*CONTROLS: increments and iterations are controlled otherwise") == 1
    assert re.findall(r"^\*Controls.*", new, re.MULTILINE) == ["*Controls, parameters=TIME INCREMENTATION"]
    assert litz("check", "new.inp", cwd=tmp_path).returncode == 0


def test_new_numbers_of_instances_are_told(convert):
    _, new = convert(CAE)
    assert "** nodes of Bar-2: 1-3 are 4-6 here\n*Node\n" in new
    assert "** elements of Bar-2: 1-2 are 3-4 here\n*Element, type=B33\n" in new
    assert "of Bar-1:" not in new


def test_loads_that_are_there_at_once_have_an_amplitude(convert, litz, tmp_path):
    """They are there in the first increment, at a quarter of the time; one with an amplitude of its own has a quarter."""
    text = CAE.replace("name=Load, nlgeom=YES", "name=Load, nlgeom=YES, amplitude=STEP").replace("Amp-1", "At_once")
    text = text.replace("*Cload", "*Cload\nTip-2, 2, 3e-3\n*Cload").replace(
        "1., 1., 1e-05, 1.", "0.25, 1., 1e-05, 0.25"
    )
    done, _ = convert(text)
    assert done.returncode == 0, done.stderr
    assert "AMPLITUDE=STEP of *STEP is *AMPLITUDE, NAME=AT_ONCE_0 of its loads" in done.stderr
    assert litz("run", "new.inp", "-o", "out", cwd=tmp_path).returncode == 0
    results = Results(tmp_path / "out")
    assert results.times[1] == 0.25
    np.testing.assert_allclose(results.field("applied_force", 1).max(axis=0), [0, 3e-3, 0.25 * 2e-3], rtol=1e-12)


def test_rounded_corners_of_amplitudes_are_tables(convert):
    """Parabolas take a quarter of the shorter interval on either side of a corner: at 0.5 the middle of the tangents' ends."""
    text = CAE.replace("name=Amp-1\n0., 0., 1., 1.\n", "name=Amp-1, smooth=0.25\n 0., 0., 1., 1.,\n 3., 0.\n")
    done, new = convert(text)
    assert done.returncode == 0, done.stderr
    points = new.split("*Amplitude, name=Amp-1\n")[1].split("*")[0].replace("\n", ",")
    times, factors = np.reshape([float(value) for value in points.split(",") if value.strip()], (-1, 2)).T
    assert (np.diff(times) > 0).all()
    assert np.interp([0, 0.75, 1.25, 3], times, factors) == pytest.approx([0, 0.75, 0.875, 0])
    # from slope 1 to slope -1/2 over 0.5: half-way it has the mean slope and is below the corner by 1.5 * 0.5 / 8
    assert np.interp(1, times, factors) == pytest.approx(1 - 1.5 * 0.5 / 8)


def test_smooth_steps_are_tables(convert, litz, tmp_path):
    """Half of a smooth step is at half of its time, a quarter of the time has 0.1035 of it; increments end at each point."""
    text = CAE.replace(
        "name=Amp-1\n0., 0., 1., 1.\n", "name=Amp-1, definition=SMOOTH STEP\n 0., 0., 1., 1.,\n 2., 0.5\n"
    )
    done, new = convert(text.replace("1., 1., 1e-05, 1.", "0.25, 1., 1e-05, 0.25"))
    assert done.returncode == 0, done.stderr
    assert "DEFINITION=SMOOTH STEP of *AMPLITUDE, NAME=Amp-1 is a table" in done.stderr
    points = new.split("*Amplitude, name=Amp-1\n")[1].split("*")[0].replace("\n", ",")
    numbers = [float(value) for value in points.split(",") if value.strip()]
    assert numbers[:2] == [0, 0]
    assert numbers[-2:] == [2, 0.5]
    assert litz("run", "new.inp", "-o", "out", cwd=tmp_path).returncode == 0
    results = Results(tmp_path / "out")
    deflection = [results.field("displacement", i)[5, 2] for i in (0, 5, 10, 15, 20)]
    quarter = 0.25**3 * (10 - 15 * 0.25 + 6 * 0.25**2)
    np.testing.assert_allclose(deflection / deflection[-1], [0, quarter, 0.5, 1 - quarter, 1], rtol=1e-6)


def test_steps_have_room_for_the_increments_that_end_at_the_points_of_a_curve(convert, litz, tmp_path):
    """A sum of two waves that a step passes a dozen times, with more points than the 100 increments of a step without INC."""
    waves = "name=Amp-1, definition=PERIODIC\n2, 75., 0., 0.\n 0., 1., 0., 0.3\n"
    done, new = convert(
        CAE.replace("name=Amp-1\n0., 0., 1., 1.\n", waves).replace("1., 1., 1e-05, 1.", "0.25, 1., 1e-05, 0.25")
    )
    assert done.returncode == 0, done.stderr
    points = new.split("*Amplitude, name=Amp-1\n")[1].split("*")[0].count(",") // 2
    assert points > 100
    process = litz("run", "new.inp", "-o", "out", cwd=tmp_path)
    assert process.returncode == 0, process.stderr


def test_definitions_that_nothing_uses_become_comments(convert, litz, tmp_path):
    """Abaqus/CAE writes all that a model has; litz would take them for misspelt references."""
    more = "*Amplitude, name=Amp-2\n0., 0., 1., 1.\n*Material, name=Brass\n*Density\n8.4e-9\n*Elastic\n100000., 0.35\n"
    more += "*Surface Interaction, name=IntProp-1\n1.,\n*Friction\n 0.3\n"
    done, new = convert(CAE.replace("*Boundary", more + "*Boundary"))
    assert done.returncode == 0, done.stderr
    for told in ("*AMPLITUDE, NAME=Amp-2", "*MATERIAL, NAME=Brass", "*SURFACE INTERACTION, NAME=IntProp-1"):
        assert f"{told}: nothing uses it" in done.stderr
    assert "** *Material, name=Brass\n** *Density\n** 8.4e-9\n** *Elastic\n** 100000., 0.35\n" in new
    assert "\n*Amplitude, name=Amp-1\n" in new
    assert litz("check", "new.inp", cwd=tmp_path).returncode == 0


@pytest.mark.parametrize("place", ["part", "assembly"])
@pytest.mark.parametrize("system", ["R", "C"])
def test_local_axes_of_nodes_are_kept(convert, litz, tmp_path, place, system):
    """Those of a part turn with its instances: the tips are loaded along the length of their bars, or around it."""
    # axes (y, z, x) of the part; of a cylinder about a line beside the tip, along the bar
    card = {
        "R": "*Transform, nset=Set-1\n 0., 1., 0., 0., 0., 1.\n",
        "C": "*Transform, nset=Set-1, type=C\n 0., -1., 0., 1., -1., 0.\n",
    }[system]
    if place == "assembly":
        # the second bar lies along y, and its own y is -x
        card = (
            card.replace("Set-1", "Bar-1.Set-1")
            + {
                "R": "*Transform, nset=Bar-2.Set-1\n -1., 0., 0., 0., 0., 1.\n",
                "C": "*Transform, nset=Bar-2.Set-1, type=C\n 1., 0., 40., 1., 1., 40.\n",
            }[system]
        )
        text = CAE.replace("*Amplitude, name", card + "*Amplitude, name")
    else:
        text = CAE.replace("*End Part", card + "*End Part")
    # both tips: 2 N along the bar, 1 mN along its y
    text = text.replace(
        "Bar-1.3, 3, 1e-3\nTip-2, 3, 2e-3\n", "Bar-1.3, 3, 2.\nBar-1.3, 1, 1e-3\nTip-2, 3, 2.\nTip-2, 1, 1e-3\n"
    )
    done, _ = convert(text)
    assert done.returncode == 0, done.stderr
    run = litz("run", "new.inp", "-o", "out", cwd=tmp_path)
    assert run.returncode == 0, run.stderr
    applied = Results(tmp_path / "out").field("applied_force")
    np.testing.assert_allclose(applied[[2, 5]], [[2, 1e-3, 0], [-1e-3, 2, 0]], atol=1e-12)


def test_numbers_stay_where_no_two_instances_share_them(convert):
    second = CAE[CAE.index("*Instance, name=Bar-2") : CAE.index("*Nset, nset=Roots, instance=Bar-1")]
    text = CAE.replace(second, "").replace(
        "*Nset, nset=Roots, instance=Bar-2\n 1,\n*Nset, nset=Tip-2, instance=Bar-2", "*Nset, nset=Tip-2, instance=Bar-1"
    )
    done, new = convert(
        text.replace(" 3, 100., 0., 0.", " 7, 100., 0., 0.")
        .replace("2, 2, 3\n", "2, 2, 7\n")
        .replace(" 3,\n", " 7,\n")
        .replace("1, 3, 1", "1, 7, 1")
        .replace("Bar-1.3", "Bar-1.7")
    )
    assert done.returncode == 0, done.stderr
    assert "*Nset, nset=Bar-1.Set-1\n 1, 2, 7\n" in new
    assert " 2, 2, 7\n" in new
    assert "*Beam Section, elset=Bar-1.Set-1," in new


def test_an_instance_may_have_a_mesh_of_its_own(convert, litz, tmp_path):
    """As Abaqus/CAE writes independent instances."""
    mesh = CAE[CAE.index("*Node") : CAE.index("*End Part")]
    text = (
        CAE.replace(mesh, "")
        .replace("part=Bar\n", f"part=Bar\n{mesh}")
        .replace(" 0., 0., 40.\n 0., 0., 40., 0., 0., 41., 90.\n", "")
    )
    text = text.replace(
        f"name=Bar-2, part=Bar\n{mesh}", f"name=Bar-2, part=Bar\n 0., 0., 40.\n 0., 0., 40., 0., 0., 41., 90.\n{mesh}"
    )
    done, _ = convert(text)
    assert done.returncode == 0, done.stderr
    run = litz("run", "new.inp", "-o", "out", cwd=tmp_path)
    assert run.returncode == 0, run.stderr
    np.testing.assert_allclose(Results(tmp_path / "out").field("reference_position")[5], [0, 100, 40], atol=1e-12)


#: A cantilever as CalculiX has it: along z, with a diameter, output of all kinds, in millimetres
CCX = """\
*NODE, NSET=Nall
1, 0, 0, 0
2, 0, 0, 50
3, 0, 0, 100
*ELEMENT, TYPE=B31, ELSET=EAll
1, 1, 2
2, 2, 3
*BOUNDARY
1, 1, 6
*MATERIAL, NAME=ALUM
*ELASTIC
7E4, .3
*BEAM SECTION, ELSET=EAll, MATERIAL=ALUM, SECTION=CIRC
4.
1.d0, 0.d0, 0.d0
*STEP
*STATIC
*CLOAD
3, 3, 100.
*NODE FILE
U
*EL FILE
S
*END STEP
"""


@pytest.mark.slow
@pytest.mark.parametrize(("dialect", "radius"), [("ccx", 2.0), ("abaqus", 4.0)])
def test_round_sections_are_converted_in_their_dialect(convert, litz, tmp_path, dialect, radius):
    assert convert(CCX)[0].returncode == 1
    done, _ = convert(CCX, "--dialect", dialect, "--length", "mm")
    assert done.returncode == 0, done.stderr
    run = litz("run", "new.inp", "-o", "out", cwd=tmp_path)
    assert run.returncode == 0, run.stderr
    results = Results(tmp_path / "out")
    stretch = 100 * 100 / (7e4 * np.pi * radius**2)
    # large displacements change a stretch of 1e-4 by nothing: the beam is linear in it
    assert results.field("displacement")[2, 2] == pytest.approx(stretch, rel=1e-9)
    assert results.units["displacement"] == "mm"


def test_an_ellipse_of_calculix(convert, litz, tmp_path):
    done, new = convert(CCX.replace("\n4.\n", "\n4., 8.\n"), "--dialect", "ccx")
    assert done.returncode == 0, done.stderr
    assert "*TRANSVERSE SHEAR STIFFNESS" in new
    told = litz("check", "new.inp", cwd=tmp_path)
    assert told.returncode == 0, told.stderr
    assert f"A = {np.pi * 8:.4f}"[:9] in told.stdout
    assert f"I2 = {np.pi / 4 * 2 * 4**3:.3f}"[:9] in told.stdout


def test_names_of_shapes_are_four_letters_in_calculix(convert, litz, tmp_path):
    text = CCX.replace("SECTION=CIRC\n4.\n", "SECTION=rectangular\n4., 4.\n")
    assert convert(text, "--dialect", "ccx")[0].returncode == 0
    assert litz("check", "new.inp", cwd=tmp_path).returncode == 0


MESH = "*Node\n 1, 0, 0, 0\n 2, 0.1, 0, 0\n*Element, type=B31, elset=WIRE\n 1, 1, 2\n"


@pytest.mark.slow
def test_copper_is_that_of_the_unit_of_length_and_no_unit_is_assumed(convert):
    done, _ = convert(MESH, "--radius", "1")
    assert done.returncode == 1
    assert "--young (in the units of the mesh) or --length" in done.stderr
    # 120e9 N/m^2
    for unit, young in (("m", 120e9), ("mm", 120e3), ("um", 0.12)):
        done, new = convert(MESH, "--radius", "1", "--length", unit)
        assert done.returncode == 0, done.stderr
        assert float(re.search(r"\*ELASTIC\n (\S+),", new)[1]) == pytest.approx(young)
        assert f"LENGTH={unit}" in new
    assert convert(MESH, "--radius", "1", "--young", "7e4")[0].returncode == 0


def test_a_mesh_keeps_sections_of_any_shape_and_tells_what_radius_replaces(convert, litz, tmp_path):
    """Wires of --radius are round, and have no material of the file."""
    section = "*Material, name=Steel\n*Elastic\n 2.1e11, 0.3\n*Beam Section, elset=WIRE, section=RECT, material=Steel\n 1.,2.\n"
    done, new = convert(MESH + section, "--dialect", "abaqus")
    assert done.returncode == 0, done.stderr
    assert "section=RECT, material=Steel\n 1.,2.\n" in new
    assert "supports, contacts and loads are missing" in done.stdout
    assert "*BOUNDARY must prevent that" in litz("check", "new.inp", cwd=tmp_path).stderr
    done, new = convert(MESH + section, "--radius", "1", "--length", "m")
    assert done.returncode == 1
    assert "materials of its own, which wires of --radius do not have: --young says what these have" in done.stderr
    assert not new
    done, new = convert(MESH + section, "--radius", "1", "--length", "m", "--young", "2.1e11")
    assert done.returncode == 0, done.stderr
    assert "wires of --radius replace the sections of foreign.inp: WIRE (RECT)" in done.stderr
    assert "is ignored" not in done.stderr
    assert float(re.search(r"\*ELASTIC\n (\S+),", new)[1]) == pytest.approx(2.1e11)


def test_a_mesh_tells_what_else_was_in_its_file(convert):
    done, _ = convert(MESH + "*Boundary\n 1, 1, 6\n*Amplitude, name=A\n 0., 1.\n", "--radius", "1", "--length", "m")
    assert done.returncode == 0
    assert "only the mesh is read, with sections and materials, not *BOUNDARY, *AMPLITUDE" in done.stderr


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("name=Bar-2, part=Bar", "name=Bar-2, part=Beam", "refers to the part Beam, which does not exist"),
        ("0., 0., 40., 0., 0., 41., 90.", "0., 0., 40., 0., 0., 41.", "needs seven numbers"),
    ],
)
def test_instances_that_cannot_be_placed(convert, old, new, message):
    done, _ = convert(CAE.replace(old, new))
    assert done.returncode != 0
    assert message in done.stderr


def test_the_axis_of_a_general_section_may_be_a_blank_line(convert, litz, tmp_path):
    """As in Abaqus, before the moduli; it is its default there, (0, 0, -1)."""
    section = "*Beam General Section, elset=WIRE, section=GENERAL\n 1e-2, 1e-5, 0., 5e-6, 1e-5\n\n 1e7, 4e6\n"
    step = "*Boundary\n 1, 1, 6\n*Step\n*Static\n*Cload\n 2, 2, 1e-3\n*End Step\n"
    done, new = convert(MESH.replace("B31", "B33") + section + step, "--dialect", "abaqus")
    assert done.returncode == 0, done.stderr
    assert "\n 0, 0, -1\n 1e7, 4e6\n" in new
    assert litz("run", "new.inp", "-o", "out", cwd=tmp_path).returncode == 0
    # the force along y bends about z, the first axis
    sag = 1e-3 * 0.1**3 / (3 * 1e7 * 1e-5)
    assert Results(tmp_path / "out").field("displacement")[1, 1] == pytest.approx(sag, rel=1e-6)


@pytest.mark.parametrize("option", ["--young", "--poisson", "--conductivity"])
def test_a_material_that_nothing_would_have_is_refused(convert, option):
    """Where the deck has sections and materials of its own."""
    for text in (CCX, MESH):
        done, new = convert(text, "--dialect", "ccx", option, "0.3")
        assert done.returncode != 0
        assert f"{option} would be of wires of --radius" in done.stderr
        assert not new


@pytest.mark.parametrize(
    ("old", "new", "message", "line"),
    [
        ("3, 3, 100.", "3 3 100.", "values are separated by commas", "3 3 100."),
        ("7E4, .3", "7E4, foo", 'must be a number; found "foo"', "7E4, foo"),
        ("*MATERIAL, NAME=ALUM", "*MATERIAL", "*MATERIAL needs the parameter NAME=", "*MATERIAL"),
    ],
)
def test_what_cannot_be_read_is_told_with_its_line_as_by_the_program(convert, old, new, message, line):
    """But not what litz lacks, which conversion is there for."""
    text = CCX.replace(old, new).replace("*STEP", "*MPC\nBEAM, 1, 2\n*STEP")
    done, written = convert(text, "--dialect", "ccx")
    assert done.returncode == 1
    assert not written
    assert "foreign.inp cannot be converted before it is mended; `litz check` says:" in done.stderr
    assert message in done.stderr
    assert f"foreign.inp:{text.splitlines().index(line) + 1}:" in done.stderr
    assert "*MPC" not in done.stderr


@pytest.mark.parametrize("keyword", ["Part", "Instance"])
def test_parts_and_instances_have_names(convert, keyword):
    line = next(one for one in CAE.splitlines() if one.startswith(f"*{keyword}, name="))
    text = CAE.replace(line, re.sub(r", name=[\w-]+", "", line), 1)
    done, _ = convert(text)
    assert done.returncode == 1
    assert f"*{keyword.upper()} needs NAME=name\n --> foreign.inp:{CAE.splitlines().index(line) + 1}" in done.stderr


#: Section card and first data line of CalculiX, and the tip displacements of CalculiX 2.20 along y and along z: cantilevers
#: of length 100 under 0.01 N, 40 elements B32R, E = 210000, nu = 0.3
CALCULIX = {
    "rectangle": ("BEAM SECTION", "RECT\n4., 8.", 9.313455e-05, 3.701576e-04),
    "square": ("BEAM SECTION", "RECT\n6.", None, None),
    "circle": ("BEAM SECTION", "CIRC\n6., 6.", 2.479806e-04, 2.479806e-04),
    "pipe": ("BEAM GENERAL SECTION", "PIPE\n5., 1.", 5.499948e-05, 5.499948e-05),
    "box": ("BEAM GENERAL SECTION", "BOX\n8., 12., 1., 1., 1., 1.", 2.484669e-05, 4.864970e-05),
}


def cantilever_of_calculix(card, shape, dof):
    """A deck as CalculiX runs it."""
    nodes = "".join(f"{i + 1}, {100 * i / 80!r}, 0., 0.\n" for i in range(81))
    elements = "".join(f"{e + 1}, {2 * e + 1}, {2 * e + 2}, {2 * e + 3}\n" for e in range(40))
    return (
        f"*NODE, NSET=NALL\n{nodes}*ELEMENT, TYPE=B32R, ELSET=EALL\n{elements}*NSET, NSET=TIP\n 81\n*BOUNDARY\n1, 1, 6\n"
        f"*MATERIAL, NAME=STEEL\n*ELASTIC, TYPE=ISO\n210000., 0.3\n*{card}, ELSET=EALL, MATERIAL=STEEL, SECTION={shape}\n"
        f"0., 0., 1.\n*STEP\n*STATIC\n*CLOAD\n81, {dof}, 0.01\n*NODE PRINT, NSET=TIP\nU\n*EL PRINT, ELSET=EALL, FREQUENCY=9\nS\n"
        "*END STEP\n"
    )


@pytest.mark.parametrize("dof", [2, 3])
@pytest.mark.parametrize("shape", [name for name, case in CALCULIX.items() if case[2]])
def test_cantilevers_of_calculix(convert, litz, tmp_path, shape, dof):
    card, data, *sags = CALCULIX[shape]
    done, _ = convert(cantilever_of_calculix(card, data, dof), "--dialect", "ccx")
    assert done.returncode == 0, done.stderr
    run = litz("run", "new.inp", "-o", "out", cwd=tmp_path)
    assert run.returncode == 0, run.stderr
    sag = Results(tmp_path / "out").field("displacement")[80, dof - 1]
    # CalculiX expands a beam to solids, which cannot contract at the clamp, and integrates over the pipe: with 20 elements
    # it is 0.25 % off its own values of 40, and the thin-walled ones are up to 1.1 % stiffer than beam theory
    assert sag == pytest.approx(sags[dof - 2], rel=0.012)


def test_a_side_that_is_left_out_is_that_of_a_square_in_calculix(convert, litz, tmp_path):
    card, data, *_ = CALCULIX["square"]
    assert convert(cantilever_of_calculix(card, data, 3), "--dialect", "ccx")[0].returncode == 0
    assert litz("run", "new.inp", "-o", "out", cwd=tmp_path).returncode == 0
    # deflection by bending and by shear, 12 + 11 nu over 10 (1 + nu)
    expected = 0.01 * 100**3 / (3 * 210000 * 6**4 / 12) + 0.01 * 100 / (210000 / 2.6 * 36 * 13 / 15.3)
    # the error of 80 linear elements, 1 over 4 times 80^2
    assert Results(tmp_path / "out").field("displacement")[80, 2] == pytest.approx(expected, rel=5e-5)


def test_what_is_in_no_step_becomes_comments(convert, litz, tmp_path):
    """As in the deck uprofile of CalculiX's tests, where a *STEP is missing: CalculiX ends there."""
    lost = "*Static\n*Cload\n Tip-2, 3, 5.\n*End Step\n"
    done, new = convert(CAE + lost)
    assert done.returncode == 1
    assert (
        "WITHOUT WHICH THE RESULTS ARE OTHERS:\n  *STATIC after *END STEP: it is in no step, and CalculiX ends"
        in done.stderr
    )
    assert done.stderr.count("is in no step") == 1
    assert new.endswith("** *Static\n** *Cload\n**  Tip-2, 3, 5.\n** *End Step\n")
    assert litz("check", "new.inp", cwd=tmp_path).returncode == 0


#: Two wires that cross, and surfaces around them
SURFACES = """\
*NODE
 1, 0, 0, 0
 2, 1e-2, 0, 0
 3, 2e-2, 0, 0
 11, 1e-2, -1e-2, 1.995e-3
 12, 1e-2, 1e-2, 1.995e-3
*ELEMENT, TYPE=B31, ELSET=A
 1, 1, 2
 2, 2, 3
*ELEMENT, TYPE=B31, ELSET=B
 11, 11, 12
*MATERIAL, NAME=M
*ELASTIC
 1e11, 0.3
*BEAM SECTION, ELSET=A, SECTION=RECT, MATERIAL=M, CONTACT RADIUS=1e-3
 2e-3, 2e-3
*BEAM SECTION, ELSET=B, SECTION=RECT, MATERIAL=M, CONTACT RADIUS=1e-3
 2e-3, 2e-3
{surfaces}*SURFACE INTERACTION, NAME=T
*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HERTZ
*CONTACT PAIR, INTERACTION=T{way}
 LOWER, B
*BOUNDARY
 1, ENCASTRE
 3, ENCASTRE
 11, ENCASTRE
 12, ENCASTRE
*STEP, NLGEOM
*STATIC
*END STEP
"""


def test_surfaces_of_elements_become_element_sets(convert, litz, tmp_path):
    """A surface may have the name of a set with other members: pairs then name a new set."""
    surfaces = "*SURFACE, TYPE=ELEMENT, NAME=LOWER\n 1,\n 2,\n*SURFACE, NAME=B\n 11,\n"
    done, new = convert(SURFACES.format(surfaces=surfaces, way=", TYPE=NODE TO SURFACE"))
    assert done.returncode == 0, done.stderr
    assert "*ELSET, ELSET=LOWER\n 1, 2\n*ELSET, ELSET=B_SURFACE\n 11\n" in new
    assert "*CONTACT PAIR, INTERACTION=T\n LOWER, B_SURFACE\n" in new
    assert "TYPE of *CONTACT PAIR: wires touch at points" in done.stdout + done.stderr
    run = litz("run", "new.inp", "-o", "out", cwd=tmp_path)
    assert run.returncode == 0, run.stderr
    assert Results(tmp_path / "out").contacts.n_rows == 1


def test_a_surface_that_is_its_set_needs_none(convert):
    surfaces = "*SURFACE, NAME=LOWER\n A\n*SURFACE, NAME=B\n B\n"
    done, new = convert(SURFACES.format(surfaces=surfaces, way=""))
    assert done.returncode == 0, done.stderr
    assert "*ELSET, ELSET=LOWER\n A\n** *SURFACE, NAME=B\n**  B\n" in new
    assert "\n LOWER, B\n" in new


@pytest.mark.parametrize(
    ("surface", "reason"),
    [
        ("*SURFACE, NAME=LOWER\n A, END1\n", "*SURFACE, NAME=LOWER: the ends of wires are no surfaces of their own"),
        ("*SURFACE, NAME=LOWER\n A, S2\n", "*SURFACE, NAME=LOWER: the side S2 is one of solids or shells"),
        ("*SURFACE, NAME=LOWER, TYPE=NODE\n 1, 1.0\n", "a surface of TYPE=NODE is none of elements"),
        ("*SURFACE, NAME=LOWER, COMBINE=UNION\n A, B\n", "write out the elements of combined surfaces"),
    ],
)
def test_surfaces_that_are_no_sets_become_comments(convert, surface, reason):
    done, new = convert(SURFACES.format(surfaces=surface, way=", SMALL SLIDING"))
    assert done.returncode == 1
    results_change = done.stderr.split("WITHOUT WHICH THE RESULTS ARE OTHERS")[1]
    assert reason in results_change
    assert "SMALL SLIDING of *CONTACT PAIR" in results_change
    assert f"** {surface.splitlines()[0]}\n" in new
    assert "ELSET=LOWER" not in new.replace("** ", "")


def test_surfaces_of_parts_have_the_name_of_their_instance(convert):
    part = "*Surface, type=ELEMENT, name=Skin\n Set-1,\n*End Part\n"
    pair = (
        "*Surface Interaction, name=Touch\n*Surface Behavior, pressure-overclosure=HERTZ\n"
        "*Contact Pair, interaction=Touch\nBar-1.Skin, Bar-2.Skin\n*Step, name=Modes"
    )
    _, new = convert(CAE.replace("*End Part\n", part).replace("*Step, name=Modes", pair))
    assert "*ELSET, ELSET=Bar-1.Skin\n Bar-1.Set-1\n" in new
    assert "*ELSET, ELSET=Bar-2.Skin\n Bar-2.Set-1\n" in new


#: Two wires of one part that cross, with the contact of Abaqus/CAE: of surfaces, or of all exterior ones
CROSSING = """\
*Part, name=Wire
*Node
 1, -10., 0., 0.
 2, 1., 0., 0.
 3, 10., 0., 0.
*Element, type=B31
1, 1, 2
2, 2, 3
*Elset, elset=Set-1, internal, generate
 1, 2, 1
*Surface, type=ELEMENT, name=Surf-1
Set-1,
*Orientation, name=Ori-1
 1., 0., 0., 0., 1., 0.
1, 0.
*Beam Section, elset=Set-1, material=Steel, temperature=GRADIENTS, section=CIRC
0.5
0.,1.,0.
*End Part
*Assembly, name=Assembly
*Instance, name=Wire-1, part=Wire
*End Instance
*Instance, name=Wire-2, part=Wire
 3., 0., 1.
 0., 0., 1., 0., 0., 2., 90.
*End Instance
*End Assembly
*Material, name=Steel
*Elastic
210000., 0.3
*Surface Interaction, name=IntProp-1
1.,
*Friction, slip tolerance=0.005
 0.3,
*Surface Behavior, pressure-overclosure=HARD
*Boundary
Wire-1.Set-2, ENCASTRE
{contact}*Step, name=Step-1, nlgeom=YES, inc=1000, unsymm=YES
*Static, stabilize=0.0002, allsdtol=0.05, continue=NO
0.5, 1., 1e-05, 1.
*Boundary
Wire-2.Set-2, 1, 2
Wire-2.Set-2, 3, 3, -0.01
Wire-2.Set-2, 4, 6
*End Step
""".replace("*Elset", "*Nset, nset=Set-2\n 1, 3\n*Elset", 1)
PAIR = "*Contact Pair, interaction=IntProp-1, type=SURFACE TO SURFACE\nWire-1.Surf-1, Wire-2.Surf-1\n"
GENERAL = "*Contact\n*Contact Inclusions, ALL EXTERIOR\n*Contact Property Assignment\n , , IntProp-1\n"


class TestContactOfAbaqus:
    @pytest.mark.parametrize("contact", [PAIR, GENERAL])
    def test_a_deck_of_cae_runs_once_it_is_converted(self, convert, litz, tmp_path, contact):
        done, _ = convert(CROSSING.replace("{contact}", contact), "--dialect", "abaqus")
        same, others = done.stderr.split("comments, WITHOUT WHICH THE RESULTS ARE OTHERS:\n")
        assert [line.split(":")[0].strip() for line in others.splitlines()] == [
            "PRESSURE-OVERCLOSURE=HARD of *SURFACE BEHAVIOR is HERTZ", *(
                f"{name} of *STATIC" for name in ("STABILIZE", "ALLSDTOL", "CONTINUE"))]  # fmt: skip
        for name in (
            "TEMPERATURE of *BEAM SECTION",
            "SLIP TOLERANCE of *FRICTION",
            "UNSYMM of *STEP",
            "no *ORIENTATION",
        ):
            assert name in same
        run = litz("run", "new.inp", "-o", "out", cwd=tmp_path)
        assert run.returncode == 0, run.stderr
        # only that displacements are large, which the deck says
        assert "warning" not in run.stderr
        results = Results(tmp_path / "out")
        assert results.contacts_at(-1).n_rows == 1
        # turned by 90 degrees: what was zero is zero
        assert results.nodes[3:].tolist() == [[0, -7, 1], [0, 4, 1], [0, 13, 1]]

    def test_a_pressure_over_the_overlap_is_no_penalty_of_forces(self, convert):
        """In Abaqus and CalculiX LINEAR has a force per area and overlap, here a force per overlap."""
        linear = "*Surface Behavior, pressure-overclosure=LINEAR\n 1e6,\n"
        text = CROSSING.replace("{contact}", PAIR).replace("*Surface Behavior, pressure-overclosure=HARD\n", linear)
        done, new = convert(text, "--dialect", "abaqus")
        assert done.returncode == 1
        assert (
            "LINEAR is a pressure over the overlap there, and a force over it in litz"
            in (done.stderr.split("WITHOUT WHICH")[1])
        )
        assert (
            "** *Surface Behavior, pressure-overclosure=LINEAR\n** 1e6,\n*Surface Behavior, pressure-overclosure=HERTZ\n"
            in new
        )

    @pytest.mark.parametrize("behaviour", [
        "*Surface Behavior, pressure-overclosure=LINEAR\n , 1e9\n",
        "*Surface Behavior, pressure-overclosure=LINEAR, penetration=UNLIMITED\n 1e6\n",
    ])  # fmt: skip
    def test_a_penalty_that_only_litz_has_is_kept(self, convert, behaviour):
        text = CROSSING.replace("{contact}", PAIR).replace("*Surface Behavior, pressure-overclosure=HARD\n", behaviour)
        done, new = convert(text, "--dialect", "abaqus")
        assert behaviour in new
        assert "PRESSURE-OVERCLOSURE" not in done.stderr

    @pytest.mark.parametrize("change", [
        ("*Contact Property", "*Contact Exclusions\nA, B\n*Contact Property"), (", , IntProp-1", "A, B, IntProp-1"),
        ("ALL EXTERIOR", "ALL ELEMENT BASED"),
    ])  # fmt: skip
    def test_general_contact_of_some_surfaces_stays_a_comment(self, convert, change):
        done, text = convert(CROSSING.replace("{contact}", GENERAL.replace(*change)), "--dialect", "abaqus")
        assert "CONTACT PAIR, INTERACTION=IntProp-1" not in text
        assert "litz has no *CONTACT INCLUSIONS" in done.stderr.split("WITHOUT WHICH")[1]

    def test_what_is_wrong_in_a_part_is_told_once_and_pairs_of_its_surfaces_not_at_all(self, tmp_path):
        (tmp_path / "deck.inp").write_text(CROSSING.replace("{contact}", PAIR))
        done = process("check", "deck.inp", cwd=tmp_path)
        assert done.stderr.count("litz has no *SURFACE") == 1
        assert "`litz convert THIS.inp NEW.inp`" in done.stderr
        # of no use to beams: a warning
        assert done.stderr.count("warning: litz has no *ORIENTATION") == 1
        assert "there is no element set" not in done.stderr
