"""A network of struts as a deck: body-centred cubic cells, jittered, compressed between two plates.

The same network as that of the other programs it is compared with: every cell has eight struts from its centre to its
corners, each of two elements. Bottom clamped; top pushed down, held laterally and against rotation.
"""

import numpy as np

RADIUS, YOUNG, POISSON = 0.05, 1000.0, 0.3
#: Compression of the network over its height
STRAIN = 0.02


def lattice(n, *, per_strut=2, seed=1, jitter=0.1):
    """About n elements: nodes (nodes, 3), connectivity (elements, 2) from 0, and the number of cells along z."""
    rng = np.random.default_rng(seed)
    nx = max(2, round((n / (8 * per_strut)) ** (1 / 3)))
    nz = max(2, round(n / (8 * per_strut * nx**2)))
    corner = np.stack(np.meshgrid(*map(np.arange, (nx + 1, nx + 1, nz + 1)), indexing="ij"), -1).reshape(-1, 3)
    cell = np.stack(np.meshgrid(*map(np.arange, (nx, nx, nz)), indexing="ij"), -1).reshape(-1, 3)
    number = np.arange(len(corner)).reshape(nx + 1, nx + 1, nz + 1)
    shift = rng.uniform(-jitter, jitter, corner.shape)
    shift[(corner[:, 2] == 0) | (corner[:, 2] == nz), 2] = 0.0
    joints = np.concatenate([corner + shift, cell + 0.5 + rng.uniform(-jitter, jitter, cell.shape)])
    ends = [
        np.stack([number[tuple((cell + step).T)], len(corner) + np.arange(len(cell))], axis=1)
        for step in np.ndindex(2, 2, 2)
    ]
    struts = np.stack(ends, axis=1).reshape(-1, 2)
    t = np.arange(1, per_strut)[None, :, None] / per_strut
    first, last = (joints[struts[:, i], None] for i in (0, 1))
    inner = len(joints) + np.arange(len(struts) * (per_strut - 1)).reshape(len(struts), per_strut - 1)
    chain = np.concatenate([struts[:, :1], inner, struts[:, 1:]], axis=1)
    nodes = np.concatenate([joints, (first + t * (last - first)).reshape(-1, 3)])
    return nodes, np.stack([chain[:, :-1], chain[:, 1:]], axis=-1).reshape(-1, 2), nz


def lattice_deck(n, *, element="B33", strain=STRAIN, increments=5, **options):
    """Text of the deck, and the number of elements."""
    nodes, connectivity, height = lattice(n, **options)
    rows = [f"{i}, {x:.16g}, {y:.16g}, {z:.16g}" for i, (x, y, z) in enumerate(nodes, start=1)]
    elements = [f"{i}, {a + 1}, {b + 1}" for i, (a, b) in enumerate(connectivity, start=1)]
    plates = {"BOTTOM": nodes[:, 2] == 0.0, "TOP": nodes[:, 2] == height}
    sets = [f"*NSET, NSET={name}\n" + "\n".join(map(str, np.flatnonzero(on) + 1)) for name, on in plates.items()]
    lines = [
        "*HEADING",
        f"strut lattice of {len(elements)} elements",
        "*NODE",
        *rows,
        f"*ELEMENT, TYPE={element}, ELSET=BEAMS",
        *elements,
        *sets,
        f"*MATERIAL, NAME=STRUT\n*ELASTIC\n{YOUNG}, {POISSON}",
        f"*BEAM SECTION, ELSET=BEAMS, MATERIAL=STRUT, SECTION=CIRC\n{RADIUS}",
        f"*STEP\n*STATIC, DIRECT\n{1 / increments:.16g}, 1.",
        f"*BOUNDARY\nBOTTOM, 1, 6\nTOP, 1, 2\nTOP, 4, 6\nTOP, 3, 3, {-strain * height:.16g}",
        "*NODE PRINT, NSET=TOP, TOTALS=ONLY\nRF",
        "*END STEP",
    ]
    return "\n".join(lines) + "\n", len(elements)
