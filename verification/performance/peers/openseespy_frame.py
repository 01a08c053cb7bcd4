"""OpenSeesPy: elasticBeamColumn (no shear) in corotational frames; links are springs that only push.

usage: openseespy_frame.py PROBLEM LIMIT SOLVER, with the largest residual force as criterion
"""

import numpy as np
import openseespy.opensees as ops
from frame import arguments

MOST_ITERATIONS = 30


def build(frame):
    ops.wipe()
    ops.model("basic", "-ndm", 3, "-ndf", 6)
    for number, x in enumerate(frame.nodes, start=1):
        ops.node(number, *map(float, x))
    # an axis that no element runs along
    ops.geomTransf("Corotational", 1, 0.0, 0.0, 1.0)
    ops.geomTransf("Corotational", 2, 1.0, 0.0, 0.0)
    young, shear = float(frame.young), float(frame.shear_modulus)
    for number, ((a, b), radius) in enumerate(zip(frame.elements, frame.radius, strict=True), start=1):
        area, second, torsion = frame.section_of(radius)
        along = frame.nodes[b] - frame.nodes[a]
        frame_number = 2 if abs(along[2]) > 0.9 * np.linalg.norm(along) else 1
        ends = int(a) + 1, int(b) + 1
        ops.element("elasticBeamColumn", number, *ends, area, young, shear, torsion, second, second, frame_number)
    first = len(frame.elements) + 1
    for number, ((a, b), gap) in enumerate(zip(frame.links, frame.gap, strict=True)):
        # force over change of length: none above -gap
        ops.uniaxialMaterial("ElasticPPGap", number + 1, float(frame.penalty), -1e30, -float(gap))
        ops.element("twoNodeLink", first + number, int(a) + 1, int(b) + 1, "-mat", number + 1, "-dir", 1)
    held = np.zeros((len(frame.nodes), 6), dtype=int)
    held[tuple(frame.held.T)] = 1
    for node in np.flatnonzero(held.any(axis=1)):
        ops.fix(int(node) + 1, *held[node].tolist())
    ops.timeSeries("Linear", 1)
    ops.pattern("Plain", 1, 1)
    for (node, dof), value in zip(frame.moved, frame.value, strict=True):
        ops.sp(int(node) + 1, int(dof) + 1, float(value))


def main():
    frame, clock, (solver,) = arguments()
    build(frame)
    ops.constraints("Transformation")
    ops.numberer("Plain")
    ops.system(solver)
    # the last 0: the largest entry, not the root of the sum of squares
    ops.test("NormUnbalance", float(frame.tolerance), MOST_ITERATIONS, 0, 0)
    ops.algorithm("Newton")
    ops.integrator("LoadControl", 1.0 / frame.increments)
    ops.analysis("Static")
    top = [int(node) + 1 for node, dof in frame.moved if dof == 2]

    def solve(_):
        converged = ops.analyze(1) == 0
        return ops.testIter(), converged

    def reaction():
        ops.reactions()
        return sum(ops.nodeReaction(node, 3) for node in top)

    clock.run(solve, reaction)


if __name__ == "__main__":
    main()
