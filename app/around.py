"""What stands around the plots: the indenter's drawing, validity lights, sources of a preset."""

import numpy as np

import mdr_core as mdr

from .presets import PRESETS
from .quantities import CHOICES, QUANTITIES, USED, shape_quantities
from .shapes import SHAPES
from .units import digits, written

#: Slope beyond which a half-space and small slopes are an approximation.
SMALL_SLOPE = 0.3
#: Critical depths from which (23) and (24) are near their limit, and share of the wave speed that is slow.
DEEP, SLOW = 10.0, 0.1


def sketch(trajectory, shape):
    """A small drawing of the indenter z(r), its height stretched to fit, with its formulas."""
    profile, a = trajectory.scene.profile, float(trajectory.deepest.contact_radius)
    width, height, half = 132, 64, min(1.5 * a, profile.known_radius)
    r = np.unique(np.concatenate([np.linspace(0, half, 60), [min(profile.wall, half)]]))
    z = profile.height(r)
    finite = np.isfinite(z)
    top = z[finite].max() or 1.0
    x, y = r[finite] / half * (width / 2 - 4), height - 8 - z[finite] / top * (height - 16)
    if not finite.all():
        x, y = np.append(x, x[-1]), np.append(y, 4)
    x, y = np.concatenate([-x[::-1], x]) + width / 2, np.concatenate([y[::-1], y])
    points = " ".join(f"{px:.1f},{py:.1f}" for px, py in zip(x, y, strict=True))
    described = SHAPES.get(shape)
    lines = [described.height, described.reduced] if described else ["z(r) through its samples", "g by (3)"]
    return {"points": points, "lines": lines, "shape": described.label if described else "Measured tip"}


def lights(trajectory, density):
    """How far the assumptions hold for this scene: pairs of whether they do, and a sentence."""
    slope = float(trajectory.largest_slope)
    small = slope <= SMALL_SLOPE
    rest = "a half-space at small slopes" if small else "beyond 0.3 small slopes are an approximation"
    found = [(small, f"Slopes reach {digits(slope, 2)}: {rest}")]
    depth, critical = float(trajectory.deepest.depth), trajectory.scene.medium.critical_depth
    if critical < np.inf and trajectory.onset is not None:
        found.append(_depth_light(trajectory, depth / critical))
    if trajectory.hit is not None and density is not None:
        wave = (trajectory.scene.medium.E_star / density) ** 0.5
        share = float(trajectory.hit.speed) / wave
        slow = share <= SLOW
        text = f"v₀ is {digits(share, 2)} of the wave speed √(E*/ρ) = {written(wave, 'speed', 3)}"
        found.append((slow, text + (": quasi-static" if slow else ": waves carry energy away")))
    return found


def _depth_light(trajectory, ratio):
    text = f"Largest depth {digits(ratio, 3)} d_c"
    if trajectory.before > 0:
        return False, f"{text}: (23) (24) are for the first impact on a spot"
    profile, deepest = trajectory.scene.profile, trajectory.deepest
    if not isinstance(profile, mdr.Cone):
        holds = "holds" if ratio >= DEEP else "does not hold"
        return ratio >= DEEP, f"{text}: the limit d ≫ d_c of (23) (24) {holds}"
    medium = trajectory.scene.medium
    work = float(deepest.stored_energy + deepest.plastic_work)
    area = np.pi * float(deepest.contact_radius) ** 2
    error = 4 * work / (np.pi * medium.q_c * profile.slope) / area - 1
    return ratio >= DEEP, f"{text}: (24) is off by {digits(100 * error, 2)} % of the area"


def summary(state):
    """A scene in a line: its shape, medium and drive with their main numbers."""
    medium, drive = state.medium(), USED["drive"][state.choices["drive"]]
    values = [(q, state.numbers[name]) for name, q in shape_quantities(state.shape)]
    parts = [f"{q.symbol} = {written(value, q.kind, 3)}" for q, value in values]
    parts.append(f"E* = {written(medium.E_star, 'pressure', 3)}")
    if medium.q_c < np.inf:
        parts.append(f"q_c = {written(medium.q_c, 'yield constant', 3)}")
    if medium.eta > 0:
        parts.append(f"η = {written(medium.eta, 'viscosity', 3)}")
    given = [(QUANTITIES[name], state.numbers[name]) for name in drive]
    if getattr(state.drive(), "plastic_depth", 0.0) > 0:
        given.append((QUANTITIES["plastic_depth"], state.numbers["plastic_depth"]))
    parts += [f"{q.symbol} = {written(value, q.kind, 3)}" for q, value in given]
    return f"{CHOICES['shape'][state.shape]}, {', '.join(parts)}"


def sources(preset):
    """The preset's numbers, each with where it comes from."""
    return [list(source) for source in PRESETS[preset].sources]


def numbers(trajectory):
    """Results that belong to the scene rather than to one state: label, symbol, kind and value (SI)."""
    medium, onset, hit = trajectory.scene.medium, trajectory.onset, trajectory.hit
    rows = [("d_c", "depth at onset", "length", medium.critical_depth)]
    if onset is not None:
        rows.append(("F_c", "force at onset", "force", float(onset.force)))
    if hit is not None:
        rows += [
            ("e", "restitution", "number", float(hit.restitution)),
            ("T", "contact time", "time", float(hit.contact_time)),
            ("A", "damaged area", "area", float(hit.damaged_area)),
            ("v_r", "rebound speed", "speed", float(hit.rebound_speed)),
            ("W_p", "plastic work, in all", "energy", float(hit.plastic_work)),
        ]
        if float(hit.viscous_work) > 0:
            rows.append(("W_v", "viscous work, in all", "energy", float(hit.viscous_work)))
    return [[*row[:3], None if np.isinf(row[3]) else row[3]] for row in rows]
