"""Complete elliptic integrals against mpmath with 50 digits: round-off everywhere, no loss at either end."""

import mpmath
import numpy as np
import pytest

from derivatives import derivative
from litz import _core

NAMES = ["K", "E", "B", "D", "C", "dK/dm", "dE/dm"]
PARAMETERS = [0.0, 1e-300, 1e-18, 1e-9, 1e-4, 0.01, 0.3, 0.499999, 0.5, 0.500001, 0.7, 0.9, 0.99, 0.9999, 1 - 1e-12]
COMPLEMENTARY = [1e-300, 1e-60, 1e-18, 1e-9, 1e-5, 0.01, 0.3, 0.5, 0.7, 0.99, 1 - 1e-9, 1.0]
#: A few roundings, in units of the last place
ROUNDINGS = 8 * np.finfo(float).eps


def exact(m, m1):
    """The same seven values from their definitions; `m` and `m1` with 50 digits."""
    k, e = mpmath.ellipk(m), mpmath.ellipe(m)
    if m == 0:
        b = d = mpmath.pi / 4
        c = mpmath.pi / 16
    else:
        b, d = (e - m1 * k) / m, (k - e) / m
        c = (d - b) / m
    return [k, e, b, d, c, b / (2 * m1), -d / 2]


@pytest.fixture(autouse=True)
def digits():
    # differences such as K - E at m = 1e-300 need many more digits than they leave
    with mpmath.workdps(700):
        yield


def relative_error(values, reference):
    return {name: float(abs(v / r - 1)) for name, v, r in zip(NAMES, map(mpmath.mpf, values), reference, strict=True)}


@pytest.mark.parametrize("m", PARAMETERS)
def test_integrals_at_the_parameter(m):
    values = _core.f2py_contact.elliptic(m, False)
    errors = relative_error(values, exact(mpmath.mpf(m), 1 - mpmath.mpf(m)))
    assert max(errors.values()) < ROUNDINGS, errors


@pytest.mark.parametrize("m1", COMPLEMENTARY)
def test_integrals_at_the_complementary_parameter(m1):
    values = _core.f2py_contact.elliptic(m1, True)
    errors = relative_error(values, exact(1 - mpmath.mpf(m1), mpmath.mpf(m1)))
    assert max(errors.values()) < ROUNDINGS, errors


@pytest.mark.parametrize("m", [0.05, 0.4, 0.5, 0.6, 0.9])
def test_derivatives_are_those_of_the_integrals(m):
    numeric = derivative(lambda x: _core.f2py_contact.elliptic(float(x), False)[:2], m, 2e-3)[:, 0]
    assert _core.f2py_contact.elliptic(m, False)[5:] == pytest.approx(numeric, rel=1e-9)
