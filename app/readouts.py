"""What stands around the plots: numbers, how far the assumptions hold, the sketch of the indenter."""

import numpy as np

from .quantities import QUANTITIES, SHAPES, USED, shape_quantities
from .units import digits, written
from .view import phase

#: Slope that counts as small, slope that does no more; share of the wave speed that is slow.
SMALL_SLOPE, STEEP_SLOPE, SLOW = 0.3, 0.5, 0.1
#: Difference from a limit in which it is said to hold.
CLOSE = 0.1


def cells(way):
    """Symbol, label, kind and values of every number shown; one value, or one for each state."""
    states, critical, motion, hit = way.states, way.scene.medium.critical_depth, way.motion, way.hit
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
    if hit is not None:
        rows += [
            ("e", "restitution", "number", hit.restitution),
            ("T", "contact time", "time", hit.contact_time),
            ("A", "damaged area", "area", hit.damaged_area),
            ("v_r", "rebound speed", "speed", hit.rebound_speed),
            ("W_p", "plastic work, in all", "energy", hit.plastic_work),
        ]
        if hit.viscous_work > 0:
            rows.append(("W_v", "viscous work, in all", "energy", hit.viscous_work))
    return rows


def _onset(way):
    """Where yield starts; on an imprint, where it goes on."""
    onset, again = way.onset, way.before > 0
    index, words = ("y", "where it yields again") if again else ("c", "at onset")
    depth, force = (f"d_{index}", f"depth {words}", "length"), (f"F_{index}", f"force {words}", "force")
    if onset is not None:
        return [(*depth, onset.depth), (*force, onset.force)]
    return [] if again else [(*depth, way.scene.medium.critical_depth)]


def values(way, rows, i):
    """The phase of a state and all its numbers, as one text: `rows` are the `cells`."""
    texts = [written(float(v if np.ndim(v) == 0 else v[i]), kind) for _, _, kind, v in rows]
    return "|".join([phase(way, i), *texts])


def heads(rows, symbol):
    """The cells of all numbers, with room for them."""
    cells = "".join(
        f'<div class="cell" data-symbol="{name}"><dt>{"/".join(map(symbol, name.split("/")))} {label}</dt>'
        "<dd></dd></div>"
        for name, label, *_ in rows
    )
    return f'<dl class="strip">{cells}</dl>'


def lights(way, density, ratio):
    """How far the assumptions hold: pairs of "good", "note" or "beyond", and a sentence.

    `density` is that of the medium, `ratio` its Poisson ratio; None where they are not known.
    """
    found, medium, hit = [_slope_light(way.largest_slope)], way.scene.medium, way.hit
    if hit is not None and medium.eta > 0:
        found.append(_dashpot_light(ratio))
    if hit is not None and density is not None:
        found.append(_wave_light(float(hit.speed), (medium.E_star / density) ** 0.5))
    if hit is not None and medium.critical_depth < np.inf:
        found.append(_limit_light(way))
    return found


def _slope_light(slope):
    text = f"Slopes reach {digits(slope, 2)}"
    if slope <= SMALL_SLOPE:
        return "good", f"{text}: small, as the model takes them"
    text += f": small slopes are an approximation, good to about s² = {digits(100 * slope**2, 2)} %"
    return "note" if slope <= STEEP_SLOPE else "beyond", text


def _dashpot_light(ratio):
    if ratio is None:
        return "note", "Dashpots beside springs are exact for ν = ½; ν is not given with E*"
    if ratio >= 0.495:
        return "good", "Dashpots beside springs: exact at ν = ½"
    return "beyond", f"Dashpots beside springs are exact for ν = ½ only; here ν_1 = {digits(ratio, 2)}"


def _wave_light(speed, wave):
    share = speed / wave
    text = f"v_0 is {digits(share, 2)} of the wave speed √(E*/ρ) = {written(wave, 'speed', 3)}"
    if share <= SLOW:
        return "good", f"{text}: quasi-static"
    return "beyond", f"{text}: waves carry energy away"


def _limit_light(way):
    """The paper's limit of fast impacts; no assumption: to be far from it is no fault."""
    if way.before > 0:
        return "note", "Fast limit (23) (24): for the first impact on a spot"
    try:
        error = float(way.hit.fast_limit.contact_area_error)
    except ValueError:
        return "note", "Fast limit (23) (24): beyond the depth to which the shape is known"
    text = f"Fast limit (23) (24): {'+' if error > 0 else '−'}{digits(abs(100 * error), 2)} % of the area"
    return ("good", f"{text}, holds") if abs(error) <= CLOSE else ("note", f"{text}, does not hold")


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
    caption = "<figcaption>{}<br>{}</figcaption>"
    return f"<figure>{drawing}{caption}</figure>", (words.height, words.reduced)


def summary(explorer):
    """A scene in a line: its shape, medium and drive with their main numbers."""
    medium, imprint = explorer.medium(), explorer.drive == "impact" and explorer.surface == "imprint"
    names = [name for name, _ in shape_quantities(explorer.shape)]
    names += [name for name in ("E_star", "q_c", "eta") if 0 < getattr(medium, name) < np.inf]
    names += [*USED["drive"][explorer.drive], *["plastic_depth"] * imprint]
    words = [SHAPES[explorer.shape].label]
    for name in names:
        value = getattr(medium if name in ("E_star", "q_c", "eta") else explorer, name)
        words.append(f"{QUANTITIES[name].symbol} = {written(value, QUANTITIES[name].kind, 3)}")
    return ", ".join(words)


def density_and_ratio(explorer):
    """Density and Poisson ratio of the medium, None where they are not given."""
    density = explorer.density if explorer.inertia == "density" else None
    return density, explorer.nu_1 if explorer.elasticity != "modulus" else None
