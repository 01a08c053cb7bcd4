"""What `litz convert` writes passes `litz check`, or it says why not and ends with 1; joints of other programs in closed form."""

import re

import numpy as np
import pytest

from in_process import command
from litz import Results
from test_converted_decks import CAE, CCX, CROSSING, GENERAL, PAIR
from test_foreign_decks import CAE as FLAT

STEP = "*Step, name=Step-1, nlgeom=NO"
STATIC = "*Static\n1., 1., 1e-05, 1."
LOAD = "*Cload, amplitude=Amp-1\nSet-2, 3, 1."
SECTION = "*Beam Section, elset=_PickedSet4, material=Steel, temperature=GRADIENTS, section=CIRC\n2.\n0.,0.,-1."
LAST = "      4,          30.,           0.,           0.\n"
BETWEEN = (
    f"      2,          10.,           0.,           0.\n      3,          20.,           0.,           0.\n{LAST}"
)
MASS = "*Element, type=MASS, elset=M\n10, 4\n*Mass, elset=M\n0.5,\n"
BEHIND = "*Node\n 9, 35., 0., 5.\n*Nset, nset=RP\n 9\n"


def flat(*changes):
    """A cantilever of Abaqus/CAE with cards changed: old, new, and so on."""
    text = FLAT
    for old, new in zip(changes[::2], changes[1::2], strict=True):
        assert old in text
        text = text.replace(old, new)
    return "abaqus", text


def crossed(contact, old="", new=""):
    """Two wires of Abaqus/CAE with contact."""
    assert old in CROSSING + contact
    return "abaqus", CROSSING.replace("{contact}", contact).replace(old, new)


def of_calculix(old, new):
    """A cantilever of CalculiX with one card changed."""
    assert old in CCX
    return "ccx", CCX.replace(old, new)


#: Decks as users of the other programs write them, with what their conversion tells as changing results; nothing: it is complete
DECKS = {
    "as it is": (flat("*Heading", "*Heading"), ""),
    "follower force": (flat("*Cload, amplitude=Amp-1", "*Cload, amplitude=Amp-1, follower"), "do not turn with their node"),
    "all at once": (flat(STEP, "*Step, name=Step-1, amplitude=STEP, inc=1000"), ""),
    "velocity": (flat(LOAD, "*Boundary, type=VELOCITY\nSet-2, 3, 3, 0.1"), ""),
    "acceleration": (flat(LOAD, "*Boundary, type=ACCELERATION\nSet-2, 3, 3, 0.1"), "there is no inertia for accelerations"),
    "arc length": (flat(STATIC, "*Static, riks\n1., 1., 1e-05, , 1., Set-2, 3, 10."), "there is no arc length"),
    "perturbation": (flat(STEP, "*Step, name=Step-1, perturbation"), "every step is nonlinear"),
    "without increments": (flat(STATIC, "*Static"), ""),
    "direct": (flat(STATIC, "*Static, direct\n0.1, 1."), ""),
    "dynamics": (flat(STATIC, "*Dynamic, application=QUASI-STATIC\n0.1, 1."), "there is no inertia"),
    "moduli in the section": (
        flat(SECTION, "*Beam General Section, elset=_PickedSet4, density=7.8e-9, section=CIRC\n2.\n0.,0.,-1.\n210000., 80769."),
        "",
    ),
    "integration points": (flat("0.,0.,-1.", "0.,0.,-1.\n3, 8"), ""),
    "first axis by a node": (flat("1, 1, 2\n", "1, 1, 2, 3\n"), "is the second line of *BEAM SECTION"),
    "plasticity": (flat("210000., 0.3\n", "210000., 0.3\n*Plastic\n 250., 0.\n"), "beams are elastic"),
    "over temperature": (flat("210000., 0.3\n", "210000., 0.3, 20.\n190000., 0.3, 400.\n"), ""),
    "spring": (flat(STEP, f"*Element, type=SPRING1, elset=K\n10, 4\n*Spring, elset=K\n3\n100.\n{STEP}"), "is a thin beam"),
    "tie": (flat(STEP, f"*Surface, name=S, type=NODE\n Set-2, 1.\n*Tie, name=C\n S, S\n{STEP}"), "litz has no *TIE"),
    "rod": (flat(STEP, f"{BEHIND}*Mpc\nLINK, Set-2, RP\n{STEP}"), "keeps its length"),
    "equation": (flat(STEP, f"*Equation\n2\n3, 3, 1.\n4, 3, -1.\n{STEP}"), ""),
    "smooth amplitude": (flat("name=Amp-1", "name=Amp-1, smooth=0.25"), ""),
    "total time": (flat("name=Amp-1", "name=Amp-1, time=TOTAL TIME"), ""),
    "periodic": (flat("name=Amp-1\n0., 0., 1., 1.", "name=Amp-1, definition=PERIODIC\n1, 6., 0., 0.\n0., 1."), ""),
    "bubble": (flat("name=Amp-1\n0., 0., 1., 1.", "name=Amp-1, definition=BUBBLE\n1., 2., 3."), "is a table of factors"),
    "parameters": (flat("*Heading", "*Parameter\n r = 2.\n*Heading"), "litz has no *PARAMETER"),
    "generated nodes": (flat(BETWEEN, f"{LAST}*Ngen\n1, 4, 1\n"), ""),
    "generated nodes along axes": (flat(STEP, f"*Ngen, system=C\n1, 4, 1\n{STEP}"), "litz has no *NGEN"),
    "cylindrical": (flat("*Node\n", "*Node, system=C\n"), ""),
    "masses": (flat(STEP, f"{MASS}{STEP}"), ""),
    "masses with weight": (
        flat(STEP, f"{MASS}{STEP}", LOAD, f"{LOAD}\n*Dload\n_PickedSet4, GRAV, 9810., 0., 0., -1."),
        "their weight is missing",
    ),
    "what there is no inertia for": (flat("*Elastic", "*Damping, alpha=0.1\n*Elastic"), ""),
    "section controls": (flat(STEP, f"*Section Controls, name=E, hourglass=STIFFNESS\n1., 1., 1.\n{STEP}"), ""),
    "equal times": (
        flat("name=Amp-1\n0., 0., 1., 1.", "name=Amp-1, definition=EQUALLY SPACED, fixed interval=0.5\n0., 0.1, 1."),
        "",
    ),
    "unsorted": (flat("*Nset, nset=Set-2", "*Nset, nset=Set-2, unsorted"), ""),
    "fields": (flat(LOAD, f"{LOAD}\n*Field, variable=1\nSet-2, 1."), 'unknown keyword "FIELD"'),
    "removed elements": (flat(LOAD, f"{LOAD}\n*Model Change, remove\n_PickedSet4"), "litz has no *MODEL CHANGE"),
    "output": (flat(LOAD, f"{LOAD}\n*Element Output, directions=YES\nSF\n*Contact Print, master=A, slave=B\nCSTRESS"), ""),
    "truss": (flat("type=B33", "type=T3D2"), "use a thin beam"),
    "heat": (flat(STATIC, "*Heat Transfer\n1., 1., 1e-05, 1."), "use *COUPLED THERMAL-ELECTRICAL"),
    "adjusted": (crossed(PAIR, "type=SURFACE TO SURFACE", "adjust=0.0"), "ADJUST of *CONTACT PAIR: nodes stay where they are"),
    "rough": (crossed(GENERAL, "*Friction, slip tolerance=0.005\n 0.3,", "*Friction, rough"), "give a large coefficient"),
    "no separation": (crossed(PAIR, "pressure-overclosure=HARD", "no separation"), "wires that touch can always separate"),
    "later friction": (crossed(PAIR, "*End Step", "*Change Friction\n*Friction\n0.5\n*End Step"), "CHANGE FRICTION"),
    "ccx": (of_calculix("*STEP\n*STATIC", "*STEP, NLGEOM, INC=200\n*STATIC, SOLVER=PASTIX\n0.1,1.,1e-5,0.1"), ""),
    "ccx, eigenvalues first": (of_calculix("*STEP\n", "*STEP\n*FREQUENCY\n10\n*END STEP\n*STEP\n"), ""),
    "ccx, pressure": (of_calculix("*CLOAD", "*DLOAD\nEAll, P1, 1.\n*CLOAD"), "a pressure in CalculiX"),
    "ccx, weight": (of_calculix("*CLOAD", "*DLOAD\nEAll, GRAV, 9810., 0., 0., -1.\n*CLOAD"), "has no *DENSITY"),
    "ccx, plane": (of_calculix("*STEP", "*MPC\nPLANE, Nall\n*STEP"), "only BEAM, TIE and PIN"),
    "ccx, rod": (of_calculix("*STEP", "*MPC\nBEAM, 1, 3\n*STEP"), "keeps its length"),
    "ccx, node surface": (
        of_calculix("*STEP", "*SURFACE, NAME=S, TYPE=NODE\nNall\n*CONTACT PAIR, INTERACTION=T\nS, S\n*STEP"),
        "a surface of TYPE=NODE is none of elements",
    ),
}  # fmt: skip


@pytest.fixture
def convert(litz, tmp_path):
    """Converts a text, and sees to it that a deck without a word of what is missing is one that the program takes."""

    def of(dialect, text):
        (tmp_path / "foreign.inp").write_text(text)
        done = command("convert", "foreign.inp", "new.inp", *(["--dialect", dialect] if dialect else []), cwd=tmp_path)
        checked = litz("check", "new.inp", cwd=tmp_path)
        assert ("CANNOT RUN AS IT IS" in done.stderr) == (checked.returncode != 0)
        assert checked.returncode == 0 or done.returncode == 1
        return done

    return of


@pytest.mark.parametrize("name", DECKS)
def test_a_deck_passes_its_check_or_the_conversion_says_why_not(convert, name):
    (dialect, text), missing = DECKS[name]
    done = convert(dialect, text)
    assert (done.returncode == 0) == (not missing), done.stderr
    told = re.split("WITHOUT WHICH THE RESULTS ARE OTHERS|CANNOT RUN AS IT IS", done.stderr, maxsplit=1)
    assert missing in told[-1]


#: A cantilever along x of two elements, and one more that begins where it ends; two nodes 5 above its end
JOINTS = """\
*NODE
1, 0., 0., 0.
2, 10., 0., 0.
3, 20., 0., 0.
4, 20., 0., 0.
5, 30., 0., 0.
6, 20., 5., 0.
7, 30., 5., 0.
*NSET, NSET=END
4
*ELEMENT, TYPE=B33, ELSET=A
1, 1, 2
2, 2, 3
3, 4, 5
4, 6, 7
*MATERIAL, NAME=M
*ELASTIC
210000., 0.3
*BEAM SECTION, ELSET=A, MATERIAL=M, SECTION=RECT
2., 2.
0., 0., -1.
*BOUNDARY
1, ENCASTRE
*MPC
{joints}
*STEP, NLGEOM
*STATIC
*CLOAD
{load}
*END STEP
"""
BENDING = 210000 * 2**4 / 12


def moved(litz, tmp_path):
    """Displacements along y and rotations about z of the converted deck."""
    run = litz("run", "new.inp", "-o", "out", cwd=tmp_path)
    assert run.returncode == 0, run.stderr
    results = Results(tmp_path / "out")
    return results.field("displacement")[:, 1], results.field("rotation")[:, 2]


class TestMultiPointConstraints:
    """Deflections of 1e-4 of the length: their squares are what large displacements change."""

    #: Deflection and slope at 20 by a force of 0.1 at 30
    sag = 0.1 * (20**3 / 3 + 10 * 20**2 / 2) / BENDING
    slope = 0.1 * (20**2 / 2 + 10 * 20) / BENDING

    @pytest.mark.parametrize("joint", ["TIE, 4, 3", "TIE, END, 3", "BEAM, END, 3", "BEAM, 4, 3"])
    def test_nodes_in_one_place_are_joined(self, convert, litz, tmp_path, joint):
        assert convert("abaqus", JOINTS.format(joints=f"{joint}\nBEAM, 6, 3", load="5, 2, 0.1")).returncode == 0
        up, turned = moved(litz, tmp_path)
        assert up[4] == pytest.approx(0.1 * 30**3 / 3 / BENDING, rel=1e-7)
        np.testing.assert_allclose(up[[2, 3]], self.sag, rtol=1e-7)
        # what is above the axis by 5 moves by the square of the slope less
        assert up[5] == pytest.approx(self.sag - 5 * self.slope**2 / 2, rel=1e-7)
        np.testing.assert_allclose(turned[[2, 3, 5, 6]], self.slope, rtol=1e-7)

    def test_what_is_joined_by_a_chain_is_one_body(self, convert, litz, tmp_path):
        assert convert("abaqus", JOINTS.format(joints="BEAM, 6, 4\nTIE, 4, 3", load="7, 2, 0.1")).returncode == 0
        assert (
            "*NSET, NSET=TIE_3\n 4, 6\n*RIGID BODY, REF NODE=3, TIE NSET=TIE_3\n" in (tmp_path / "new.inp").read_text()
        )
        # as the body turns, 7, which is 5 above the axis, comes nearer by 7e-5 of the arm of 10
        np.testing.assert_allclose(moved(litz, tmp_path)[0][[2, 3]], self.sag, rtol=1e-4)

    def test_nodes_apart_that_are_tied_or_pinned_have_the_same_displacements(self, convert, litz, tmp_path):
        """Without an arm: the force at 7, and its moment about 6, act on 3."""
        assert convert("abaqus", JOINTS.format(joints="TIE, 4, 3\nTIE, 6, 3", load="7, 2, 0.1")).returncode == 0
        up, turned = moved(litz, tmp_path)
        np.testing.assert_allclose(up[[2, 3, 5]], self.sag, rtol=1e-7)
        np.testing.assert_allclose(turned[[2, 3, 5]], self.slope, rtol=1e-7)

    @pytest.mark.parametrize(
        ("joint", "held"), [("PIN, 4, 3\nBEAM, 6, 3", "5, ENCASTRE"), ("PIN, 6, 3\nTIE, 4, 3", "7, ENCASTRE")]
    )
    def test_a_pin_passes_no_moment(self, convert, litz, tmp_path, joint, held):
        """A force at 20 on a cantilever of 20 whose end rests on one of 10, as two springs beside each other."""
        deck = JOINTS.format(joints=joint, load="3, 2, 1.").replace("1, ENCASTRE", f"1, ENCASTRE\n{held}")
        assert convert("abaqus", deck).returncode == 0
        sag = 1 / (3 * BENDING / 20**3 + 3 * BENDING / 10**3)
        np.testing.assert_allclose(moved(litz, tmp_path)[0][2], sag, rtol=1e-5)

    def test_beams_of_calculix_are_rods_so_the_dialect_is_asked_for(self, tmp_path):
        (tmp_path / "foreign.inp").write_text(JOINTS.format(joints="BEAM, 6, 3", load="3, 2, 1."))
        done = command("convert", "foreign.inp", "new.inp", cwd=tmp_path)
        assert done.returncode != 0
        assert "keeps their distance alone in CalculiX" in done.stderr
        assert not (tmp_path / "new.inp").exists()

    def test_a_pin_between_two_bodies_is_a_comment_that_matters(self, convert):
        done = convert("abaqus", JOINTS.format(joints="BEAM, 2, 3\nBEAM, 6, 4\nPIN, 4, 3", load="7, 2, 0.1"))
        assert done.returncode == 1
        assert "*MPC, PIN, 4, 3: a pin between two rigid bodies" in done.stderr.split("RESULTS ARE OTHERS")[1]


#: Two cantilevers of length 20, and a reference point in the middle between their ends
SPREAD = """\
*NODE
1, 0., 0., 0.
2, 20., 0., 0.
3, 0., 0., 10.
4, 20., 0., 10.
9, 20., 0., {z}
*NSET, NSET=TIPS
2, 4
*NSET, NSET=RP
9
*ELEMENT, TYPE=B33, ELSET=A
1, 1, 2
2, 3, 4
*MATERIAL, NAME=M
*ELASTIC
210000., 0.3
*BEAM SECTION, ELSET=A, MATERIAL=M, SECTION=RECT
2., 2.
0., 0., -1.
*SURFACE, TYPE=NODE, NAME=TIPS_CNS_
TIPS, 1.
*COUPLING, CONSTRAINT NAME=C, REF NODE=RP, SURFACE=TIPS_CNS_
*DISTRIBUTING, WEIGHTING METHOD=UNIFORM
*BOUNDARY
1, ENCASTRE
3, ENCASTRE
*STEP, NLGEOM
*STATIC
*CLOAD
RP, {dof}, 1.
2, 2, 0.5
*END STEP
"""


class TestDistributingCouplings:
    def test_a_node_in_the_middle_moves_with_the_mean_and_its_force_is_shared(self, convert, litz, tmp_path):
        done = convert("abaqus", SPREAD.format(z=5, dof=2))
        assert done.returncode == 0, done.stderr
        assert "*COUPLING of RP and TIPS_CNS_ is an *EQUATION" in done.stderr
        up, _ = moved(litz, tmp_path)
        each = 20**3 / (3 * BENDING)
        np.testing.assert_allclose(up[[1, 3, 4]], np.array([1, 0.5, 0.75]) * each, rtol=1e-5)

    @pytest.mark.parametrize(
        ("z", "dof", "reason"),
        [(6, 2, "beside the middle of its nodes"), (5, 4, "a moment or a support of rotations at its reference node")],
    )
    def test_others_are_comments_with_the_reason(self, convert, z, dof, reason):
        done = convert("abaqus", SPREAD.format(z=z, dof=dof))
        assert done.returncode == 1
        assert reason in done.stderr.split("RESULTS ARE OTHERS")[1]


class TestForeignRigidBodies:
    def test_old_kinematic_couplings(self, convert, litz, tmp_path):
        """A force 10 behind the tip of a cantilever of 30."""
        card = "*Node\n 9, 40., 0., 0.\n*Kinematic Coupling, ref node=9\nSet-2, 1, 6\n"
        text = FLAT.replace(STEP, card + STEP).replace("Set-2, 3, 1.", "9, 3, 1.")
        assert convert("abaqus", text).returncode == 0
        run = litz("run", "new.inp", "-o", "out", cwd=tmp_path)
        assert run.returncode == 0, run.stderr
        sag = (30**3 / 3 + 10 * 30**2 / 2) / (210000 * np.pi / 4 * 2**4)
        assert Results(tmp_path / "out").field("displacement")[3, 2] == pytest.approx(sag, rel=1e-6)

    def test_a_node_for_rotations_is_the_reference_node(self, convert, litz, tmp_path):
        """A moment about x on the tip of a cantilever along z of length 100."""
        body = (
            "*NODE\n10, 0, 0, 100\n11, 0, 0, 100\n*NSET, NSET=TIP\n3\n*RIGID BODY, NSET=TIP, REF NODE=10, ROT NODE=11\n"
        )
        done = convert("ccx", CCX.replace("*BOUNDARY\n", f"{body}*BOUNDARY\n").replace("3, 3, 100.", "11, 1, 10."))
        assert done.returncode == 0, done.stderr
        run = litz("run", "new.inp", "-o", "out", cwd=tmp_path)
        assert run.returncode == 0, run.stderr
        turned = Results(tmp_path / "out").field("rotation")[2, 0]
        assert turned == pytest.approx(10 * 100 / (7e4 * np.pi / 4 * 2**4), rel=1e-9)

    def test_a_body_of_elements_has_their_nodes(self, convert, tmp_path):
        done = convert(*flat(STEP, f"{BEHIND}*Elset, elset=Tip\n 3\n*Rigid Body, ref node=RP, elset=Tip\n{STEP}"))
        # the load of the deck acts on a node of the body
        assert "node 4 has no degree of freedom 3 of its own" in done.stderr
        assert (
            "*NSET, NSET=Tip, ELSET=Tip\n*Rigid Body, ref node=RP, TIE NSET=Tip\n" in (tmp_path / "new.inp").read_text()
        )


@pytest.mark.parametrize("text", [CAE, CCX])
def test_decks_in_which_nothing_is_missing(convert, text):
    assert convert("ccx" if text is CCX else None, text).returncode == 0


HISTORY = "*Output, history\n*Node Output, nset=Set-2\nCF1, RF1, U1\n"


def test_requests_of_history_are_print_cards(convert, litz, tmp_path):
    """A name without a number has rotations, too; what litz lacks, or is of no set, and fields are left out."""
    asked = HISTORY.replace("CF1, RF1, U1", "CF1, U, A1") + "*Element Output, elset=_PickedSet4\nSF1, SM1, MISES\n"
    done = convert(*flat(HISTORY, f"*Node Output, nset=Set-2\nRF\n{asked}*Node Output\nRF\n"))
    assert done.returncode == 0, done.stderr
    for told in (
        "*NODE OUTPUT of Set-2 is *NODE PRINT with CF, U, UR",
        "*ELEMENT OUTPUT of _PickedSet4 is *EL PRINT with SF",
    ):
        assert told in done.stderr
    text = (tmp_path / "new.inp").read_text()
    assert text.count("\n*NODE PRINT") == text.count("\n*EL PRINT") == 1
    assert litz("run", "new.inp", "-o", "out", cwd=tmp_path).returncode == 0
    history = Results(tmp_path / "out").history
    sag = 30**3 / (3 * 210000 * np.pi / 4 * 2**4)
    assert history["U3 node 4"][-1] == pytest.approx(sag, rel=1e-6)
    assert history["CF3 node 4"][-1] == 1
