"""Kratos: CrBeamElement3D2N, corotational, without shear; sparse LU, which is the direct solver of its package.

usage: kratos_frame.py PROBLEM LIMIT
"""

import KratosMultiphysics as KM
import KratosMultiphysics.LinearSolversApplication
import KratosMultiphysics.StructuralMechanicsApplication as SMA
from frame import arguments
from KratosMultiphysics import python_linear_solver_factory

UNKNOWNS = [
    *((getattr(KM, f"DISPLACEMENT_{axis}"), getattr(KM, f"REACTION_{axis}")) for axis in "XYZ"),
    *((getattr(KM, f"ROTATION_{axis}"), getattr(KM, f"REACTION_MOMENT_{axis}")) for axis in "XYZ"),
]
MOST_ITERATIONS = 60


def build(frame):
    model = KM.Model()
    part = model.CreateModelPart("frame")
    part.SetBufferSize(2)
    part.ProcessInfo[KM.DOMAIN_SIZE] = 3
    for variable in (KM.DISPLACEMENT, KM.ROTATION, KM.REACTION, KM.REACTION_MOMENT, KM.VOLUME_ACCELERATION):
        part.AddNodalSolutionStepVariable(variable)
    for number, x in enumerate(frame.nodes, start=1):
        part.CreateNewNode(number, *map(float, x))
    area, second, torsion = frame.section_of(float(frame.radius[0]))
    properties = part.CreateNewProperties(1)
    for variable, value in (
        (KM.YOUNG_MODULUS, float(frame.young)),
        (KM.POISSON_RATIO, float(frame.poisson)),
        (KM.DENSITY, 1.0),
        (SMA.CROSS_AREA, area),
        (SMA.TORSIONAL_INERTIA, torsion),
        (SMA.I22, second),
        (SMA.I33, second),
        (KM.CONSTITUTIVE_LAW, KM.KratosGlobals.GetConstitutiveLaw("BeamConstitutiveLaw").Clone()),
    ):
        properties.SetValue(variable, value)
    for number, (a, b) in enumerate(frame.elements, start=1):
        part.CreateNewElement("CrBeamElement3D2N", number, [int(a) + 1, int(b) + 1], properties)
    for unknown, reaction in UNKNOWNS:
        KM.VariableUtils().AddDof(unknown, reaction, part)
    for node, dof in (*frame.held, *frame.moved):
        part.Nodes[int(node) + 1].Fix(UNKNOWNS[dof][0])
    return model, part


def main():
    frame, clock, _ = arguments()
    _model, part = build(frame)
    solver = python_linear_solver_factory.ConstructSolver(
        KM.Parameters('{"solver_type": "LinearSolversApplication.sparse_lu"}')
    )
    strategy = KM.ResidualBasedNewtonRaphsonStrategy(
        part,
        KM.ResidualBasedIncrementalUpdateStaticScheme(),
        KM.ResidualCriteria(1e-8, float(frame.tolerance)),
        KM.ResidualBasedEliminationBuilderAndSolver(solver),
        MOST_ITERATIONS,
        True,
        False,
        True,
    )
    strategy.SetEchoLevel(0)
    strategy.Initialize()
    moved = [
        (part.Nodes[int(node) + 1], UNKNOWNS[dof][0], float(value))
        for (node, dof), value in zip(frame.moved, frame.value, strict=True)
    ]

    def solve(i):
        part.ProcessInfo[KM.STEP] = i + 1
        part.CloneTimeStep(i + 1.0)
        for node, unknown, value in moved:
            node.SetSolutionStepValue(unknown, value * (i + 1) / frame.increments)
        strategy.InitializeSolutionStep()
        strategy.Predict()
        converged = strategy.SolveSolutionStep()
        strategy.FinalizeSolutionStep()
        return part.ProcessInfo[KM.NL_ITERATION_NUMBER], converged

    def reaction():
        return sum(node.GetSolutionStepValue(KM.REACTION_Z) for node, unknown, _ in moved if unknown == UNKNOWNS[2][0])

    clock.run(solve, reaction)


if __name__ == "__main__":
    main()
