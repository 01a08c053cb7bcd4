"""45-degree bend: a curved cantilever in the plane, loaded out of it.

Source: K. J. Bathe, S. Bolourchi, Int. J. Numer. Methods Eng. 14 (1979) 961-986; J. C. Simo, L. Vu-Quoc, Comput.
Methods Appl. Mech. Eng. 58 (1986) 79-116, section 7.5. Radius 100, unit square section, E = 1e7, G = 5e6, tip force P
= 300 and 600 perpendicular to the plane. The published tips differ by 0.8 %, because some take the polar second
moment 1/6 for the torsion constant, some Saint-Venant's 0.140577, all with 8 elements; the reference values here are
those of a geometrically exact rod by shooting (references/rod.py) for each. B33 is compared with a rod that does not
shear.
"""

import numpy as np

from verification import figures
from verification.claims import read_claims
from verification.deck_text import arc, chain, heading, join, step
from verification.numerics import extrapolate

LOADS = (300, 600)
MESHES = (8, 16, 32, 64)
TORSION = {"polar": 1.0 / 6.0, "saint_venant": 0.140577}


def deck(element, n, torsion, steps, loads=LOADS):
    """The bend with n elements; each load is reached in one *STEP of a number of equal increments."""
    return join(
        heading(
            "45-degree bend under a force out of its plane",
            f"Model   radius 100, unit square section, E = 1e7, nu = 0, torsion constant {torsion:.6g}: {n} {element}",
            "Source  Bathe and Bolourchi (1979); Simo and Vu-Quoc (1986), section 7.5",
            "Expect  tip at P = 600: (47.15, 15.68, 53.47) with the torsion constant 1/6,",
            "        (46.89, 15.56, 53.61) with 0.140577",
        ),
        chain(arc(100.0, np.pi / 4, n), element, "BEND"),
        "*MATERIAL, NAME=M\n*ELASTIC\n 1.e7, 0.",
        "*BEAM SECTION, ELSET=BEND, MATERIAL=M, SECTION=GENERAL",
        f" 1., {1 / 12:.16g}, 0., {1 / 12:.16g}, {torsion:.16g}",
        "*BOUNDARY\n 1, ENCASTRE",
        *(step(f"*CLOAD\n {n + 1}, 3, {load}", increments=steps) for load in loads),
    )


def tips(results, loads=LOADS):
    """Position of the tip at the end of each step, (loads, 3)."""
    last = [int(np.flatnonzero(results.steps == number + 1)[-1]) for number in range(len(loads))]
    return np.array([results.positions(increment)[-1] for increment in last])


def measure(workspace):
    values, figure = {}, {}
    exact = {claim.id: np.array(claim.reference) for claim in read_claims() if claim.script == "bend"}
    for element in ("B31", "B33"):
        for name, torsion in TORSION.items():
            case = f"bend.{element}.{name}"
            meshes = (8,) if workspace.quick else MESHES
            found = {n: tips(workspace.run(f"{element}_{name}_{n}", deck(element, n, torsion, 1))) for n in meshes}
            values[f"{case}.eight_elements"] = found[8].ravel().tolist()
            if workspace.quick:
                continue
            limit = extrapolate(found[32], found[64], order=2)
            values[f"{case}.limit"] = limit.ravel().tolist()
            figure[f"{element} {name}"] = [
                float(np.abs(found[n].ravel() - exact[f"{case}.limit"]).max()) for n in MESHES
            ]
            values[f"{case}.six_steps"] = six_steps(workspace, element, name).ravel().tolist()
            if name == "polar":
                values[f"bend.{element}.published"] = found[8][1].tolist()
                errors = figure[f"{element} {name}"]
                values[f"bend.{element}.order"] = float(np.log2(errors[1] / errors[2]))
    if not workspace.quick:
        figure["shape"] = workspace.run("shape", deck("B33", 16, TORSION["polar"], 6)).path
    return values | {"figure": figure}


def six_steps(workspace, element, name):
    """Tips after each of six equal increments to the larger load, from 32 and 64 elements, extrapolated; (6, 3)."""
    last = LOADS[-1:]
    runs = {n: workspace.run(f"{element}_{name}_{n}_six", deck(element, n, TORSION[name], 6, last)) for n in (32, 64)}
    paths = {n: np.array([run.positions(i)[-1] for i in range(len(run.times))][-6:]) for n, run in runs.items()}
    return extrapolate(paths[32], paths[64], order=2)


def draw(values, path):
    import litz

    figure = dict(values["figure"])
    results = litz.Results(figure.pop("shape"))
    with figures.panels(path) as (shape, error):
        for increment in range(-1, len(results.times), 3):
            x = results.nodes if increment < 0 else results.positions(increment)
            shape.plot(x[:, 0] - 0.4 * x[:, 1], x[:, 2] - 0.3 * x[:, 1], "o-", color="#c4451c", markersize=2)
        shape.set(xlabel="oblique view", aspect="equal", title="P = 0 to 600, 16 B33")
        for name, errors in figure.items():
            style = figures.STYLES[name.split()[0]] | ({"linestyle": ":"} if "venant" in name else {})
            error.loglog(MESHES, errors, label=name.replace("_", "-"), **style)
        figures.order_line(error, MESHES, 2, max(errors[0] for errors in figure.values()))
        error.set(xlabel="elements", ylabel="distance of the tip from that of the shooting", ylim=(1e-6, None))
        error.legend()


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["bend"]))
