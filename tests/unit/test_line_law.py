"""Line contact per length: the strip between parallel wires, the lens of crossed ones, and the two joined."""

from typing import ClassVar

import numpy as np
import pytest

from derivatives import derivative
from litz import _core
from litz.kernels import contact_spot, line_law

pi = np.pi
EQUAL = dict(radius=[1e-3, 1e-3], young=[120e9, 120e9], poisson=[0.34, 0.34], resistivity=[1.7e-8, 1.7e-8])
UNEQUAL = dict(radius=[1e-3, 0.3e-3], young=[120e9, 70e9], poisson=[0.34, 0.2], resistivity=[1.7e-8, 5e-8])
WIRES = [pytest.param(EQUAL, id="equal wires"), pytest.param(UNEQUAL, id="unequal wires")]
ANGLES = [0.0, 1e-3, 0.1, 1.0, pi / 2, 2.5]
FORCES = [1e-3, 1.0, 1e3, 1e5]
FILM = 1e-12


class Formulas:
    """The formulas of the theory, written down as they stand there."""

    def __init__(self, wires, angle=0.0):
        self.r, e, nu, self.rho = (np.array(wires[name]) for name in ("radius", "young", "poisson", "resistivity"))
        self.c = (1 - nu**2) / e
        self.nu = nu
        self.modulus = 1 / self.c.sum()
        self.a = 0.0
        if angle:
            spot = contact_spot(1.0, angle=angle, **wires)
            k = 0.75 * spot.approach**-1.5 * np.sin(angle) / np.sqrt(2 * self.r.sum())
            self.a = np.exp(-2 * pi * self.modulus / (2 * k))

    def half_width(self, f):
        reduced = self.r.prod() / self.r.sum()
        return np.sqrt(4 * f * reduced / (pi * self.modulus))

    def approach(self, f):
        lam2 = (self.c * (np.log(2 * self.r / self.half_width(f)) - 1 / (8 * (1 - self.nu)))).sum() / self.c.sum()
        return 2 * f / (pi * self.modulus) * (-np.log(self.a + np.exp(-2 * lam2)) / 2)

    def conductance(self, f, film=0.0, half_width=None):
        b = self.half_width(f) if half_width is None else half_width
        lam2 = (self.rho * (np.log(2 * self.r / b) + 1 / 8)).sum() / self.rho.sum()
        # the far field of the lens is as long for a strip of any width
        lam = -np.log(self.a * (b / self.half_width(f)) ** 2 + np.exp(-2 * lam2)) / 2
        return 1 / (self.rho.sum() / pi * lam + film / (2 * b))

    def force(self, overlap):
        """By bisection, up to the widest strip."""
        low, high = 0.0, (min(self.r) / 4 / self.half_width(1.0)) ** 2
        for _ in range(1100):
            middle = (low + high) / 2
            if middle in (low, high):
                break
            low, high = (middle, high) if self.approach(middle) < overlap else (low, middle)
        return middle


def at_overlap(wires, overlap, angle=0.0, penalty=0.0, film=0.0, hardness=0.0):
    """Force law at the overlap, the inverse law and the spot at its force, and whether these are too wide."""
    return _core.f2py_line.line_law(overlap, *wires.values(), angle, penalty, film, hardness)


class TestParallelWires:
    def test_equal_wires_approach_like_discs_squeezed_by_line_loads(self):
        # K. L. Johnson, Contact Mechanics, section 5.6, of a disc loaded from both sides, for the mean of the section
        # with one side loaded: each wire gives f (1 - nu^2)/(pi E) (2 ln(2r/b) - 1/(4 (1 - nu)))
        law = line_law(1e3, **EQUAL)
        b = np.sqrt(4 * 1e3 * 0.5e-3 * 2 * (1 - 0.34**2) / (pi * 120e9))
        one = 1e3 * (1 - 0.34**2) / (pi * 120e9) * (2 * np.log(2e-3 / b) - 1 / (4 * 0.66))
        assert law.half_width == pytest.approx(b, rel=1e-14)
        assert law.approach == pytest.approx(2 * one, rel=1e-14)

    def test_equal_clean_wires_conduct_as_a_disc_with_a_strip_on_its_rim(self):
        # R1 = (rho/pi) (ln(2r/b) + 1/8) of each, 2 e^(1/8) = 2.266
        law = line_law(1e3, **EQUAL)
        assert 1 / law.conductance == pytest.approx(
            2 * 1.7e-8 / pi * np.log(2 * np.exp(1 / 8) * 1e-3 / law.half_width), rel=1e-14
        )

    def test_a_film_is_in_series_over_the_width_of_the_strip(self):
        clean, film = line_law(1e3, **EQUAL), line_law(1e3, film=FILM, **EQUAL)
        assert 1 / film.conductance - 1 / clean.conductance == pytest.approx(FILM / (2 * clean.half_width), rel=1e-12)

    def test_wires_that_yield_conduct_by_the_strip_of_their_hardness(self):
        _, _, (b, conductance, *_), _ = at_overlap(UNEQUAL, 1e-7, hardness=1e9, film=FILM)
        force = Formulas(UNEQUAL).force(1e-7)
        assert b == pytest.approx(force / 2e9, rel=1e-13)
        assert conductance == pytest.approx(Formulas(UNEQUAL).conductance(force, FILM, b), rel=1e-13)

    def test_wires_that_hardly_resist_have_no_strip_wider_than_half_of_its_far_field(self):
        # crossed: A (b/b_H)^2 would be 3 times the square of that
        _, _, (b, conductance, slope, by_angle), _ = at_overlap(EQUAL, 1e-6, pi / 2, hardness=1e6)
        widest = EQUAL["radius"][0] / 4
        section = np.exp(-2 * (np.log(2 * EQUAL["radius"][0] / widest) + 1 / 8))
        assert b > widest
        assert 1 / conductance == pytest.approx(
            -sum(EQUAL["resistivity"]) / (2 * pi) * np.log(0.25 + section), rel=1e-12
        )
        assert (slope, by_angle) == (0, 0)


@pytest.mark.parametrize("wires", WIRES)
@pytest.mark.parametrize("degrees", [90.0, 30.0, 5.0, 0.1])
class TestCrossedWires:
    """Under a small force the section is far from the strip: the far field is the lens."""

    def law(self, wires, degrees):
        return line_law(1e-14, angle=np.radians(degrees), **wires)

    def integral(self, wires, degrees, approach):
        """Length of the lens: integral of the overlap over it, divided by the deepest overlap; and its length."""
        half = np.sqrt(2 * sum(wires["radius"]) * approach) / np.sin(np.radians(degrees))
        return 4 / 3 * half, 2 * half

    def test_the_force_over_the_lens_is_that_of_hertz(self, wires, degrees):
        law, spot = self.law(wires, degrees), contact_spot(0.1, angle=np.radians(degrees), **wires)
        mean_length, _ = self.integral(wires, degrees, spot.approach)
        # A/B is 1e-12 here
        assert 1e-14 / law.approach * spot.approach * mean_length == pytest.approx(0.1, rel=1e-9)

    def test_the_conductance_over_the_lens_is_that_of_holm(self, wires, degrees):
        law, spot = self.law(wires, degrees), contact_spot(0.1, angle=np.radians(degrees), **wires)
        _, length = self.integral(wires, degrees, spot.approach)
        assert law.conductance * length == pytest.approx(spot.conductance, rel=1e-9)


@pytest.mark.parametrize("wires", WIRES)
@pytest.mark.parametrize("angle", ANGLES)
class TestEveryAngle:
    def test_the_formulas_of_the_theory(self, wires, angle):
        formulas = Formulas(wires, angle)
        law = line_law(FORCES, angle=angle, film=FILM, **wires)
        for i, f in enumerate(FORCES):
            assert law.half_width[i] == pytest.approx(formulas.half_width(f), rel=1e-13)
            assert law.approach[i] == pytest.approx(formulas.approach(f), rel=1e-12)
            assert law.conductance[i] == pytest.approx(formulas.conductance(f, FILM), rel=1e-12)

    @pytest.mark.parametrize("force", FORCES)
    def test_derivatives_by_the_force(self, wires, angle, force):
        law = line_law(force, angle=angle, film=FILM, **wires)

        def at(s):
            return np.array(line_law(force * (1 + s), angle=angle, film=FILM, **wires)[:4])[[1, 3]]

        # truncation of sixth order with the step 0.02, round-off of 1e-14
        slopes = derivative(at, 0.0, 0.02)[:, 0] / force
        assert law.dapproach_df == pytest.approx(slopes[0], rel=1e-10)
        assert law.dconductance_df == pytest.approx(slopes[1], rel=1e-9)

    def test_the_strip_of_a_hardness(self, wires, angle):
        formulas, hardness = Formulas(wires, angle), 1e9

        def at(overlap):
            (force, *_), _, (b, conductance, *_), _ = at_overlap(wires, overlap, angle, hardness=hardness)
            return np.array([force, b, conductance])

        overlap = 1e-4 * min(wires["radius"])
        force, b, conductance = at(overlap)
        assert b == pytest.approx(force / (2 * hardness), rel=1e-13)
        assert conductance == pytest.approx(formulas.conductance(force, half_width=b), rel=1e-12)
        *_, (_, _, slope, *_), _ = at_overlap(wires, overlap, angle, hardness=hardness)
        slopes = derivative(lambda s: at(overlap * (1 + s)), 0.0, 0.02)[:, 0]
        assert slope == pytest.approx(slopes[2] / slopes[0], rel=1e-9)

    @pytest.mark.parametrize("share", [1e-6, 1e-4, 1e-2])
    def test_the_force_is_the_inverse_of_the_approach(self, wires, angle, share):
        overlap = share * min(wires["radius"])
        (force, stiffness, *_), (again, inverse, _), *_ = at_overlap(wires, overlap, angle)
        assert force == pytest.approx(Formulas(wires, angle).force(overlap), rel=1e-12)
        assert again == pytest.approx(overlap, rel=1e-13)
        assert stiffness == pytest.approx(inverse, rel=1e-13)
        assert stiffness * line_law(force, angle=angle, **wires).dapproach_df == pytest.approx(1, rel=1e-13)

    @pytest.mark.parametrize("penalty", [0.0, 2e10])
    @pytest.mark.parametrize("share", [1e-6, 1e-4, 1e-2])
    def test_stiffness_and_force_are_derivatives_of_the_energy(self, wires, angle, share, penalty):
        overlap = share * min(wires["radius"])
        (force, stiffness, *_), (_, _, dstiffness_dforce), *_ = at_overlap(wires, overlap, angle, penalty)

        def by_overlap(s):
            normal, inverse, *_ = at_overlap(wires, overlap * (1 + s), angle, penalty)
            return np.array([normal[3], normal[0], inverse[1]])

        slopes = derivative(by_overlap, 0.0, 0.02)[:, 0] / overlap
        assert force == pytest.approx(slopes[0], rel=1e-10)
        assert stiffness == pytest.approx(slopes[1], rel=1e-10)
        assert dstiffness_dforce * stiffness == pytest.approx(slopes[2], rel=1e-8, abs=1e-10 * stiffness / overlap)

    @pytest.mark.parametrize("share", [1e-6, 1e-4, 1e-2])
    def test_the_energy_is_the_integral_of_the_force(self, wires, angle, share):
        # Gauss with overlap = depth s^4, where the logarithm of the force is hardly felt
        overlap = share * min(wires["radius"])
        s, weight = np.polynomial.legendre.leggauss(24)
        s, weight = (s + 1) / 2, weight / 2
        integral = sum(
            w * at_overlap(wires, overlap * x**4, angle)[0][0] * 4 * overlap * x**3
            for x, w in zip(s, weight, strict=True)
        )
        assert at_overlap(wires, overlap, angle)[0][3] == pytest.approx(integral, rel=1e-9)

    def test_the_force_rises_with_the_overlap(self, wires, angle):
        overlaps = min(wires["radius"]) * np.geomspace(1e-18, 0.3, 200)
        found = [at_overlap(wires, overlap, angle)[0] for overlap in overlaps]
        for values in (np.array(found)[:, 0], np.array(found)[:, 3]):
            assert values[0] > 0
            assert (np.diff(values) > 0).all()


@pytest.mark.parametrize("wires", WIRES)
@pytest.mark.parametrize("angle", [0.01, 0.3, 1.2])
def test_derivatives_by_the_angle(wires, angle):
    overlap = 1e-4 * min(wires["radius"])
    (force, stiffness, dforce_dangle, _), _, (*_, dconductance_dangle), _ = at_overlap(wires, overlap, angle, film=FILM)

    def by_angle(s):
        angle_then = angle * (1 + s)
        normal, *_ = at_overlap(wires, overlap, angle_then)
        # the conductance at the fixed force
        return np.array([normal[0], line_law(force, angle=angle_then, film=FILM, **wires).conductance])

    slopes = derivative(by_angle, 0.0, 0.01)[:, 0] / angle
    assert dforce_dangle == pytest.approx(slopes[0], rel=1e-8)
    assert dconductance_dangle == pytest.approx(slopes[1], rel=1e-8)
    assert stiffness > 0


class TestWhatIsRefused:
    #: Force per length at which b = r/4 of two equal wires: pi E* r/32
    LIMIT: ClassVar[float] = pi * 120e9 / (2 * (1 - 0.34**2)) * 1e-3 / 32

    def test_a_strip_wider_than_a_quarter_of_the_radius(self):
        assert line_law(self.LIMIT * 0.9999, **EQUAL).half_width == pytest.approx(0.25e-3, rel=1e-4)
        with pytest.raises(ValueError, match="half width is more than a quarter of the smaller radius"):
            line_law(self.LIMIT * 1.0001, **EQUAL)

    def test_the_smaller_radius_counts(self):
        # R = 1e-3 3e-4/1.3e-3; b = 0.25 3e-4
        formulas = Formulas(UNEQUAL)
        limit = (0.25 * 3e-4 / formulas.half_width(1.0)) ** 2
        line_law(limit * 0.9999, **UNEQUAL)
        with pytest.raises(ValueError, match="half width"):
            line_law(limit * 1.0001, **UNEQUAL)

    def test_one_of_many_is_named(self):
        with pytest.raises(ValueError, match="point 2: the contact is wider"):
            line_law([1.0, 2.0, 2 * self.LIMIT], **EQUAL)

    @pytest.mark.parametrize(
        ("changed", "words"),
        [
            (dict(radius=0.0), "radius must be greater than 0"),
            (dict(young=[1e9, -1.0]), "young must be greater than 0"),
            (dict(poisson=0.5), "poisson must be between -1 and 0.5"),
            (dict(resistivity=0.0), "resistivity must be greater than 0"),
            (dict(angle=-0.1), "angle must be from 0"),
            (dict(film=-1.0), "film must not be negative"),
            (dict(force_per_length=np.nan), "force_per_length must be finite"),
            (dict(force_per_length="much"), "force_per_length must be an array of real numbers"),
            (dict(radius=[1.0, 2.0, 3.0]), r"radius must have shape \(2,\)"),
        ],
    )
    def test_bad_input(self, changed, words):
        with pytest.raises(ValueError, match=words):
            line_law(**{"force_per_length": 1.0, **EQUAL, **changed})


class TestBeyondTheWidestStrip:
    """What iterates see: the force goes on as a straight line, and says so."""

    def test_force_stiffness_and_energy_are_continuous(self):
        high = Formulas(EQUAL).approach(TestWhatIsRefused.LIMIT)
        (*below, _), (*above, _) = ((*at_overlap(EQUAL, high * (1 + s))[0], None) for s in (-1e-9, 1e-9))
        assert above == pytest.approx(below, rel=1e-8)
        assert not at_overlap(EQUAL, high * (1 - 1e-9))[3].any()
        assert at_overlap(EQUAL, high * (1 + 1e-9))[3].all()

    def test_it_is_a_straight_line_with_the_energy_below_it(self):
        high = Formulas(EQUAL).approach(TestWhatIsRefused.LIMIT)
        (force, stiffness, _, energy), (overlap, inverse, change), *_ = at_overlap(EQUAL, 3 * high)
        (force_there, stiffness_there, _, energy_there), *_ = at_overlap(EQUAL, high)
        assert stiffness == pytest.approx(stiffness_there, rel=1e-12)
        assert force == pytest.approx(force_there + 2 * high * stiffness, rel=1e-12)
        assert energy == pytest.approx(energy_there + high * (force + force_there), rel=1e-12)
        assert (overlap, inverse, change) == pytest.approx((3 * high, stiffness, 0), rel=1e-12)


def test_without_a_force_there_is_nothing():
    assert not np.array(line_law([0.0, -1.0], **EQUAL)).any()
    for overlap in (0.0, -1e-6):
        assert all(not np.array(values).any() for values in at_overlap(EQUAL, overlap))


def test_many_forces_at_once_are_those_one_by_one():
    angles = [0.0, 0.1, 1.0, 2.0]
    many = line_law(FORCES, angle=angles, radius=[[1e-3, 2e-3]] * 4, young=1e11, poisson=0.3, resistivity=[1e-8, 2e-8])
    for i, (force, angle) in enumerate(zip(FORCES, angles, strict=True)):
        one = line_law(force, angle=angle, radius=[1e-3, 2e-3], young=1e11, poisson=0.3, resistivity=[1e-8, 2e-8])
        assert tuple(float(value[i]) for value in many) == one


class TestLens:
    """The same law over the whole lens of two wires that cross, as one point."""

    @staticmethod
    def lens(gap, sine, wires=UNEQUAL, penalty=0.0, film=0.0, hardness=0.0):
        return _core.f2py_line.lens_law(gap, sine, *wires.values(), penalty, film, hardness)

    @pytest.mark.parametrize("wires", WIRES)
    @pytest.mark.parametrize("degrees", [90.0, 10.0, 1.0, 0.2])
    @pytest.mark.parametrize("share", [1e-5, 1e-4, 1e-3])
    @pytest.mark.parametrize("film", [0.0, FILM])
    def test_force_and_conductance_are_those_of_the_line(self, wires, degrees, share, film):
        # overlap along straight wires: delta (1 - (x/aW)^2), here with 60 Gauss points
        sine, overlap = np.sin(np.radians(degrees)), share * min(wires["radius"])
        (half, force, *_), (conductance, *_) = self.lens(-overlap, sine, wires, film=film)
        assert half == pytest.approx(np.sqrt(2 * (sum(wires["radius"]) - overlap) * overlap) / sine, rel=1e-13)
        u, weight = np.polynomial.legendre.leggauss(60)
        along = [at_overlap(wires, overlap * (1 - x**2), np.radians(degrees), film=film) for x in u]
        ratio = force / (half * weight @ [normal[0] for normal, *_ in along])
        assert ratio == pytest.approx(1, abs=1e-3)
        ratio = conductance / (half * weight @ [spot[1] for _, _, spot, _ in along])
        # the conductance of a strip falls steeply at the ends of the lens, that of a film as the square root of the force
        assert ratio == pytest.approx(1, abs=0.011 if film else 0.005)

    @pytest.mark.parametrize("laws", [{}, dict(film=FILM), dict(penalty=3e10), dict(hardness=1e9)])
    @pytest.mark.parametrize("sine", [0.01, 0.3, 0.9])
    def test_derivatives(self, laws, sine):
        gap, angle = -3e-8, np.arcsin(sine)
        (_, force, by_gap, by_angle, _, *energy_by_angle), (_, spot_by_gap, spot_by_angle, _) = self.lens(
            gap, sine, **laws
        )

        def at(gap, angle):
            normal, spot = self.lens(gap, np.sin(angle), **laws)
            return np.array([normal[1], spot[0], normal[4], normal[5]])

        gaps = derivative(lambda s: at(gap * (1 + s), angle), 0.0, 0.01)[:, 0] / gap
        angles = derivative(lambda s: at(gap, angle * (1 + s)), 0.0, 0.01)[:, 0] / angle
        assert (by_gap, spot_by_gap) == pytest.approx(gaps[:2], rel=1e-8)
        assert (by_angle, spot_by_angle) == pytest.approx(angles[:2], rel=1e-8)
        # six Gauss points over the overlap
        assert -force == pytest.approx(gaps[2], rel=1e-6)
        assert energy_by_angle == pytest.approx(angles[2:], rel=1e-8)

    def test_the_curvature_may_make_the_lens_shorter_than_at_90_degrees(self):
        (half, *_), _ = self.lens(-1e-8, 1.2)
        (right_angle, *_), _ = self.lens(-1e-8, 1.0)
        assert half == pytest.approx(right_angle / 1.2, rel=1e-13)

    def test_open_wires_have_no_lens(self):
        assert all(not np.array(values).any() for values in self.lens(0.0, 0.5))

    def test_short_lenses_are_points_and_long_ones_lines(self):
        share = _core.f2py_line.share_of_point
        assert [share(length, 1.0)[0] for length in (0.0, 1.99, 2.0, 4.0, 6.0, 9.0)] == [1, 1, 1, 0.5, 0, 0]
        lengths = np.linspace(1.5, 6.5, 41) * 3.0
        assert (np.diff([share(length, 3.0)[0] for length in lengths]) <= 0).all()
        for length in (1.0, 7.0, 11.0, 17.5, 30.0):
            slope = derivative(lambda s, length=length: share(length + s, 3.0)[0], 0.0, 1e-3)[0]
            assert share(length, 3.0)[1] == pytest.approx(slope, abs=1e-10)
