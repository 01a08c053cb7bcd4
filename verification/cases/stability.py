"""Critical loads of rods: Euler, Prandtl, Greenhill, Michell, from the exact tangents of the kernels.

Sources: Euler's column with E A and G A finite, E. Reissner's strains linearised about the compressed straight rod:
P (1 - P/EA + P/GA) = E I (pi/L_k)^2. Lateral buckling of a narrow cantilever under a load at the centroid of its tip:
L. Prandtl, Kipperscheinungen (1899), A. G. M. Michell, Phil. Mag. 48 (1899) 298-309: P = 4.0126 sqrt(E I GJ)/L^2.
Twisted rod: A. G. Greenhill, Proc. Inst. Mech. Eng. 34 (1883) 182-225, M = 2 pi E I/L with hinged ends and an axial
torque; with clamped ends tan(u) = u, u = M L/(2 E I) = 4.4934. Twisted ring: A. G. M. Michell (1889), E. E. Zajac, J.
Appl. Mech. 29 (1962) 136-142: twist 2 pi sqrt(3) E I/GJ. Meshes of 16, 32 and 64 elements; critical is where an
eigenvalue of the tangent passes zero.
"""

import numpy as np

from verification import figures
from verification.claims import read_claims
from verification.deck_text import Rigidity, straight
from verification.kernel_frame import KernelFrame, critical, extrapolate, rotation

MESHES = (16, 32, 64)
ELEMENTS = ("B31", "B33")
HELD, FREE = [True] * 6, [False] * 6

#: Held unknowns ux uy uz phix phiy phiz at both ends; the second end may slide along the rod
ENDS = {
    "free": (HELD, FREE),
    "hinged": ([True] * 4 + [False] * 2, [False, True, True, False, False, False]),
    "clamped": (HELD, [False] + [True] * 5),
}
BUCKLING_LENGTH = {"free": 2.0, "hinged": 1.0, "clamped": 0.5}


def rod(element, rigidity, n, ends):
    """A straight rod of length 1 along x."""
    chain = np.column_stack([np.arange(n), np.arange(1, n + 1)])
    fixed = np.zeros((n + 1, 6), dtype=bool)
    fixed[0], fixed[-1] = ends
    return KernelFrame(element, rigidity, straight(1.0, n), chain, np.tile(np.eye(3), (n, 2, 1, 1)), fixed)


def euler_load(element, n, ends):
    """Critical compression of a rod that shortens and shears, P/(E I/L^2)."""
    rigidity = Rigidity(ea=1e4, ga=4e3, gj=1.0, ei2=1.0, ei3=1.0)

    def is_stable(load):
        frame = rod(element, rigidity, n, ENDS[ends])
        frame.x[:, 0] *= 1.0 - load / rigidity.ea
        return frame.eigenvalues("hessian")[0] > 0.0

    first = (np.pi / BUCKLING_LENGTH[ends]) ** 2
    return critical(is_stable, 0.5 * first, 1.5 * first)


def prandtl_load(element, n):
    """Critical tip load of a cantilever that is 1e5 times stiffer in the plane of the load, P L^2/sqrt(E I GJ)."""
    rigidity = Rigidity(ea=1e7, ga=1e7, gj=0.5, ei2=1.0, ei3=1e5)

    def is_stable(load):
        frame = rod(element, rigidity, n, ENDS["free"])
        loads = np.zeros((n + 1, 6))
        loads[-1, 1] = load * np.sqrt(rigidity.gj)
        frame.equilibrium(loads)
        return frame.eigenvalues("hessian")[0] > 0.0

    return critical(is_stable, 3.0, 5.0)


def greenhill_torque(element, n, ends):
    """Critical torque of a straight rod, M L/(E I); the torque keeps its axis."""
    rigidity = Rigidity(ea=1e6, ga=1e6, gj=0.7, ei2=1.0, ei3=1.0)
    first, second = ENDS[ends]
    # the second end turns about x with the torque
    second = [*second[:3], ends == "clamped", *second[4:]]

    def is_stable(torque):
        frame = rod(element, rigidity, n, (first, second))
        frame.rotations = np.array([rotation([torque / rigidity.gj * s, 0.0, 0.0]) for s in frame.x[:, 0]])
        return frame.eigenvalues()[0] > 0.0

    return critical(is_stable, 4.5, 12.0)


def ring_twist(element, n):
    """Critical twist of a straight rod that is twisted and closed to a ring, twist GJ/(2 pi E I)."""
    rigidity = Rigidity(ea=1e6, ga=1e6, gj=0.8, ei2=1.0, ei3=1.0)
    length = 1.0 / n
    angle = 2.0 * np.pi * np.arange(n) / n
    points = length / (2.0 * np.sin(np.pi / n)) * np.column_stack([np.sin(angle), -np.cos(angle), 0.0 * angle])
    chain = np.column_stack([np.arange(n), (np.arange(n) + 1) % n])
    axes = np.array([rotation([0.0, 0.0, a]) for a in angle])
    triads = axes[chain]
    free_points = np.tile([[0.0, 0.0, 0.0], [length, 0.0, 0.0]], (n, 1, 1))

    def is_stable(twist):
        free_triads = np.tile(np.eye(3), (n, 2, 1, 1))
        free_triads[:, 1] = rotation([-twist * 2.0 * np.pi / rigidity.gj / n, 0.0, 0.0])
        frame = KernelFrame(
            element, rigidity, points, chain, triads, np.zeros((n, 6), dtype=bool), (free_points, free_triads)
        )
        frame.equilibrium(np.zeros((n, 6)))
        # six rigid motions and the rolling of the sections cost no energy
        return frame.eigenvalues("hessian")[0] > -1e-5

    return critical(is_stable, 1.4, 2.2, digits=7)


PROBLEMS = {
    **{f"euler.{ends}": lambda element, n, ends=ends: euler_load(element, n, ends) for ends in ENDS},
    "prandtl": prandtl_load,
    **{
        f"greenhill.{ends}": lambda element, n, ends=ends: greenhill_torque(element, n, ends)
        for ends in ("hinged", "clamped")
    },
    "ring": ring_twist,
}


def measure(workspace):
    values, loads = {}, {}
    for element in ELEMENTS:
        for name, problem in PROBLEMS.items():
            found = [float(problem(element, n)) for n in MESHES]
            loads[f"{element}.{name}"] = found
            values[f"stability.{element}.{name}"] = extrapolate(found[-2], found[-1], order=2)
    return values | {"figure": loads}


def draw(values, path):
    exact = {claim.id: claim.reference for claim in read_claims()}
    with figures.panels(path, height=3.4) as axes:
        for panel, element in zip(axes, ELEMENTS, strict=True):
            for name in PROBLEMS:
                limit = exact[f"stability.{element}.{name}"]
                error = [abs(load / limit - 1.0) for load in values["figure"][f"{element}.{name}"]]
                panel.loglog(MESHES, error, "o-", label=name.replace(".", ", "))
            figures.order_line(panel, MESHES, 2, 0.1)
            panel.set(xlabel="elements", ylabel="critical load / exact - 1", title=element)
        panel.legend(fontsize=7, loc="center left", bbox_to_anchor=(1.0, 0.5))


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["stability"]))
