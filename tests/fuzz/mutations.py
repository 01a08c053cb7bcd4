"""Decks changed at random: by bytes, by words, by lines, and by pieces of other decks. The same seed, the same decks."""

import re

#: Where words of a deck begin and end
WORD = re.compile(rb"[^\s,=]+|[,=]|\n|[ \t\r]+")

#: What a random change puts in: borders of what numbers can hold, words with a meaning, signs with one.
NUMBERS = (
    b"0", b"-0", b"1", b"-1", b"2", b"7", b"9", b"10", b"1e-300", b"1e-320", b"1e-400", b"1e300", b"1e308",
    b"-1e308", b"1e309",
    b"2147483647", b"2147483648", b"-2147483648", b"4294967296", b"9223372036854775808", b"1" * 400,
    b"0." + b"0" * 400 + b"1",
    b"nan", b"inf", b"-inf", b"1d5", b"1.5.2", b"1e", b"e5", b".", b"+", b"-", b"+-1", b"1_000", b"0x10", b"1,,",
    b"1e99999999999",
    b"123456789012345678901234567890", b"0.1", b"1e-3", b"3.0", b"1 2",
)  # fmt: skip
WORDS = (
    b"", b"X", b"ENCASTRE", b"PINNED", b"GENERATE", b"NSET", b"ELSET", b"NAME", b"OP", b"NEW", b"MOD", b"YES",
    b"NO", b"ONLY",
    b"B31", b"B33", b"CIRC", b"GENERAL", b"HERTZ", b"LINEAR", b"PAPER", b"TABLE", b"FILM", b"PLASTIC", b"CONSTANT",
    b"INTERFERENCE FIT", b"AMPLITUDE", b"TOTAL TIME", b"DIRECT", b"INC", b"U", b"RF", b"EPOT", b"SF", b"TOTALS",
    b"BLOCK", b"SKYLINE", b"MONOLITHIC", b"UPDATED", b"FREQUENCY", b"FIELD", b"TIME INCREMENTATION", b"ROTATION",
    b"CONTACT RADIUS", b"CURRENT LENGTH", b"UNLIMITED", b"A" * 81, b"A" * 5000,
)  # fmt: skip
LINES = (
    b"*NODE", b"*NODE, NSET=LOWER", b"*ELEMENT, TYPE=B31, ELSET=LOWER",
    b"*NSET, NSET=LOWER, GENERATE\n 1, 2147483647, 1",
    b"*NSET, NSET=ALL, GENERATE\n 1, 2147483646, 2147483645", b"*ELSET, ELSET=X, GENERATE\n 1, 1000000000",
    b"*STEP", b"*STEP, INC=2147483647", b"*END STEP", b"*STATIC\n 1e-300, 1e300", b"*STATIC, DIRECT\n 1, 1",
    b"*HEADING", b"**", b"*", b"* ,",
    b"*INCLUDE, INPUT=no_such_file.inp", b"*INCLUDE, INPUT=/dev/null", b"*INCLUDE, INPUT=.", b"*INCLUDE",
    b"*AMPLITUDE, NAME=A\n 0, 0, 1, 1", b"*BOUNDARY, OP=NEW", b"*BOUNDARY\n 1, ENCASTRE",
    b"*CLOAD\n 1, 1, 1e308\n 1, 1, 1e308",
    b"*TEMPERATURE\n LOWER, 300", b"*TEMPERATURE, OP=NEW", b"*INITIAL CONDITIONS, TYPE=TEMPERATURE\n LOWER, 20\n 1, 20",
    b"*CECURRENT\n 1, , 1", b"*CONTROLS, PARAMETERS=FIELD\n 1e-300",
    b"*CONTROLS, PARAMETERS=TIME INCREMENTATION\n ,,, 2147483647",
    b"*CONTACT PRINT", b"*NODE PRINT, NSET=LOWER, TOTALS=YES\n U, RF", b"*EL PRINT, ELSET=LOWER\n SF",
    b"*NODE FILE, FREQUENCY=2147483647",
    b"*SOLVER, NAME=SKYLINE", b"*MATERIAL, NAME=M", b"*ELASTIC\n 1e308, 0.3", b"*ELECTRICAL CONDUCTIVITY\n 1e308",
    b"*ELECTRICAL CONDUCTIVITY\n 5e7, 200\n 3e7, 400", b"*CONDUCTIVITY\n 390, 300\n 380, 400", b"*CONDUCTIVITY\n 390",
    b"*JOULE HEAT FRACTION\n 0.5", b"*PHYSICAL CONSTANTS, ABSOLUTE ZERO=-273.15", b"*CFLUX\n 1, 11, 2.5",
    b"*PHYSICAL CONSTANTS, ABSOLUTE ZERO=0, STEFAN BOLTZMANN=5.67e-8", b"*DFLUX\n LOWER, BF, 1e5\n 1, BF, 1",
    b"*FILM\n LOWER, F, 290, 5",
    b"*RADIATE, OP=NEW\n LOWER, R, 290, 0.8", b"*COUPLED THERMAL-ELECTRICAL, STEADY STATE\n 0.1",
    b"*COUPLED TEMPERATURE-DISPLACEMENT, STEADY STATE, ELECTRICAL\n 0.1",
    b"*BOUNDARY\n LOWER, 11, 11, 300", b"*FILM, AMPLITUDE=A, FILM AMPLITUDE=A\n LOWER, F, 290, 5",
    b"*DFLUX, AMPLITUDE=A\n LOWER, BF, 1e5", b"*DLOAD\n LOWER, PX, 1e308\n 1, P2, 3", b"*DLOAD, OP=NEW\n , GRAV, 9.81, 0, -3, 4",
    b"*DENSITY\n 8960",
    b"*DLOAD, AMPLITUDE=A\n LOWER, GRAV, 1, 1e-320, 0, 0", b"*LORENTZ\n LOWER, 1, 2, 3, 4, 5, 6, 7, -3, 9, 0, 1, -1",
    b"*BEAM SECTION, ELSET=LOWER, MATERIAL=COPPER, SECTION=GENERAL\n 1, 1, 0, 1, 1\n 0, 0, 1",
    b"*BEAM SECTION, ELSET=LOWER, MATERIAL=COPPER, SECTION=L, OFFSET1=-0.5\n 3, 2, 0.5, 0.25\n 0, 1, 0",
    b"*BEAM SECTION, ELSET=LOWER, MATERIAL=COPPER, SECTION=BOX\n 3, 2, 0.5, 0.25, 0.5, 0.125\n 0, 1, 0",
    b"*TRANSVERSE SHEAR STIFFNESS\n 1, 2, SCF", b"*NSET, NSET=OF, ELSET=LOWER", b"*NSET, NSET=LOWER, ELSET=UPPER\n 1",
    b"*SURFACE INTERACTION, NAME=X", b"*GAP ELECTRICAL CONDUCTANCE, LAW=TABLE\n 1, 1\n 2, 1",
    b"*CONTACT PAIR, INTERACTION=TOUCH\n LOWER",
    b"*EQUATION\n 2\n 2, 1, 1, 3, 1, -1", b"*EQUATION\n 3\n LOWER, 9, 1e308, 11, 9, -1\n 12, 9, 1e-308\n 2147483647",
    b"*TRANSFORM, NSET=LOWER\n 1, 2, 3, -1, 2, 4", b"*TRANSFORM, NSET=LOWER, TYPE=C\n 0, 1, 0, 0, 1, 1e-300",
    b"*TRANSFORM, NSET=UPPER, TYPE=S\n 1e308, -1e308, 0, 0, 1, 9", b"*TRANSFORM, NSET=UPPER, TYPE=R\n 0, 1",
    b"*RIGID BODY, REF NODE=1, TIE NSET=LOWER", b"*NODE\n 77, 0, 0, 0\n*RIGID BODY, REF NODE=77, PIN NSET=LOWER",
)  # fmt: skip
BYTES = b'\x00\t\n\r !"#*,-.0159=Ee_\x1f\x7f\x80\xc3\xe2\xff'


def changed_bytes(text, random):
    at, other = random.randrange(len(text) + 1), random.randrange(len(text) + 1)
    new = random.choice((bytes([random.choice(BYTES)]), bytes([random.randrange(256)])))
    match random.randrange(5):
        case 0:
            return text[:at] + new + text[at + 1 :]
        case 1:
            return text[:at] + new + text[at:]
        case 2:
            return text[:at] + text[at + random.choice((1, 1, 2, 8, 64)) :]
        case 3:
            return text[:at] + new * random.choice((2, 100, 5000)) + text[at:]
        case _:
            return text[:at] + text[min(at, other) : min(at, other) + random.randrange(64)] + text[at:]


def changed_words(text, random):
    words = WORD.findall(text)
    places = [i for i, word in enumerate(words) if not word.isspace()]
    if not places:
        return text
    at, other = random.choice(places), random.choice(places)
    match random.randrange(6):
        case 0:
            words[at] = random.choice(NUMBERS)
        case 1:
            words[at] = random.choice(WORDS)
        case 2:
            words[at] = words[other]
        case 3:
            words[at], words[other] = words[other], words[at]
        case 4:
            words[at] = b""
        case _:
            words[at] = words[at].swapcase() if random.random() < 0.5 else words[at] + b"," + words[other]
    return b"".join(words)


def changed_lines(text, random, others):
    lines = text.split(b"\n")
    at, other = random.randrange(len(lines)), random.randrange(len(lines))
    length = random.choice((1, 1, 1, 2, 5, 20))
    match random.randrange(6):
        case 0:
            del lines[at : at + length]
        case 1:
            lines[at:at] = lines[other : other + length]
        case 2:
            lines[at], lines[other] = lines[other], lines[at]
        case 3:
            lines[at:at] = [random.choice(LINES)]
        case 4:
            source = random.choice(others).split(b"\n")
            begin = random.randrange(len(source))
            lines[at:at] = source[begin : begin + length]
        case _:
            lines[at : at + length] = [b" ".join(lines[at : at + length])]
    return b"\n".join(lines)


def mutated(text, random, others):
    """A deck with one change, often, or several."""
    for _ in range(random.choice((1, 1, 1, 2, 3, 8))):
        kind = random.random()
        if kind < 0.25:
            text = changed_bytes(text, random)
        elif kind < 0.65:
            text = changed_words(text, random)
        else:
            text = changed_lines(text, random, others)
    return text[: random.randrange(len(text) + 1)] if random.random() < 0.02 else text
