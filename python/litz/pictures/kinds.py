"""Kinds of pictures, apart from what draws them, which takes long to load."""

#: Width and height of each kind [inches]
INCHES = {
    "overview": (15.0, 8.5),
    "wires": (10.0, 7.0),
    "resistance": (7.5, 5.5),
    "residuals": (8.0, 7.5),
    "contacts": (10.0, 7.0),
    "lines": (9.0, 4.0),
    "currents": (10.0, 7.0),
    "shares": (9.0, 6.5),
    "section": (8.0, 7.0),
    "network": (9.0, 7.0),
    "friction": (8.0, 7.0),
    "surfaces": (8.0, 7.0),
    "history": (8.0, 4.0),
}
KINDS = tuple(INCHES)
