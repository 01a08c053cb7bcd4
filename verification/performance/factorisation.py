"""Factorisation against CHOLMOD called directly, and against the processor's products of dense matrices

The stiffness of the unloaded strut lattice, as a file for the program factorisation.f90, which runs in turn: dense
products (1500 x 1500), litz's block solver, and CHOLMOD as a program of its own would call it, with three orderings.
litz's factorisation includes scaling to a unit diagonal, and its pivots; its solution includes a step of refinement.
"""

import os
import statistics
import subprocess
import sys
from pathlib import Path

import numpy as np
from scipy.sparse import coo_matrix

from verification import figures

from .lattice import POISSON, RADIUS, YOUNG, lattice
from .process import blas_kernels, run_process

SIZES = (1_000, 10_000, 100_000)
QUICK_SIZES = (1_000, 3_000)
ORDERINGS = ("default", "metis", "amd")


def strut_stiffness(along):
    """Stiffness of straight round struts without shear along vectors (m, 3): (m, 12, 12).

    Source: Euler and Bernoulli's beam, any textbook of matrix structural analysis.
    """
    length = np.linalg.norm(along, axis=1)
    area, second = np.pi * RADIUS**2, np.pi * RADIUS**4 / 4
    shear_modulus = YOUNG / (2 * (1 + POISSON))
    axial, twist = YOUNG * area / length, shear_modulus * 2 * second / length
    a, b, c = (YOUNG * second * factor / length**power for factor, power in ((12, 3), (6, 2), (4, 1)))
    k = np.zeros((len(along), 12, 12))
    for i, j, value in ((0, 0, axial), (3, 3, twist)):
        k[:, i, j] = k[:, i + 6, j + 6] = value
        k[:, i, j + 6] = k[:, i + 6, j] = -value
    # bending: transverse displacement, rotation, and the sign that couples them
    for u, phi, sign in ((1, 5, 1), (2, 4, -1)):
        for first, second_end, value in ((u, u, a), (phi, phi, c)):
            k[:, first, second_end] = k[:, first + 6, second_end + 6] = value
        k[:, u, u + 6] = k[:, u + 6, u] = -a
        k[:, phi, phi + 6] = k[:, phi + 6, phi] = c / 2
        for row, column, value in ((u, phi, b), (u, phi + 6, b), (u + 6, phi, -b), (u + 6, phi + 6, -b)):
            k[:, row, column] = k[:, column, row] = sign * value
    turn = np.zeros((len(along), 12, 12))
    t = along / length[:, None]
    n = np.cross(np.eye(3)[np.argmin(abs(t), axis=1)], t)
    n /= np.linalg.norm(n, axis=1)[:, None]
    for block in range(0, 12, 3):
        turn[:, block : block + 3, block : block + 3] = np.stack([t, n, np.cross(t, n)], axis=1)
    return np.swapaxes(turn, 1, 2) @ k @ turn


def lattice_stiffness(n):
    """Stiffness over the free unknowns in compressed rows, and the number of elements."""
    nodes, elements, height = lattice(n)
    free = np.repeat((nodes[:, 2] > 0) & (nodes[:, 2] < height), 6)
    unknowns = (6 * elements[:, :, None] + np.arange(6)).reshape(-1, 12)
    rows, columns = np.repeat(unknowns, 12, axis=1), np.tile(unknowns, 12)
    k = strut_stiffness(nodes[elements[:, 1]] - nodes[elements[:, 0]])
    matrix = coo_matrix((k.ravel(), (rows.ravel(), columns.ravel()))).tocsr()[free][:, free]
    matrix.sort_indices()
    return matrix, len(elements)


def write_matrix(path, matrix):
    with path.open("wb") as file:
        np.array([matrix.shape[0], matrix.nnz], dtype=np.int32).tofile(file)
        (matrix.indptr + 1).astype(np.int32).tofile(file)
        (matrix.indices + 1).astype(np.int32).tofile(file)
        matrix.data.tofile(file)


def program():
    """The measuring program, built where litz was built."""
    build = Path(os.environ.get("LITZ_BUILD", Path(sys.prefix) / "build"))
    done = subprocess.run(
        ["ninja", "-C", build, "verification/factorisation"], capture_output=True, text=True, check=False
    )
    if done.returncode != 0:
        raise RuntimeError(f"verification/factorisation does not build in {build}:\n{done.stdout}")
    return build / "verification" / "factorisation"


def measure(quick, directory):
    rows = []
    for size in QUICK_SIZES if quick else SIZES:
        matrix, elements = lattice_stiffness(size)
        path = directory / f"stiffness_{elements}.bin"
        write_matrix(path, matrix)
        repetitions = 2 if quick else 5 if size < 50_000 else 3
        run = run_process([program(), path, repetitions], environment=blas_kernels())
        path.unlink()
        if run.code != 0:
            raise RuntimeError(f"factorisation ended with code {run.code}:\n{run.printed}")
        found = {}
        for line in run.printed.splitlines():
            name, value = line.split()
            found.setdefault(name, []).append(float(value))
        rows.append(
            {"elements": elements, "equations": matrix.shape[0], **{k: statistics.median(v) for k, v in found.items()}}
        )
        row = rows[-1]
        # of the same repetition: what else the machine did changes from one to the next
        ratios = [a / b for a, b in zip(found["litz_factor"], found["cholmod_default_factor"], strict=True)]
        row["factor_ratio"] = statistics.median(ratios)
        rates = [
            row["cholmod_default_flops"] / seconds / rate
            for seconds, rate in zip(found["litz_factor"], found["product_rate"], strict=True)
        ]
        row["rate_of_product"] = statistics.median(rates)
    return {"sizes": rows}


def tables(values):
    lines = []
    for row in values["sizes"]:
        size = row["elements"], row["equations"]
        times = (row[f"litz_{part}"] for part in ("analyse", "factor", "solve"))
        lines.append([*size, "litz", *times, None, None, row["factor_ratio"], row["rate_of_product"]])
        for ordering in ORDERINGS:
            name = f"cholmod_{ordering}"
            times = (row[f"{name}_{part}"] for part in ("analyse", "factor", "solve"))
            numbers = row[f"{name}_entries"] / 1e6, row[f"{name}_flops"] / 1e9
            rate = row[f"{name}_flops"] / row[f"{name}_factor"] / row["product_rate"]
            lines.append([*size, f"CHOLMOD, {ordering} ordering", *times, *numbers, 1, rate])
    header = (
        "elements,equations,program,analyse [s],factor [s],solve [s],entries [1e6],operations [1e9],"
        "factor / CHOLMOD's,rate / dense product"
    )
    return [("One matrix", header.split(","), lines)]


def aims(values):
    return [
        (f"{row['elements']} elements: factorisation over CHOLMOD's own", row["factor_ratio"], 1.3)
        for row in values["sizes"]
    ]


def draw(values, path):
    rows = values["sizes"]
    n = [row["elements"] for row in rows]
    with figures.panels(path, columns=2) as (time, rate):
        time.loglog(n, [row["litz_factor"] for row in rows], "o-", color="#c4451c", label="litz")
        for ordering, marker in zip(ORDERINGS, "s^v", strict=True):
            label = f"CHOLMOD, {ordering} ordering"
            time.loglog(n, [row[f"cholmod_{ordering}_factor"] for row in rows], marker=marker, label=label)
        time.set(xlabel="elements", ylabel="factorisation [s]")
        time.legend()
        rate.semilogx(n, [row["rate_of_product"] for row in rows], "o-", color="#c4451c")
        rate.set(xlabel="elements", ylabel="rate over that of dense products", ylim=(0, 1))
