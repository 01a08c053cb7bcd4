"""The broad phase finds every pair of near elements, none twice, none that is far."""

import sys
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from litz import kernels


def segment_distances(p0, p1, q0, q1):
    """Least distance of segments p and q, by a bounded minimisation over both parameters in closed form."""
    u, v, w = p1 - p0, q1 - q0, p0 - q0
    a, b, c, d, e = u @ u, u @ v, v @ v, u @ w, v @ w
    candidates = []
    if a * c - b * b > 1e-14 * a * c:
        candidates.append(((b * e - c * d) / (a * c - b * b), (a * e - b * d) / (a * c - b * b)))
    candidates += [(s, (b * s + e) / c) for s in (0.0, 1.0)]
    candidates += [((b * t - d) / a, t) for t in (0.0, 1.0)]
    return min(np.linalg.norm(w + s * u - t * v) for s, t in np.clip(candidates, 0, 1))


def random_pile(rng, n, *, long_element):
    """Elements of mixed radii and lengths in a box, some joined end to end; one may be as long as the box."""
    start = rng.uniform(0, 1, (n, 3))
    direction = rng.normal(size=(n, 3))
    length = rng.uniform(0.02, 0.3, n)
    if long_element:
        length[0] = 3.0
    end = start + direction / np.linalg.norm(direction, axis=1)[:, None] * length[:, None]
    x = np.vstack([start, end])
    connectivity = np.stack([np.arange(n), n + np.arange(n)], axis=1)
    connectivity[1::5, 0] = connectivity[0:-1:5, 1][: len(connectivity[1::5])]
    return x, connectivity, rng.uniform(0.002, 0.05, n)


@pytest.mark.parametrize("seed", range(6))
def test_random_piles_agree_with_brute_force(seed):
    rng = np.random.default_rng(seed)
    x, connectivity, radius = random_pile(rng, 120, long_element=seed % 2 == 0)
    skin = 0.01
    expected = []
    for i in range(len(connectivity)):
        for j in range(i + 1, len(connectivity)):
            if set(connectivity[i]) & set(connectivity[j]):
                continue
            ends = [*x[connectivity[i]], *x[connectivity[j]]]
            if segment_distances(*ends) <= radius[i] + radius[j] + skin:
                expected.append([i, j])
    found = kernels.contact_search(x, connectivity, radius, skin=skin)
    assert found.tolist() == expected
    assert len(expected) > 50


def all_distances(start, end):
    """Least distances (n, n) of all segments: of the inner minimum where there is one, and of the four ends."""
    u, v, w = (end - start)[:, None], (end - start)[None], start[:, None] - start[None]
    aa, ab, bb = (u * u).sum(-1), (u * v).sum(-1), (v * v).sum(-1)
    aw, bw = (u * w).sum(-1), (v * w).sum(-1)
    determinant = aa * bb - ab**2
    inner = determinant > 1e-12 * aa * bb
    safe = np.where(inner, determinant, 1.0)
    candidates = [
        (np.clip((ab * bw - bb * aw) / safe, 0, 1) * inner, np.clip((aa * bw - ab * aw) / safe, 0, 1) * inner)
    ]
    for end_of_one in (0.0, 1.0):
        fixed = np.full_like(aa, end_of_one)
        candidates.append((fixed, np.clip((ab * end_of_one + bw) / bb, 0, 1)))
        candidates.append((np.clip((ab * end_of_one - aw) / aa, 0, 1), fixed))
    return np.min([np.linalg.norm(w + s[..., None] * u - t[..., None] * v, axis=-1) for s, t in candidates], axis=0)


@pytest.mark.parametrize("offset", [0.0, -1e4])
@pytest.mark.parametrize(
    ("thicknesses", "lengths"),
    [
        ((0.01, 0.02), (0.05, 0.1)),
        ((1e-4, 0.3), (0.05, 0.1)),
        ((0.001, 0.002), (1e-3, 3.0)),
        ((1e-4, 0.2), (1e-4, 2.0)),
    ],
    ids=["alike", "thick and thin", "whiskers", "everything"],
)
def test_any_mixture_of_radii_and_lengths_agrees_with_brute_force(thicknesses, lengths, offset):
    """Enough elements for several threads: the sorted list is the same for any number of them."""
    rng = np.random.default_rng(7)
    n = 900
    direction = rng.normal(size=(n, 3))
    direction *= (np.exp(rng.uniform(*np.log(lengths), n)) / np.linalg.norm(direction, axis=1))[:, None]
    radius = np.exp(rng.uniform(*np.log(thicknesses), n))
    start = offset + rng.uniform(0, 0.6, (n, 3))
    distances = all_distances(start, start + direction)
    expected = np.argwhere(np.triu(distances <= radius[:, None] + radius, 1))
    found = kernels.contact_search(np.vstack([start, start + direction]), [[i, n + i] for i in range(n)], radius)
    assert np.array_equal(found, expected)
    assert len(expected) > 100


def test_parallel_elements_side_by_side_are_a_pair():
    x = [[0, 0, 0], [1, 0, 0], [0.5, 0.1, 0], [1.5, 0.1, 0]]
    assert kernels.contact_search(x, [[0, 1], [2, 3]], [0.05, 0.051]).tolist() == [[0, 1]]
    assert kernels.contact_search(x, [[0, 1], [2, 3]], [0.05, 0.049]).tolist() == []


def test_elements_far_apart_do_not_need_a_grid_as_large_as_the_space_between_them():
    x = np.array([[0, 0, 0], [1, 0, 0], [0.5, -1, 0.1], [0.5, 1, 0.1], [1e9, 0, 0], [1e9, 1, 0]])
    assert kernels.contact_search(x, [[0, 1], [2, 3], [4, 5]], [0.1, 0.1, 0.1]).tolist() == [[0, 1]]


def test_joined_elements_are_no_pair():
    x = [[0, 0, 0], [1, 0, 0], [1, 1, 0]]
    assert len(kernels.contact_search(x, [[0, 1], [1, 2]], [0.1, 0.1])) == 0


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"x": [[0, 0], [1, 0]]}, r"shape \(n, 3\)"),
        ({"connectivity": [[0, 9], [2, 3]]}, "outside 0 to 3"),
        ({"connectivity": [[0.5, 1.0], [2.0, 3.0]]}, "integers"),
        ({"radius": [0.1]}, "one value for each of the 2"),
        ({"radius": [0.1, -0.1]}, "positive"),
        ({"radius": [0.1, np.nan]}, "positive"),
        ({"skin": -1.0}, "skin"),
    ],
)
def test_bad_input_is_refused_in_words(change, message):
    arguments = {
        "x": [[-1, 0, 0], [1, 0, 0], [0, -1, 0.3], [0, 1, 0.3]],
        "connectivity": [[0, 1], [2, 3]],
        "radius": [0.1, 0.1],
        "skin": 0.0,
        **change,
    }
    with pytest.raises(ValueError, match=message):
        kernels.contact_search(arguments["x"], arguments["connectivity"], arguments["radius"], skin=arguments["skin"])


def test_more_pairs_than_can_be_counted_are_refused_in_words(monkeypatch):
    """Five parallel elements side by side are ten pairs."""
    x = [[i, 0.01 * j, 0] for i in range(2) for j in range(5)]
    connectivity = [[j, 5 + j] for j in range(5)]
    monkeypatch.setattr(kernels.search, "MAX_PAIRS", 10)
    assert len(kernels.contact_search(x, connectivity, [0.1] * 5)) == 10
    monkeypatch.setattr(kernels.search, "MAX_PAIRS", 9)
    with pytest.raises(ValueError, match="more than 9 pairs of elements"):
        kernels.contact_search(x, connectivity, [0.1] * 5)


def test_searches_in_several_threads_keep_their_pairs_apart():
    # threads change hands as often as they can
    interval = sys.getswitchinterval()
    sys.setswitchinterval(1e-6)
    try:
        with ThreadPoolExecutor(8) as threads:
            found = list(threads.map(lambda n: len(row_of_parallel_elements(n)), [2, 50, 9, 200] * 500))
    finally:
        sys.setswitchinterval(interval)
    assert found == [1, 49, 8, 199] * 500


def row_of_parallel_elements(n):
    """Pairs among elements side by side, each of which touches its neighbours."""
    x = [[end, 2.0 * i, 0.0] for i in range(n) for end in (-1.0, 1.0)]
    return kernels.contact_search(x, np.arange(2 * n).reshape(n, 2), np.full(n, 1.0), skin=0.1)
