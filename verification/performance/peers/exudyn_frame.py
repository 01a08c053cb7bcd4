"""Exudyn: geometrically exact beams with shear; ends of struts, whose frames differ, are joined by constraints.

usage: exudyn_frame.py PROBLEM LIMIT

Its static solver takes all increments in one call, so that a run that comes to the limit is ended from outside.
"""

import warnings

import exudyn
import numpy as np
from exudyn.itemInterface import (
    GenericJoint,
    MarkerBodyRigid,
    MarkerNodeRigid,
    NodeRigidBodyEP,
    ObjectBeamGeometricallyExact,
    ObjectGround,
)
from exudyn.rigidBodyUtilities import RotationMatrix2EulerParameters
from frame import arguments

SHEAR_FACTOR = 0.9
MOST_ITERATIONS = 60


def triad(along):
    """Rotation whose first axis is along a strut."""
    t = along / np.linalg.norm(along)
    helper = np.eye(3)[np.argmin(abs(t))]
    n = np.cross(helper, t)
    n /= np.linalg.norm(n)
    return np.stack([t, n, np.cross(t, n)], axis=1)


def build(frame):
    """System, and the joints that move along z."""
    system = exudyn.SystemContainer().AddSystem()
    ground = system.AddObject(ObjectGround())
    area, second, torsion = frame.section_of(float(frame.radius[0]))
    shear = SHEAR_FACTOR * frame.shear_modulus * area
    section = exudyn.BeamSection()
    section.stiffnessMatrix = np.diag(
        [frame.young * area, shear, shear, frame.shear_modulus * torsion, frame.young * second, frame.young * second]
    )
    section.massPerLength = area
    section.inertia = np.diag([2 * second, second, second])
    own, at, turn = {}, {}, {}
    for (a, b), wire in zip(frame.elements, frame.wire, strict=True):
        rotation = triad(frame.nodes[b] - frame.nodes[a])
        ends = []
        for node in (int(a), int(b)):
            if (node, wire) not in own:
                coordinates = [*frame.nodes[node], *RotationMatrix2EulerParameters(rotation)]
                own[node, wire] = system.AddNode(NodeRigidBodyEP(referenceCoordinates=coordinates))
                turn[own[node, wire]] = rotation
                at.setdefault(node, []).append(own[node, wire])
            ends.append(own[node, wire])
        length = float(np.linalg.norm(frame.nodes[b] - frame.nodes[a]))
        system.AddObject(ObjectBeamGeometricallyExact(nodeNumbers=ends, length=length, sectionData=section))

    def joint(first_marker, first_turn, node, **more):
        return system.AddObject(
            GenericJoint(
                markerNumbers=[first_marker, system.AddMarker(MarkerNodeRigid(nodeNumber=node))],
                rotationMarker0=first_turn.tolist(),
                rotationMarker1=turn[node].T.tolist(),
                **more,
            )
        )

    for nodes in at.values():
        marker = system.AddMarker(MarkerNodeRigid(nodeNumber=nodes[0])) if len(nodes) > 1 else None
        for node in nodes[1:]:
            joint(marker, turn[nodes[0]].T, node)
    lift = {int(node): float(value) for (node, _), value in zip(frame.moved, frame.value, strict=True)}
    moving = []
    for node in np.unique(frame.held[:, 0]):
        place = system.AddMarker(MarkerBodyRigid(bodyNumber=ground, localPosition=frame.nodes[node].tolist()))
        if node not in lift:
            joint(place, np.eye(3), at[node][0])
            continue

        def offset(mbs, t, item, parameters, final=lift[int(node)]):
            return [0.0, 0.0, final * t, 0.0, 0.0, 0.0]

        moving.append(
            joint(place, np.eye(3), at[node][0], offsetUserFunction=offset, offsetUserFunctionParameters=[0.0] * 6)
        )
    system.Assemble()
    return system, moving


def main():
    warnings.simplefilter("ignore")
    frame, clock, _ = arguments()
    system, moving = build(frame)
    settings = exudyn.SimulationSettings()
    settings.linearSolver.solverType = exudyn.LinearSolverType.EigenSparse
    static = settings.staticSolver
    static.numberOfLoadSteps = frame.increments
    static.newton.relativeTolerance = 1e-8
    static.newton.absoluteTolerance = float(frame.tolerance)
    static.newton.maxIterations = MOST_ITERATIONS
    static.verboseMode = 0
    settings.solutionSettings.writeSolutionToFile = False
    solver = exudyn.MainSolverStatic()
    frame.increments, increments = 1, frame.increments

    def solve(_):
        converged = solver.SolveSystem(system, settings)
        return solver.it.newtonStepsCount, converged

    def reaction():
        force = exudyn.OutputVariableType.ForceLocal
        return sum(float(system.GetObjectOutput(joint, force)[2]) for joint in moving)

    clock.run(solve, reaction, increments=increments)


if __name__ == "__main__":
    main()
