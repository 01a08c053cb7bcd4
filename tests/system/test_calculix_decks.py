"""Decks with beams of the tests of CalculiX (package calculix-ccx-test): which run, agree, or need something else."""

import gzip
import re
import shutil
import subprocess
import warnings
from pathlib import Path

import numpy as np
import pytest

import litz
from in_process import command
from litz.deck import Card, Deck
from litz.model.foreign_deck import convert_deck

DECKS = Path("/usr/share/doc/calculix-ccx-test/examples/test")
RUN = (
    "b31 beamcom beamlin beammix beamtor boxprofile rot1 rot2 rot3 section section4 simplebeam simplebeampipe1 simplebeampipe2"
    " simplebeampipe4 swing uprofile"
)
#: What others need, as the messages have it
NEED = {
    "simplebeampipe3": "the deck ends without any *STEP",
    "pendel": "a run begins without stress and current",
    "contact11": 'found "C3D8"',
    "pret3": 'found "C3D20R"',
    "segmentbeam": 'found "C3D20"',
    "segmentbeam2": 'found "C3D20"',
    "shellbeam": 'found "S8"',
    "wire": 'found "S8"',
}

pytestmark = [
    pytest.mark.skipif(not DECKS.is_dir(), reason="apt-get install calculix-ccx-test"),
    pytest.mark.filterwarnings("ignore"),
]


def text_of(name):
    path = DECKS / f"{name}.inp"
    return path.read_text() if path.exists() else gzip.decompress(Path(f"{path}.gz").read_bytes()).decode()


def converted(path):
    """The deck of litz beside a deck."""
    new = path.with_name(f"new_{path.name}")
    new.write_text(convert_deck(path, "ccx").text)
    return new


def test_these_are_all_with_beams():
    found = set()
    for path in DECKS.glob("*.inp*"):
        text = gzip.decompress(path.read_bytes()).decode() if path.suffix == ".gz" else path.read_text()
        if re.search(r"^\*BEAM (GENERAL )?SECTION", text, re.IGNORECASE | re.MULTILINE):
            found.add(path.name.split(".")[0])
    assert found == {*RUN.split(), *NEED}


@pytest.mark.parametrize("name", RUN.split())
def test_decks_of_beams_run(tmp_path, name):
    path = tmp_path / f"{name}.inp"
    path.write_text(text_of(name))
    assert np.isfinite(litz.run(converted(path), output_directory=tmp_path / "out").field("displacement")).all()


@pytest.mark.parametrize("name", [*RUN.split(), *NEED])
def test_a_conversion_without_a_word_of_what_is_missing_passes_its_check(tmp_path, name):
    (tmp_path / f"{name}.inp").write_text(text_of(name))
    done = command("convert", f"{name}.inp", "new.inp", "--dialect", "ccx", cwd=tmp_path)
    if name in NEED:
        assert done.returncode == 1
        assert NEED[name] in done.stderr
    if done.returncode == 0:
        litz.check(tmp_path / "new.inp")


@pytest.mark.parametrize("name", NEED)
def test_others_are_refused_for_what_they_need(tmp_path, name):
    path = tmp_path / f"{name}.inp"
    path.write_text(text_of(name))
    with pytest.raises((litz.LitzError, ValueError), match=re.escape(NEED[name])):
        litz.check(converted(path))


def refined(text, m):
    """Each quadratic beam as m, under large displacements."""
    deck = Deck.parse(text)
    places = {}
    for card in deck.find("NODE"):
        places |= {row[0]: np.array([float(value or 0) for value in row[1:4]]) for row in card.data}
    new, number = max(places), max(row[0] for card in deck.find("ELEMENT") for row in card.data)
    added, parts = [], {}
    for card in deck.find("ELEMENT"):
        rows = []
        for element, first, middle, last in card.data:
            names = [first]
            for s in np.arange(1, 2 * m) / (2 * m):
                shapes = np.array([(1 - s) * (1 - 2 * s), 4 * s * (1 - s), s * (2 * s - 1)])
                if s == 0.5:
                    names.append(middle)
                    continue
                new += 1
                added.append([new, *(shapes @ [places[first], places[middle], places[last]]).tolist()])
                names.append(new)
            names.append(last)
            numbers = [element, *range(number + 1, number + m)]
            number += m - 1
            parts[element] = numbers
            rows += [[one, *names[2 * k : 2 * k + 3]] for k, one in enumerate(numbers)]
        card.data = rows
        card["TYPE"] = "B32R"
    for card in deck.find("ELSET"):
        card.data = [[part] for row in card.data for one in row if one is not None for part in parts.get(one, [one])]
    deck.insert(Card.make("NODE", {}, added), after=deck.find("NODE")[-1])
    for card in deck.find("STEP"):
        card["NLGEOM"] = True
    return deck.text


def displacements_of_calculix(path):
    """By the numbers of the nodes, at the end."""
    subprocess.run(["ccx", "-i", path.stem], cwd=path.parent, check=True, capture_output=True)
    last = path.with_suffix(".dat").read_text().split(" displacements (vx,vy,vz)")[-1]
    found = {}
    for line in last.splitlines()[2:]:
        words = line.split()
        if len(words) != 4:
            break
        found[int(words[0])] = [float(word) for word in words[1:]]
    return found


has_ccx = pytest.mark.skipif(shutil.which("ccx") is None, reason="apt-get install calculix-ccx")


@has_ccx
@pytest.mark.parametrize(
    ("name", "m", "tolerance"),
    [
        # a frame of square beams; the corners of bricks that meet at an angle
        ("swing", 8, 0.01),
        # a cantilever with a moment at its end, and another one in its middle afterwards
        ("rot2", 4, 0.015),
        # cantilevers of a square section and of a pipe
        ("section", 4, 0.002), ("simplebeampipe1", 4, 0.003),
        # two beams on the same nodes, one above and one below
        ("beamcom", 4, 0.015),
    ],
)  # fmt: skip
def test_on_fine_meshes_both_programs_agree(tmp_path, name, m, tolerance):
    path = tmp_path / f"{name}.inp"
    path.write_text(refined(text_of(name), m))
    other = displacements_of_calculix(path)
    with warnings.catch_warnings():
        results = litz.run(converted(path), output_directory=tmp_path / "out")
    own = dict(zip(results.field("node_id").tolist(), results.field("displacement"), strict=True))
    nodes = sorted(set(own) & set(other))
    assert len(nodes) >= 5
    difference = np.abs([np.array(other[node]) - own[node] for node in nodes]).max()
    assert difference < tolerance * np.abs(list(other.values())).max()


class TestBeamsBesideTheirNodes:
    """`beammix`: two beams between clamps, the second an ellipse at 45 degrees whose middle is half its axes beside the nodes."""

    YOUNG, SHEAR = 210000.0, 210000.0 / 2.6
    #: Axes of the ellipse, and its middle from the nodes
    AXES = np.array([[1, 0, 0], [0, 0.5**0.5, 0.5**0.5], [0, -(0.5**0.5), 0.5**0.5]])
    MIDDLE = np.array([0, -0.025, -0.04]) @ AXES

    def stiffness(self, area, second, other, torsion, factor, end, axes, middle):
        """Of a beam of length 1 that is clamped at its other end, at the node beside its end: forces and moments, (6, 6)."""
        soft = np.zeros((6, 6))
        soft[0, 0], soft[3, 3] = 1 / (self.YOUNG * area), 1 / (self.SHEAR * torsion)
        for across, about, moment, sign in ((1, 5, other, 1), (2, 4, second, -1)):
            rigidity = self.YOUNG * moment
            soft[across, across] = 1 / (3 * rigidity) + 1 / (factor * self.SHEAR * area)
            soft[about, about] = 1 / rigidity
            soft[across, about] = soft[about, across] = sign * end / (2 * rigidity)
        turned, arm = np.zeros((6, 6)), np.eye(6)
        turned[:3, :3] = turned[3:, 3:] = axes
        x, y, z = middle
        arm[:3, 3:] = [[0, z, -y], [-z, 0, x], [y, -x, 0]]
        return arm.T @ turned.T @ np.linalg.inv(soft) @ turned @ arm

    def by_hand(self):
        """Displacements of the node between the two beams."""
        a, b = 0.05, 0.08
        torsion = (
            b * a**3 * (1 / 3 - 64 / np.pi**5 * a / b * sum(np.tanh(k * np.pi * b / 2 / a) / k**5 for k in (1, 3, 5)))
        )
        first = self.stiffness(a * b, a * b**3 / 12, b * a**3 / 12, torsion, 5 / 6, 1, np.eye(3), np.zeros(3))
        torsion = np.pi * (a * b) ** 3 / (16 * (a**2 + b**2))
        ellipse = np.pi / 4 * a * b, np.pi / 64 * a * b**3, np.pi / 64 * b * a**3, torsion, 0.89
        second = self.stiffness(*ellipse, -1, self.AXES, self.MIDDLE)
        return np.linalg.solve(first + second, [0, 0, 0.0025, 0, 0, 0])[:3]

    def results(self, folder):
        path = folder / "beammix.inp"
        path.write_text(refined(text_of("beammix"), 16))
        return path, litz.run(converted(path), output_directory=folder / "out")

    def test_a_node_moves_as_beam_theory_has_it(self, tmp_path):
        _, results = self.results(tmp_path)
        found = results.field("displacement")[results.field("node_id") == 2][0]
        # 32 elements for each beam; small angles; the shear of an ellipse by a mean factor
        assert found == pytest.approx(self.by_hand(), abs=0.003 * np.linalg.norm(found))

    @has_ccx
    def test_calculix_has_the_middle_of_the_section_where_it_says_node(self, tmp_path):
        """Except at clamps and between beams; compared as it is, that is 7 % of the largest displacement."""
        path, results = self.results(tmp_path)
        other = displacements_of_calculix(path)
        inside = (results.nodes[:, 0] > 1) & (results.nodes[:, 0] < 2)
        moved = results.field("displacement") + np.where(
            inside[:, None], np.cross(results.field("rotation"), self.MIDDLE), 0.0
        )
        largest = np.abs(list(other.values())).max()
        away = {
            name: np.abs([one - other[node] for node, one in zip(results.field("node_id").tolist(), each, strict=True)
                          if node in other]).max() / largest
            for name, each in (("node", results.field("displacement")), ("middle", moved))
        }  # fmt: skip
        # what remains falls with the mesh of bricks: 5.0, 2.0, 1.4 % with 4, 16 and 32 of them
        assert away["middle"] < 0.021
        assert away["node"] == pytest.approx(0.07, abs=0.005)


class TestPressuresOnFaces:
    """Loads P1 and P2 of CalculiX are pressures on the faces of the section."""

    def deck(self, label, section="SECTION=RECT", sizes="0.05, 0.08", more=""):
        nodes = "".join(f"{k + 1}, {k / 20}, 0, 0\n" for k in range(21))
        elements = "".join(f"{k + 1}, {2 * k + 1}, {2 * k + 2}, {2 * k + 3}\n" for k in range(10))
        return (
            f"*NODE, NSET=ALL\n{nodes}*ELEMENT, TYPE=B32R, ELSET=FIRST\n{elements}*ELSET, ELSET=HALF, GENERATE\n1, 5\n"
            f"*ELSET, ELSET=BEAM\nHALF, 6, 7, 8, 9, 10\n*BOUNDARY\n1, 1, 6\n*MATERIAL, NAME=M\n*ELASTIC\n210000, 0.3\n"
            f"*BEAM SECTION, ELSET=BEAM, MATERIAL=M, {section}\n{sizes}\n0, 1, 0\n{more}"
            f"*STEP\n*STATIC\n*DLOAD\nBEAM, {label}, 1e-5\n*NODE PRINT, NSET=ALL\nU\n*END STEP\n"
        )

    @has_ccx
    @pytest.mark.parametrize(("label", "along", "across"), [("P1", 0.05, 0.08), ("P2", 0.08, 0.05)])
    def test_both_programs_bend_alike(self, tmp_path, label, along, across):
        path = tmp_path / "pressed.inp"
        path.write_text(self.deck(label))
        results = litz.run(converted(path), output_directory=tmp_path / "out")
        found = results.field("displacement")[-1]
        bending = 1e-5 * across / (8 * 210000 * across * along**3 / 12)
        shear = 1e-5 * across / (2 * 5 / 6 * 210000 / 2.6 * across * along)
        # litz in twenty elements
        assert np.abs(found).max() == pytest.approx(bending + shear, rel=2e-3)
        # ten bricks of CalculiX, which are 2 % stiffer than that
        assert found == pytest.approx(displacements_of_calculix(path)[21], rel=0.025, abs=1e-8)

    @pytest.mark.parametrize("label", ["P1", "P2"])
    def test_a_side_that_is_left_out_is_like_the_first(self, tmp_path, label):
        path = tmp_path / "pressed.inp"
        path.write_text(self.deck(label, sizes="0.05"))
        loads = litz.Deck.parse(convert_deck(path, "ccx").text).card("DLOAD").data
        assert loads == [["BEAM", label, pytest.approx(0.05e-5)]]

    @pytest.mark.parametrize(("section", "sizes", "reason"), [
        ("SECTION=CIRC", "0.05", "SECTION=RECT only"),
        ("SECTION=RECT, OFFSET1=0.5", "0.05, 0.08", "beside the nodes"),
    ])  # fmt: skip
    def test_what_has_no_such_force_is_told(self, tmp_path, section, sizes, reason):
        path = tmp_path / "pressed.inp"
        path.write_text(self.deck("P1", section, sizes))
        (told,) = convert_deck(path, "ccx").left_out
        assert told.startswith("*DLOAD, BEAM, P1: a pressure in CalculiX")
        assert reason in told
        assert f"** {told}: BEAM, P1, 1e-05" in convert_deck(path, "ccx").text

    def test_abaqus_has_forces_per_length_and_whose_deck_it_is_must_be_known(self, tmp_path):
        path = tmp_path / "pressed.inp"
        path.write_text(self.deck("P1"))
        assert "BEAM, P1, 1e-5" in convert_deck(path, "abaqus").text
        with pytest.raises(
            ValueError, match=r"pressures in CalculiX: which of them is meant must be told by --dialect"
        ):
            convert_deck(path)


#: Loads of the steps, and accelerations along y and z at the end that they add up to
WEIGHTS = {
    "another direction": (["BEAM, GRAV, 0.02, 0, 0, -1", "BEAM, GRAV, 0.01, 0, 1, 0"], (0.01, -0.02)),
    "the same direction": (["BEAM, GRAV, 0.02, 0, 0, -1", "BEAM, GRAV, 0.03, 0, 0, -2"], (0.0, -0.03)),
    "the opposite direction": (["BEAM, GRAV, 0.02, 0, 0, -1", "BEAM, GRAV, 0.03, 0, 0, 1"], (0.0, 0.01)),
    "another set": (["BEAM, GRAV, 0.02, 0, 0, -1", "SAME, GRAV, 0.03, 0, 0, -1"], (0.0, -0.05)),
    "in the third step": (
        ["BEAM, GRAV, 0.02, 0, 0, -1", "BEAM, GRAV, 0.01, 0, 1, 0", "BEAM, GRAV, 0.03, 0, 1, 0"],
        (0.03, -0.02),
    ),
    "others taken away": (["BEAM, GRAV, 0.02, 0, 0, -1", "NEW", "BEAM, GRAV, 0.01, 0, 1, 0"], (0.01, 0.0)),
}


class TestWeightsOfSteps:
    """GRAV of another direction or set than that of earlier steps is added to it in CalculiX, and in its place in Abaqus."""

    def deck(self, *lines):
        nodes = "".join(f"{k + 1}, {k / 20}, 0, 0\n" for k in range(21))
        elements = "".join(f"{k + 1}, {2 * k + 1}, {2 * k + 2}, {2 * k + 3}\n" for k in range(10))
        steps = "".join(f"*STEP\n*STATIC\n{line}\n*NODE PRINT, NSET=ALL\nU\n*END STEP\n" for line in lines)
        return (
            f"*NODE, NSET=ALL\n{nodes}*ELEMENT, TYPE=B32R, ELSET=BEAM\n{elements}*ELSET, ELSET=SAME\nBEAM\n*BOUNDARY\n1, 1, 6\n"
            "*MATERIAL, NAME=M\n*ELASTIC\n210000, 0.3\n*DENSITY\n2\n"
            f"*BEAM SECTION, ELSET=BEAM, MATERIAL=M, SECTION=RECT\n0.05, 0.08\n0, 1, 0\n{steps}"
        )

    @has_ccx
    @pytest.mark.parametrize("case", WEIGHTS)
    def test_both_programs_add_alike(self, tmp_path, case):
        lines, acceleration = WEIGHTS[case]
        path = tmp_path / "heavy.inp"
        path.write_text(
            self.deck(*(f"*DLOAD{', OP=NEW' * (line == 'NEW')}\n{line.replace('NEW', '')}" for line in lines))
        )
        found = litz.run(converted(path), output_directory=tmp_path / "out").field("displacement")[-1]
        for value, along, across in ((acceleration[0], 0.05, 0.08), (acceleration[1], 0.08, 0.05)):
            load = 2 * 0.05 * 0.08 * value
            bending, shear = load / (8 * 210000 * across * along**3 / 12), load / (2 * 5 / 6 * 210000 / 2.6 * 0.004)
            # litz in twenty elements
            assert found[1 if along == 0.05 else 2] == pytest.approx(bending + shear, rel=2e-3, abs=1e-12)
        # ten bricks of CalculiX, which are 2 % stiffer than that
        assert found[1:] == pytest.approx(displacements_of_calculix(path)[21][1:], rel=0.025, abs=1e-10)

    def test_weights_that_act_together_have_one_amplitude(self, tmp_path):
        path = tmp_path / "heavy.inp"
        text = self.deck("*DLOAD, AMPLITUDE=A\nBEAM, GRAV, 0.02, 0, 0, -1", "*DLOAD\nBEAM, GRAV, 0.01, 0, 1, 0")
        path.write_text(text.replace("*BOUNDARY\n", "*AMPLITUDE, NAME=A\n0, 0, 1, 0.5\n*BOUNDARY\n", 1))
        with pytest.raises(ValueError, match=r"GRAV of step 2: .* another \*AMPLITUDE \(none and A\)"):
            convert_deck(path, "ccx")

    def test_whose_deck_it_is_must_be_known(self, tmp_path):
        path = tmp_path / "heavy.inp"
        path.write_text(self.deck(*(f"*DLOAD\n{line}" for line in WEIGHTS["another direction"][0])))
        assert "GRAV, 0.02" not in convert_deck(path, "abaqus").text.partition("*END STEP")[2]
        new = convert_deck(path, "ccx")
        assert "BEAM, GRAV, 0.02, 0, 0, -1" in new.text.partition("*END STEP")[2]
        assert any("GRAV of step 2: CalculiX adds it" in told for told in new.ignored)
        with pytest.raises(
            ValueError, match="in CalculiX it is added to it: which of them is meant must be told by --dialect"
        ):
            convert_deck(path)
