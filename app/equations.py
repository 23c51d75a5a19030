"""The equations where they are used, as MathML that every browser sets by itself."""


def _tag(name):
    def build(*parts):
        return f"<{name}>{''.join(map(_part, parts))}</{name}>"

    return build


def _part(part):
    """A piece of a formula: a tag as it is, a word as an identifier, anything else as an operator."""
    if part.startswith("<"):
        return part
    if part.replace(".", "").isdigit():
        return f"<mn>{part}</mn>"
    return f"<mi>{part}</mi>" if part.strip("′*").isalpha() else f"<mo>{part}</mo>"


_row, _fraction, _root = _tag("mrow"), _tag("mfrac"), _tag("msqrt")
_sub, _sup, _both = _tag("msub"), _tag("msup"), _tag("msubsup")


def _math(*parts):
    return f'<math display="inline">{_row(*parts)}</math>'


_E, _qc, _dc = _sup("E", "∗"), _sub("q", "c"), _sub("d", "c")
_dp, _eta = _sub("d", "p"), _row("8", "η", "a")
_ring = _root(_sup("x", "2"), "−", _sup("r", "2"))
_dd = _row("d", "s")

_mode = _fraction(_row("1", "−", _sup(_sub("ν", "1"), "2")), _sub("E", "1"))
_mode2 = _fraction(_row("1", "−", _sup(_sub("ν", "2"), "2")), _sub("E", "2"))

#: Every equation by a key: its number in the paper, the formula, what it says.
EQUATIONS = {
    "elements": (
        "(1)",
        _math("Δ", "k", "=", _E, "Δ", "x", ",", "Δ", "γ", "=", "4", "η", "Δ", "x"),
        "springs and dashpots, independent of each other",
    ),
    "modulus": ("(2)", _math(_fraction("1", _E), "=", _mode, "+", _mode2), "effective modulus"),
    "profile": (
        "(3)",
        _math(
            *("g", "(", "x", ")", "=", "x", _both("∫", "0", "x")),
            *(_fraction(_row("z′", "(", "r", ")"), _ring), "d", "r"),
        ),
        "equivalent 1D profile",
    ),
    "pressure": (
        "(10)",
        _math(
            *(_sub("σ", "zz"), "(", "r", ")", "=", _fraction("1", "π"), _both("∫", "r", "∞")),
            *(_fraction(_row("q′", "(", "x", ")"), _ring), "d", "x"),
        ),
        "normal stress under the indenter",
    ),
    "hardness": (
        "(11)",
        _math("F", "=", "π", _sup("a", "2"), _sub("σ", "c"), "=", "π", _qc, "a"),
        "hardness inversely proportional to the contact radius",
    ),
    "springs": (
        "(17) (18)",
        _math("q", "=", _E, "(", "d", "−", "g", "(", "x", ")", ")", "≤", _fraction("π", "2"), _qc),
        "line load, at most what (12) allows",
    ),
    "onset": (
        "(19)",
        _math(_dc, "=", _fraction(_row("π", _qc), _row("2", _E))),
        "depth where yield starts",
    ),
    "radii": (
        "(16) (21)",
        _math("g", "(", "a", ")", "=", "d", ",", "g", "(", "c", ")", "=", "d", "−", _dc),
        "contact and plastic radius, while loading",
    ),
    "force": (
        "(20) (22)",
        _math("F", "=", "2", _E, _both("∫", _dp, "d"), "a", "(", "s", ")", "d", "s"),
        "force; for a cone the paper's two formulas",
    ),
    "energy": (
        "",
        _math(
            _fraction(_row("m", _sup("v", "2")), "2"), "+", "U", "+", _sub("W", "p"), "+", _sub("W", "v")
        ),
        "the energy before the impact, at every instant",
    ),
    "motion": (
        "",
        _math("m", "d̈", "=", "−", "F"),
        "the body is free: only the contact slows it down",
    ),
    "fast": (
        "(23) (24)",
        _math(
            "W",
            "≈",
            _fraction(_row(_qc, _sup("d", "2")), "s"),
            ",",
            "A",
            "≈",
            _fraction("4W", _row("π", _qc, "s")),
        ),
        "a cone, far beyond the critical depth",
    ),
}

KEYS = (
    "Numbers can be typed (2.5, 3e-6, 250 MPa) or dragged; on a slider arrow keys step, Page Up and Page "
    "Down leap, Home and End go to the ends, a double click resets. Drag along the force–depth curve to "
    "move through the states. Space plays, H holds the curves, R resets, Z undoes, Y does again, M shows "
    "the map, S speed against error, D changes light and dark."
)

MODEL = (
    "A rigid indenter on a half-space, at small slopes; the yield criterion is non-local, hardness "
    "inversely proportional to the contact radius (class b of the paper). Equation numbers are those of "
    "V. L. Popov, Facta Universitatis, Mech. Eng. 13(1), 2015, 39–46. Where −σ_zz is infinite, at the "
    "rim of a flat face or under a sharp tip, the picture is clipped; forces and energies never are."
)
