"""What stands around the plots: numbers, how far the assumptions hold, the sketch of the indenter."""

from functools import cache

import numpy as np

from mdr_core.results.limits import friction_limits

from .drives import DRIVES, drive_of
from .parts import explained, linked, marked, plain, symbol
from .quantities import DATA, QUANTITIES, SHAPES, USED, shape_quantities
from .units import written
from .view import phase


def cells(way):
    """Symbol, label, kind and values of every number shown; one value, or one for each state."""
    states, critical, motion = way.states, way.scene.medium.critical_depth, way.motion
    rows = [("F", "force", "force", way.force), ("d", "depth", "length", states.depth)]
    if critical < np.inf:
        rows.append(("d/d_c", "relative depth", "number", states.depth / critical))
    rows += [
        ("a", "contact radius", "length", states.contact_radius),
        ("c", "plastic radius", "length", states.plastic_radius),
        ("p_m", "mean pressure", "pressure", states.mean_pressure),
        ("U", "stored energy", "energy", way.stored_energy),
        ("W_p", "plastic work", "energy", way.plastic_work),
    ]
    if motion is not None:
        rows += [("t", "time", "time", motion.time), ("v", "speed", "speed", motion.velocity)]
    rows += _onset(way)
    return rows + drive_of(way.scene).cells(way)


def _onset(way):
    """Where yield starts; on an imprint, where it goes on."""
    onset, again = way.onset, way.before > 0
    index, words = ("y", "where it yields again") if again else ("c", "at onset")
    depth, force = (f"d_{index}", f"depth {words}", "length"), (f"F_{index}", f"force {words}", "force")
    if onset is not None:
        return [(*depth, onset.depth), (*force, onset.force)]
    return [] if again else [(*depth, way.scene.medium.critical_depth)]


def here(values, i):
    """The value of a number in state i: it has one, or one for each state."""
    return float(values if np.ndim(values) == 0 else values[i])


def values(way, rows, i):
    """The phase of a state and all its numbers, as one text: `rows` are the `cells`."""
    texts = [written(here(each, i), kind) for _, _, kind, each in rows]
    return "|".join([phase(way, i), *texts])


def heads(rows):
    """The cells of all numbers, with room for them; each says what it is."""
    return f'<dl class="strip">{"".join(_head(name, label) for name, label, *_ in rows)}</dl>'


@cache
def _head(name, label):
    words = DATA["readouts"][name]
    about = f"<p>{linked(words['help'])}</p><em>{linked(words['equation'])}</em>"
    key = f"about-{name}-{label}".replace(" ", "-")
    label = f"{symbol(name)} {label}"
    return f'<div class="cell" data-symbol="{name}"><dt>{explained(key, label, about)}</dt><dd></dd></div>'


def lights(way, explorer):
    """How far the assumptions hold, as the core says: "good", "note" or "beyond", with a sentence."""
    limits = list((way.states if way.hit is None else way.hit).limits)
    if way.hit is not None and explorer.inertia == "density":
        limits.append(way.hit.speed_limit(explorer.density))
    limits += friction_limits(way.scene.medium) if way.oblique is not None else ()
    given = explorer.elasticity != "modulus"
    for limit in sorted(limits, key=lambda limit: limit.concerns != "result"):
        if limit.what == "Poisson ratio" and not given:
            yield "note", "Dashpots beside springs are exact for ν = ½ only; ν is not given with E*."
        elif limit.what == "coupling" and not given:
            yield "note", "Friction along the surface is that of ν = ½; ν is not given with E*."
        else:
            yield limit.level, plain(limit.sentence)


def sketch(way, shape):
    """A small drawing of the indenter z(r), its height stretched to fit, with its formulas, as HTML."""
    profile, a = way.scene.profile, float(way.deepest.contact_radius)
    width, height, half = 132, 64, min(1.5 * a, profile.known_radius)
    r = np.unique(np.append(np.linspace(0, half, 60), min(profile.wall, half)))
    z = profile.height(r)
    finite = np.isfinite(z)
    top = z[finite].max() or 1.0
    x, y = r[finite] / half * (width / 2 - 4), height - 8 - z[finite] / top * (height - 16)
    if not finite.all():
        x, y = np.append(x, x[-1]), np.append(y, 4)
    x, y = np.concatenate([-x[::-1], x]) + width / 2, np.concatenate([y[::-1], y])
    points = " ".join(f"{px:.1f},{py:.1f}" for px, py in zip(x, y, strict=True))
    words, size = SHAPES[shape], f'width="{width}" height="{height}"'
    line = f'<line x1="0" y1="{height - 7}" x2="{width}" y2="{height - 7}"/>'
    drawing = f'<svg {size} role="img" aria-label="{words.label}">{line}<polygon points="{points}"/></svg>'
    formulas = f"{marked(words.height)}<br>{marked(words.reduced)}"
    return f"<figure>{drawing}<figcaption>{formulas}</figcaption></figure>"


def summary(explorer):
    """A scene in a line: its shape, medium and drive with their main numbers."""
    medium, drive = explorer.medium(), DRIVES[explorer.drive]
    names = [name for name, _ in shape_quantities(explorer.shape)]
    names += [name for name in ("E_star", "q_c", "eta") if 0 < getattr(medium, name) < np.inf]
    names += USED["drive"][explorer.drive]
    names += ["plastic_depth"] * ("surface" in drive.form and explorer.surface == "imprint")
    words = [SHAPES[explorer.shape].label]
    for name in names:
        value = getattr(medium if name in ("E_star", "q_c", "eta") else explorer, name)
        words.append(f"{QUANTITIES[name].symbol} = {written(value, QUANTITIES[name].kind, 3)}")
    return ", ".join([*words, *drive.words(explorer)])
