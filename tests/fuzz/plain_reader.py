"""A second reader of decks, short because it believes every deck to be right: what litz accepts must mean the same here.

It gives the lines that `model_listing.f90` prints.
"""

import math
import re
import struct
import sys

ELEMENT_TYPES = {"B31": 1, "B31R": 1, "B31H": 1, "B33": 2, "B33H": 2}
SPOT_LAWS = {"PAPER": 1, "HERTZ": 2, "PLASTIC": 3, "FILM": 4, "CONSTANT": 5, "TABLE": 6}
AXES = {"LINEAR": 1, "HERMITE": 2}
SOLVERS = {"BLOCK": 1, "UMFPACK": 2, "SKYLINE": 3, "MUMPS": 4}
COUPLINGS = {"MONOLITHIC": 1, "UPDATED": 2, "FULL": 4}
KINDS = {"NODEPRINT": 1, "ELPRINT": 2, "CONTACTPRINT": 3, "ELECTRODEPRINT": 4, "ENERGYPRINT": 5}
LOADS = {"BOUNDARY": "boundary", "CLOAD": "load", "CECURRENT": "load", "CFLUX": "load", "TEMPERATURE": "given"}
#: The one degree of freedom of a keyword whose lines name none
DOFS = {"CECURRENT": 9, "CFLUX": 11, "TEMPERATURE": 11, "INITIALCONDITIONS": 11}
#: What a step solves for: motions and potentials, potentials and temperatures, all
PROCEDURES = ("STATIC", "COUPLEDTHERMAL-ELECTRICAL", "COUPLEDTEMPERATURE-DISPLACEMENT")
#: Loads on the length of elements: labels of *DLOAD, and *LORENTZ
FORCES = ("PX", "PY", "PZ", "P1", "P2", "GRAV", "LORENTZ")
#: Where the numbers of a keyword are: source before the step, source, sink and film, surroundings and emissivity
HEAT = {"DFLUX": (1, 2), "FILM": (2, 4), "RADIATE": (4, 6)}
#: Of the values on the length of an element, those that may follow an amplitude
FOLLOWS = {"DFLUX": {1: "AMPLITUDE"}, "FILM": {2: "AMPLITUDE", 3: "FILMAMPLITUDE"}, "RADIATE": {4: "AMPLITUDE"}}
CONTROLS = {
    "i_c": 16,
    "i_l": 10,
    "i_g": 6,
    "i_a": 8,
    "r_n": 1e-8,
    "c_n": 0.0,
    "d_f": 0.25,
    "d_b": 0.75,
    "d_d": 1.5,
    "cap": 0.6,
}
sys.set_int_max_str_digits(0)
BLANKS = " \t\r"


def squeezed(text):
    return text.translate({9: None, 32: None}).translate({code: code - 32 for code in range(97, 123)})


def capitals(text):
    return text.translate({code: code - 32 for code in range(97, 123)})


def fields(line):
    """A line split at its commas, those in quotes left alone, without blanks and quotes around each piece."""
    pieces = re.split(r',(?=(?:[^"]*"[^"]*")*[^"]*$)', line)
    pieces = [piece.strip(" \t") for piece in pieces]
    return [piece[1:-1] if len(piece) > 1 and piece[0] == piece[-1] == '"' else piece for piece in pieces]


def values(line):
    found = fields(line)
    while found and not found[-1]:
        found.pop()
    return found


def shape_of(word, given):
    """Contact radius, and A, I11, I22, J of a cross-section."""
    if word == "CIRC":
        (r,) = given
        return r, [math.pi * r**2, math.pi * r**4 / 4, math.pi * r**4 / 4, math.pi * r**4 / 2]
    if word == "PIPE":
        r, inner = given[0], given[0] - given[1]
        bending = math.pi * (r**4 - inner**4) / 4
        return 0.0, [math.pi * (r**2 - inner**2), bending, bending, 2 * bending]
    if word == "RECT":
        a, b = given
        short, long = sorted(given)
        series = sum(math.tanh(n * math.pi * long / 2 / short) / n**5 for n in range(1, 240, 2))
        torsion = long * short**3 / 3 * (1 - 192 * short / math.pi**5 / long * series)
        return 0.0, [a * b, a * b**3 / 12, b * a**3 / 12, torsion]
    if word in ("BOX", "I", "L"):
        return 0.0, walled_shape(word, given)
    return 0.0, [given[0], *principal(*given[1:4]), given[4]]


def walled_shape(word, given):
    """A, I11, I22, J of a cross-section of plates."""
    if word == "BOX" and not (
        math.isclose(given[2], given[4], rel_tol=1e-6) and math.isclose(given[3], given[5], rel_tol=1e-6)
    ):
        a, b, t1, t2, t3, t4 = given
        area, second = second_moments((0, 0, a, b, 1), ((t3 - t1) / 2, (t4 - t2) / 2, a - t1 - t3, b - t2 - t4, -1))
        width, height = a - (t1 + t3) / 2, b - (t2 + t4) / 2
        torsion = 4 * (width * height) ** 2 / (height / t1 + width / t2 + height / t3 + width / t4)
        torsion += (height * (t1**3 + t3**3) + width * (t2**3 + t4**3)) / 3
        return [area, *principal(*second), torsion]
    if word == "L":
        a, b, t1, t2 = given
        area, second = second_moments(((a - t2) / 2, 0, a, t1, 1), (0, b / 2, t2, b - t1, 1))
        return [area, *principal(*second), ((a - t2 / 2) * t1**3 + (b - t1 / 2) * t2**3) / 3]
    if word == "BOX":
        a, b, t1, t2 = given[:4]
        inner = a - 2 * t1, b - 2 * t2
        area, bending = a * b - inner[0] * inner[1], (a * b**3 - inner[0] * inner[1] ** 3) / 12
        around = 2 * (b - t2) / t1 + 2 * (a - t1) / t2
        return [area, bending, (b * a**3 - inner[1] * inner[0] ** 3) / 12, 4 * ((a - t1) * (b - t2)) ** 2 / around]
    if word == "I":
        _, h, b, _, flange, _, web = given
        clear = h - 2 * flange
        bending = (b * h**3 - (b - web) * clear**3) / 12
        across = (2 * flange * b**3 + clear * web**3) / 12
        return [2 * b * flange + clear * web, bending, across, (2 * b * flange**3 + (h - flange) * web**3) / 3]
    raise ValueError(word)


def second_moments(*plates):
    """Area, and I11, I12, I22 about the centroid, of rectangles: middle, sides, 1 or -1."""
    area = sum(sign * a * b for _, _, a, b, sign in plates)
    x0, y0 = (sum(plate[4] * plate[2] * plate[3] * plate[k] for plate in plates) / area for k in (0, 1))
    i11 = sum(sign * a * b * (b**2 / 12 + (y - y0) ** 2) for _, y, a, b, sign in plates)
    i12 = sum(sign * a * b * (x - x0) * (y - y0) for x, y, a, b, sign in plates)
    i22 = sum(sign * a * b * (a**2 / 12 + (x - x0) ** 2) for x, _, a, b, sign in plates)
    return area, (i11, i12, i22)


def principal(i11, i12, i22):
    """Second moments about the principal axes nearest to n1 and n2."""
    if i12 == 0:
        return [i11, i22]
    middle, radius = (i11 + i22) / 2, math.hypot((i11 - i22) / 2, i12)
    return [middle + radius, middle - radius] if i11 > i22 else [middle - radius, middle + radius]


def number(text):
    """Zero has no sign in litz."""
    return float(re.sub("[dD]", "e", text)) + 0.0


def cards(text):
    """Keyword, parameters and data lines, one card after another. The files that are included are empty ones."""
    lines = [line.strip(BLANKS) for line in text.removeprefix("\xef\xbb\xbf").split("\n")]
    lines = [line for line in lines if line and not line.startswith("**")]
    found = []
    i = 0
    while i < len(lines):
        line = lines[i]
        i += 1
        if not line.startswith("*"):
            found[-1][2].append(line)
            continue
        pieces = fields(line)
        while line.endswith(","):
            line = lines[i]
            i += 1
            pieces += fields(line)
        if squeezed(pieces[0]) == "*INCLUDE":
            continue
        parameters = {}
        for piece in filter(None, pieces[1:]):
            name, equals, value = piece.partition("=")
            value = value.strip(BLANKS)
            if len(value) > 1 and value[0] == value[-1] == '"':
                value = value[1:-1]
            parameters[squeezed(name.strip(BLANKS))] = value if equals else None
        found.append((squeezed(pieces[0][1:].strip(BLANKS)), parameters, []))
    return found


def show(numbers):
    """As the listing has them: whole numbers in digits, real ones by their bits."""
    return "".join(
        f" {value}" if isinstance(value, int) else f" {struct.pack('>d', value).hex().upper()}" for value in numbers
    )


def rounded(value):
    """Ten digits and an exponent of three: what both readers compute may differ in the last bit."""
    mantissa, _, exponent = f"{value:.9E}".partition("E")
    return f"{mantissa:>12}E{int(exponent):+04d}"


class PlainReader:
    def __init__(self, text):
        self.cards = cards(text)
        self.nodes, self.elements = {}, {}
        self.sets = {"NSET": {}, "ELSET": {}}
        self.names = {"MATERIAL": [], "AMPLITUDE": [], "SURFACEINTERACTION": []}
        self.amplitudes = {}
        self.lines = []

    def listing(self):
        self.read_mesh()
        self.read_sets()
        properties = [*self.materials(), *self.sections(), *self.read_amplitudes(), *self.interactions(), *self.pairs()]
        mesh = ["absolute zero" + show(self.constants())]
        mesh += [f"node {node}{show(x)}" for node, x in self.nodes.items()]
        mesh += [
            f"element {element}{show([*data])} {self.section_of.get(element, 0)}"
            for element, data in self.elements.items()
        ]
        for kind in ("NSET", "ELSET"):
            order = {member: i for i, member in enumerate(self.nodes if kind == "NSET" else self.elements)}
            for name, members in self.sets[kind].items():
                mesh.append(f"{kind.lower()} {name}{show(sorted(members, key=order.__getitem__))}")
        return mesh + properties + self.initial() + self.steps()

    def of(self, keyword):
        return [card for card in self.cards if card[0] == keyword]

    def constants(self):
        found = {}
        for _, parameters, _ in self.of("PHYSICALCONSTANTS"):
            found |= parameters
        return [number(found.get(name, "0")) for name in ("ABSOLUTEZERO", "STEFANBOLTZMANN")]

    def read_mesh(self):
        for _, parameters, data in self.of("NODE"):
            members = self.members("NSET", parameters.get("NSET"))
            for line in data:
                node, *x = values(line)
                self.nodes[int(node)] = [number(value) for value in x]
                members.add(int(node))
        for _, parameters, data in self.of("ELEMENT"):
            members = self.members("ELSET", parameters.get("ELSET"))
            for line in data:
                element, a, b = map(int, values(line))
                self.elements[element] = (ELEMENT_TYPES[squeezed(parameters["TYPE"])], a, b)
                members.add(element)

    def members(self, kind, name):
        return set() if name is None else self.sets[kind].setdefault(capitals(name), set())

    def read_sets(self):
        for kind, parameters, data in self.cards:
            if kind not in self.sets:
                continue
            known = self.nodes if kind == "NSET" else self.elements
            members = self.members(kind, parameters[kind])
            if kind == "NSET" and "ELSET" in parameters:
                elements = self.sets["ELSET"][capitals(parameters["ELSET"])]
                members |= {node for element in elements for node in self.elements[element][1:]}
            for line in data:
                if "GENERATE" in parameters:
                    first, last, step = [*map(int, values(line)), 1][:3]
                    members |= {member for member in known if member in range(first, last + 1, step)}
                else:
                    for item in filter(None, values(line)):
                        members |= self.items(kind, item)

    def items(self, kind, item):
        if re.fullmatch("[+-]?[0-9]+", item):
            known = self.nodes if kind == "NSET" else self.elements
            if int(item) in known or capitals(item) not in self.sets[kind]:
                return {int(item)}
        return set(self.sets[kind][capitals(item)])

    def materials(self):
        found = []
        for keyword, parameters, data in self.cards:
            if keyword == "MATERIAL":
                found.append([capitals(parameters["NAME"]), 0.0, 0.0, 0.0, 1.0, [], []])
            elif keyword == "ELASTIC":
                found[-1][1:3] = map(number, values(data[0])[:2])
            elif keyword == "ELECTRICALCONDUCTIVITY":
                table = self.read_property(data)
                found[-1][3] = table[len(table) // 2]
                found[-1][5] = table[: len(table) // 2] + [1 / value for value in table[len(table) // 2 :]]
            elif keyword == "CONDUCTIVITY":
                found[-1][6] = self.read_property(data)
            elif keyword == "JOULEHEATFRACTION":
                found[-1][4] = number(values(data[0])[0])
        self.names["MATERIAL"] = [name for name, *_ in found]
        return [f"material {name}{show(data[:4])} table{show(data[4])} table{show(data[5])}" for name, *data in found]

    @staticmethod
    def read_property(data):
        """Temperatures, then values."""
        pairs = [[*map(number, filter(None, values(line))), 0.0][:2] for line in data]
        return [t for _, t in pairs] + [value for value, _ in pairs]

    def sections(self):
        found = []
        self.section_of = {}
        for n, (_, parameters, data) in enumerate(self.of("BEAMSECTION"), 1):
            name = capitals(parameters["ELSET"])
            self.section_of |= dict.fromkeys(self.sets["ELSET"][name], n)
            given = [number(value) for value in values(data[0])]
            contact_radius, shape = shape_of(squeezed(parameters["SECTION"]), given)
            beside = any(number(parameters.get(offset, "0")) != 0 for offset in ("OFFSET1", "OFFSET2"))
            contact_radius *= not beside
            if "CONTACTRADIUS" in parameters:
                contact_radius = number(parameters["CONTACTRADIUS"])
            n1 = [number(value) for value in values(data[1])] if len(data) > 1 else [0.0, 0.0, 0.0]
            if len(data) > 1 and not n1:
                n1 = [0.0, 0.0, -1.0]
            if len(data) == 1 and beside:
                n1 = [0.0, 0.0, -1.0]
            if len(data) == 1 and squeezed(parameters["SECTION"]) in ("RECT", "BOX", "I", "L"):
                n1 = [0.0, 0.0, -1.0]
            material = self.names["MATERIAL"].index(capitals(parameters["MATERIAL"])) + 1
            current = int(squeezed(parameters.get("CONDUCTION", "")) == "CURRENTLENGTH")
            found.append(f"section {name}{show([material, current, contact_radius, *n1])} ")
            found[-1] += " ".join(map(rounded, shape))
        return found

    def read_amplitudes(self):
        found = []
        for _, parameters, data in self.of("AMPLITUDE"):
            name = capitals(parameters["NAME"])
            given = [number(value) for line in data for value in values(line)]
            total = squeezed(parameters.get("TIME", "")) == "TOTALTIME"
            self.names["AMPLITUDE"].append(name)
            self.amplitudes[name] = (total, given[0::2], given[1::2])
            found.append(f"amplitude {name} {int(total)}{show(given[0::2])}{show(given[1::2])}")
        return found

    def interactions(self):
        found = []
        for keyword, parameters, data in self.cards:
            given = [number(value) for line in data for value in values(line)] if keyword in (
                "SURFACEBEHAVIOR", "FRICTION", "GAPELECTRICALCONDUCTANCE") else []  # fmt: skip
            if keyword == "SURFACEINTERACTION":
                self.names[keyword].append(capitals(parameters["NAME"]))
                axis = AXES[squeezed(parameters.get("AXIS", "HERMITE"))]
                found.append([2, 0, axis, 0, 1, 1, 0, 0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
            elif keyword == "SURFACEBEHAVIOR":
                linear = squeezed(parameters["PRESSURE-OVERCLOSURE"]) == "LINEAR"
                found[-1][0] = 1 if linear else 2
                found[-1][3] = int(squeezed(parameters.get("PENETRATION", "")) == "UNLIMITED")
                found[-1][8] = given[0] if linear else 0.0
                # wires that yield have a law of their own, which decks name HERTZ
                found[-1][12], found[-1][13] = (number(parameters.get(name, "0.")) for name in ("YIELD", "HARDNESS"))
                if found[-1][12] > 0:
                    found[-1][0] = 0
            elif keyword == "FRICTION":
                found[-1][10] = given[0]
                for law, parameter in ((2, "ELASTICSLIP"), (3, "STICKSTIFFNESS")):
                    if parameter in parameters:
                        found[-1][5], found[-1][11] = law, number(parameters[parameter])
            elif keyword == "GAPELECTRICALCONDUCTANCE":
                law = squeezed(parameters["LAW"])
                found[-1][1] = SPOT_LAWS[law]
                found[-1][4] = int(squeezed(parameters.get("VOLTAGE", "")) != "LINEAR")
                found[-1][6] = int(squeezed(parameters.get("SPOT", "")) == "LARGESTFORCE")
                found[-1][7] = int(squeezed(parameters.get("MUTUALRESISTANCE", "")) == "YES")
                if law == "TABLE":
                    found[-1] += given[0::2] + given[1::2]
                elif given:
                    found[-1][9] = given[0]
        return [
            f"interaction {name}{show(data)}"
            for name, data in zip(self.names["SURFACEINTERACTION"], found, strict=True)
        ]

    def pairs(self):
        found = []
        names = list(self.sets["ELSET"])
        surfaces = {capitals(parameters["NAME"]) for _, parameters, _ in self.of("RIGIDSURFACE")}
        for _, parameters, data in self.of("CONTACTPAIR"):
            # pairs with rigid surfaces are no pairs of wires
            if any(capitals(name) in surfaces for name in values(data[0])):
                continue
            sets = [names.index(capitals(name)) + 1 for name in values(data[0])]
            interaction = self.names["SURFACEINTERACTION"].index(capitals(parameters["INTERACTION"])) + 1
            found.append(f"pair{show([interaction, sets[0], sets[-1], int('INTERFERENCEFIT' in parameters)])}")
        return found

    def initial(self):
        found = {}
        for keyword, parameters, data in self.of("INITIALCONDITIONS"):
            self.read_values(keyword, parameters, data, found, set())
        return [f"initial{show([*key, *value])}" for key, value in found.items()]

    def steps(self):
        lines, in_force, requests = [], {kind: {} for kind in LOADS}, []
        earlier = {"frequency": 1, "solver": 0, "coupling": 0, "controls": CONTROLS, "total": 0.0}
        step, fresh, heat, forces = None, {}, {}, {}
        for keyword, parameters, data in self.cards:
            if keyword == "STEP":
                heat = self.keep_heat(heat, earlier["total"])
                forces = self.keep_forces(forces, earlier["total"])
                step = {**earlier, "controls": dict(earlier["controls"]), "inc": int(parameters.get("INC", 100))}
                fresh, asked = {kind: set() for kind in LOADS}, set()
                for kind in LOADS:
                    self.freeze(in_force[kind], earlier["total"])
            elif keyword in (*LOADS, *HEAT, "DLOAD", "LORENTZ"):
                read, given = {
                    **{name: (self.read_values, of_nodes) for name, of_nodes in in_force.items()},
                    **dict.fromkeys(HEAT, (self.read_heat, heat)),
                }.get(keyword, (self.read_forces, forces))
                read(keyword, parameters, data, given, fresh.setdefault(keyword, set()))
            elif keyword in PROCEDURES:
                step["heat"] = PROCEDURES.index(keyword)
                self.read_times(parameters, data, step)
            elif keyword == "CONTROLS":
                self.read_controls(parameters, data, step["controls"])
            elif keyword == "SOLVER":
                step["solver"] = SOLVERS[squeezed(parameters["NAME"])]
                step["coupling"] = COUPLINGS.get(squeezed(parameters.get("COUPLING", "")), step["coupling"])
            elif keyword in ("NODEFILE", "ELFILE"):
                step["frequency"] = int(parameters.get("FREQUENCY", step["frequency"]))
            elif keyword in KINDS:
                new = self.requests(keyword, parameters, data)
                if new and keyword not in asked:
                    asked.add(keyword)
                    requests = [request for request in requests if request[0] != KINDS[keyword]]
                requests = requests + new
            elif keyword == "ENDSTEP":
                lines.append("step" + show([step[key] for key in ("inc", "frequency", "solver", "coupling", "direct", "heat")])
                             + show([step[key] for key in ("first", "total", "largest")]))  # fmt: skip
                lines.append("controls" + show(step["controls"].values()))
                # what is prescribed of temperatures waits in a step that does not solve for them
                waits = step["heat"] == 0 and any(self.of(keyword) for keyword in PROCEDURES[1:])
                for kind, word in LOADS.items():
                    lines += [f"{word}{show([*key, *value])}" for key, value in in_force[kind].items()
                              if not (waits and word != "given" and key[1] == 11)]  # fmt: skip
                lines += self.show_heat(heat)
                lines += [
                    f"force{show([*key, now[0], before[0]])} " + " ".join(map(rounded, now[1] + before[1]))
                    for key, (now, before) in forces.items()
                ]
                lines += [
                    "".join([f"request{show(request[:4])}", *(f" {name:8}" for name in request[4])])
                    for request in requests
                ]
                earlier = step
        return lines

    def read_forces(self, keyword, parameters, data, forces, fresh):
        if squeezed(parameters.get("OP") or "") == "NEW" and not fresh:
            for key, (_, before) in forces.items():
                if (FORCES[key[1] - 1] == "LORENTZ") == (keyword == "LORENTZ"):
                    forces[key] = ((0, [0.0] * 12), before)
        fresh.add(None)
        amplitude = self.amplitude(parameters.get("AMPLITUDE"))
        order = {element: i for i, element in enumerate(self.elements)}
        for line in data:
            item, *rest = values(line)
            label = keyword if keyword == "LORENTZ" else squeezed(rest.pop(0))
            given = [number(text) if text else 0.0 for text in rest]
            if label == "GRAV":
                largest = max(map(abs, given[1:4]))
                direction = [x / largest for x in given[1:4]]
                length = math.hypot(*direction)
                given = [given[0] * x / length for x in direction]
            given += [0.0] * (12 - len(given))
            for element in sorted(self.items("ELSET", item) if item else order, key=order.__getitem__):
                key = (element, FORCES.index(label) + 1)
                now, before = forces.get(key, ((0, [0.0] * 12), (0, [0.0] * 12)))
                added = [a + b for a, b in zip(now[1], given, strict=True)] if key in fresh else given
                forces[key] = ((amplitude, added), before)
                fresh.add(key)

    def keep_forces(self, forces, time):
        """What the next step has, without what has come to nothing."""
        kept = {}
        for key, (now, _) in forces.items():
            parts = {i: (now[0], value) for i, value in enumerate(now[1])}
            self.freeze(parts, time)
            amplitude, numbers = parts[0][0], [value for _, value in parts.values()]
            if any(numbers):
                kept[key] = ((amplitude, numbers), (amplitude, numbers))
        return kept

    def read_heat(self, keyword, parameters, data, heat, fresh):
        first, last = HEAT[keyword]
        if squeezed(parameters.get("OP") or "") == "NEW" and not fresh:
            for given in heat.values():
                given[first:last] = [(0, 0.0)] * (last - first)
        fresh.add(None)
        follows = {place: self.amplitude(parameters.get(name)) for place, name in FOLLOWS[keyword].items()}
        for line in data:
            item, _, *numbers = values(line)
            for element in self.items("ELSET", item):
                given = heat.setdefault(element, [(0, 0.0)] * 6)
                old = given[1][1] if element in fresh else 0.0
                for place, text in enumerate(numbers, first):
                    given[place] = (follows.get(place, 0), number(text))
                if keyword == "DFLUX":
                    given[1] = (given[1][0], given[1][1] + old)
                    fresh.add(element)

    def keep_heat(self, heat, time):
        """What the next step has; sources also as what they were before it."""
        kept = {}
        for element, given in heat.items():
            values = dict(enumerate(given))
            self.freeze(values, time)
            kept[element] = [values[1], *list(values.values())[1:]]
        return kept

    def show_heat(self, heat):
        lines = []
        for element in self.elements:
            given = heat.get(element, [(0, 0.0)] * 6)
            # without a coefficient there are no surroundings
            for i in (2, 4):
                if not given[i + 1][1]:
                    given = [*given[:i], (0, 0.0), (0, 0.0), *given[i + 2 :]]
            if any(value for _, value in given):
                follow = [given[i][0] for i in (1, 0, 2, 3, 4)]
                lines.append(f"heat {element}{show([value for _, value in given])}{show(follow)}")
        return lines

    def amplitude(self, name):
        return self.names["AMPLITUDE"].index(capitals(name)) + 1 if name else 0

    def read_times(self, parameters, data, step):
        given = [number(value) if value else None for value in values(data[0])] if data else []
        given += [None] * (4 - len(given))
        step["total"] = 1.0 if given[1] is None else given[1]
        step["first"] = step["total"] if given[0] is None else given[0]
        is_transient = step["heat"] > 0 and "STEADYSTATE" not in parameters
        step["direct"] = int("DIRECT" in parameters or (is_transient and "DELTMX" not in parameters))
        step["largest"] = step["total"] if given[3] is None else given[3]
        step["largest"] = step["first"] if step["direct"] else step["largest"]

    def freeze(self, in_force, time):
        """What followed an amplitude in step time keeps the value of the step's end."""
        for key, (amplitude, value) in in_force.items():
            if amplitude == 0:
                continue
            total, t, a = self.amplitudes[self.names["AMPLITUDE"][amplitude - 1]]
            if total:
                continue
            after = sum(point <= time for point in t)
            if after in (0, len(t)):
                factor = a[max(0, after - 1)]
            else:
                factor = a[after - 1] + (a[after] - a[after - 1]) * (time - t[after - 1]) / (t[after] - t[after - 1])
            in_force[key] = (0, value * factor)

    def read_values(self, keyword, parameters, data, in_force, fresh):
        if squeezed(parameters.get("OP") or "") == "NEW" and not fresh:
            in_force.clear()
        fresh.add(None)
        amplitude = self.amplitude(parameters.get("AMPLITUDE"))
        order = {node: i for i, node in enumerate(self.nodes)}
        for line in data:
            item, *rest = values(line)
            rest += [""] * (3 - len(rest))
            if keyword == "BOUNDARY":
                names = {"ENCASTRE": (1, 6), "PINNED": (1, 3)}
                first, last = names.get(capitals(rest[0])) or (int(rest[0]), int(rest[1] or rest[0]))
                value = number(rest[2]) if rest[2] else 0.0
            else:
                first = last = DOFS.get(keyword) or int(rest[0])
                value = number(rest[0 if keyword in ("TEMPERATURE", "INITIALCONDITIONS") else 1])
            for node in sorted(self.items("NSET", item), key=order.__getitem__):
                for dof in range(first, last + 1):
                    if keyword in ("CLOAD", "CECURRENT", "CFLUX") and (node, dof) in fresh:
                        in_force[node, dof] = (amplitude, in_force[node, dof][1] + value)
                    elif (node, dof) not in fresh:
                        in_force[node, dof] = (amplitude, value)
                    fresh.add((node, dof))

    def read_controls(self, parameters, data, controls):
        kind = squeezed(parameters["PARAMETERS"])
        names = {"FIELD": [["r_n", "c_n"]], "ROTATION": [["cap"]], "STABILIZE": [],
                 "TIMEINCREMENTATION": [["", "", "", "i_c", "i_l", "i_g", "", "i_a"],
                                        ["d_f", "", "d_b", "", "", "", "d_d"]]}[kind]  # fmt: skip
        for row, line in zip(names, data, strict=False):
            for name, value in zip(row, values(line), strict=False):
                if name and value:
                    controls[name] = int(value) if name.startswith("i") else number(value)

    def requests(self, keyword, parameters, data):
        kind = KINDS[keyword]
        if keyword in ("CONTACTPRINT", "ENERGYPRINT"):
            return [(kind, 0, 0, 0, [])]
        if keyword == "ELECTRODEPRINT":
            names = list(self.sets["NSET"])
            return [(kind, *(names.index(capitals(name)) + 1 for name in values(line)), 0, []) for line in data]
        of = "NSET" if keyword == "NODEPRINT" else "ELSET"
        quantities = [squeezed(word) for line in data for word in values(line) if word]
        set_index = list(self.sets[of]).index(capitals(parameters[of])) + 1
        totals = squeezed(parameters.get("TOTALS", "NO"))
        wanted = {"NO": [0], "YES": [0, 1], "ONLY": [1]}[totals]
        return [(kind, set_index, 0, total, quantities) for total in wanted if quantities]


def listing(deck):
    """The lines of the model that a right deck, given as bytes, describes."""
    return PlainReader(deck.decode("latin-1")).listing()
