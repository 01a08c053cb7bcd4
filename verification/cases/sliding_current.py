"""A thread pushed far aside by a crossing one carries a current: resistance over a large deflection.

Source: force and place of the contact: planar extensible elastica from the clamp to the contact, contact force normal
to the deformed axis, integrated to ten digits, for the data of the input deck
beam3eb_static_contact_penalty_newgap_twocrossedbeams.dat of the 4C project. Resistance: Ohm's law along the thread
from the clamp to the contact, at arc length s_c, and from the contact to both ends of the pushing thread, and a
plastic spot after R. Holm, Electric Contacts, F = pi a^2 H, R_c = rho/(2 a): rho s_c/A + R_c(F) + rho/(4 A). Deck:
inputs/10_pushed_cantilever, made to conduct. The contact slides over the edge of an element to s_c = 0.4046.
"""

import numpy as np

from verification import figures
from verification.wire_decks import INPUTS

#: Time, force and arc length of the contact
TIMES = (0.80, 0.85, 0.90, 0.95, 1.00)
FORCES = (9.0197988845e-9, 1.1873695217e-8, 1.4690689441e-8, 1.7462400071e-8, 2.0180832726e-8)
PLACES = (0.4008761079, 0.4015329878, 0.4023714308, 0.4033905646, 0.4045893377)
AREA, RESISTIVITY, HARDNESS = 1e-8, 1e-6, 1e7


def deck():
    """inputs/10_pushed_cantilever with a conductivity, a plastic spot, 1 V at the clamp, 0 V at the pushing thread."""
    text = (INPUTS / "10_pushed_cantilever.inp").read_text(encoding="utf-8")
    for card, more in {
        " 1.e9, 0.\n": f"*ELECTRICAL CONDUCTIVITY\n {1 / RESISTIVITY:.16g}\n",
        " 1.e-5\n": f"*GAP ELECTRICAL CONDUCTANCE, LAW=PLASTIC\n {HARDNESS:.16g}\n",
        " PUSHER_ENDS, 2, 2, -0.155\n": " 1, 9, 9, 1.\n PUSHER_ENDS, 9, 9, 0.\n*ELECTRODE PRINT\n CLAMP, PUSHER_ENDS\n",
        "*NSET, NSET=TIP\n 11\n": "*NSET, NSET=CLAMP\n 1\n",
    }.items():
        if text.count(card) != 1:
            raise ValueError(f"inputs/10_pushed_cantilever.inp no longer has the line {card!r} once")
        text = text.replace(card, card + more)
    return text


def parts(force, place):
    """Resistances of the thread up to the contact, of the spot, of the pushing thread."""
    spot = RESISTIVITY / 2 * np.sqrt(np.pi * HARDNESS / np.asarray(force))
    return RESISTIVITY * np.asarray(place) / AREA, spot, RESISTIVITY / (4 * AREA)


def measure(workspace):
    results = workspace.run("pushed_thread", deck())
    last = [int(np.argmin(np.abs(results.times - time))) for time in TIMES]
    resistance = np.asarray(results.history["resistance CLAMP to PUSHER_ENDS"])
    at = [int(np.argmin(np.abs(np.asarray(results.history["time"]) - time))) for time in TIMES]
    contacts = [results.contacts_at(increment) for increment in last]
    spot = [float(contact["resistance"][0]) for contact in contacts]
    thread = resistance[at] - spot - parts(1.0, 0.0)[2]
    return {
        "sliding_current.spot": spot,
        "sliding_current.thread": thread.tolist(),
        "sliding_current.total": resistance[at].tolist(),
        "figure": (np.asarray(results.history["time"]), resistance),
    }


def draw(values, path):
    time, resistance = values["figure"]
    with figures.panels(path) as (total, thread):
        shown = np.isfinite(resistance)
        total.plot(time[shown], resistance[shown], ".-", color="#c4451c", label="litz")
        total.plot(
            TIMES, sum(parts(FORCES, PLACES)), "o", fillstyle="none", label="elastica, Ohm, Holm", **figures.REFERENCE
        )
        total.set(xlabel="time", ylabel="resistance [ohm]")
        total.legend()
        thread.plot(
            TIMES, values["sliding_current.thread"], "s", color="#c4451c", label="litz, thread up to the contact"
        )
        thread.plot(TIMES, parts(FORCES, PLACES)[0], label=r"$\rho s_c/A$, elastica", **figures.REFERENCE)
        thread.axhline(RESISTIVITY * 0.4 / AREA, linestyle=":", **figures.REFERENCE)
        thread.annotate("without sliding", (0.8, RESISTIVITY * 0.40005 / AREA), fontsize=8)
        thread.set(xlabel="time", ylabel="resistance [ohm]")
        thread.legend()


if __name__ == "__main__":
    from verification.run import main

    raise SystemExit(main(["sliding_current"]))
