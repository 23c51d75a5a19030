"""The table of readouts, how far the assumptions hold, the sketch of the indenter, and the scene in words."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np

from mdr_core.report import QUANTITIES as RESULTS
from mdr_core.report import Quantity
from mdr_core.results import friction_limits

from ..drives import Course
from ..drives.oblique import rebound
from ..solve import DRIVES, drive_of
from ..state import State, medium
from ..state.quantities import QUANTITIES, SHAPES, USED, shape_quantities
from ..state.units import KINDS, digits, fitting, written
from ..ui import explained, linked, marked, plain, symbol


@dataclass(frozen=True)
class Readout:
    """A number that is read: its name in the core's table of quantities, and what it is of a course.

    `of` gives one value, one for each state, or None where there is none. `help` and `equation` say what
    it is; `own` is its symbol, unit and name where the core has none.
    """

    name: str
    of: Callable[[Course], Any]
    help: str
    equation: str = ""
    own: tuple[str, str, str] | None = None

    @property
    def known(self) -> Quantity:
        """Symbol, unit and name."""
        return Quantity(*self.own) if self.own else RESULTS[self.name]


def _after(name: str) -> Callable[[Course], Any]:
    """A number of the rebound of an oblique impact."""
    return lambda course: None if course.oblique is None else rebound(course).get(name)


def _hit(name: str) -> Callable[[Course], Any]:
    """A number of an impact."""
    return lambda course: None if course.hit is None else getattr(course.hit, name)


def _motion(name: str) -> Callable[[Course], Any]:
    """A number of what has times."""
    return lambda course: None if course.motion is None else getattr(course.ledger, name)


def _oblique(name: str) -> Callable[[Course], Any]:
    """A number of the motion of an oblique impact."""
    return lambda course: None if course.oblique is None else getattr(course.oblique, name)


def _onset(name: str, again: bool) -> Callable[[Course], Any]:
    """A number of the state where yield begins, or goes on upon an imprint."""

    def of(course: Course) -> Any:
        if (course.before > 0) != again or course.onset is None:
            return None
        return getattr(course.onset, name)

    return of


def _relative(course: Course) -> Any:
    critical = course.scene.medium.critical_depth
    return course.states.depth / critical if critical < np.inf else None


#: Every number that can be read, in the order in which all of them are listed.
READOUTS = (
    Readout("force", lambda c: c.force, "Normal force on the indenter, that of the dashpots included.", "(22)  F = 2E* ∫ a(s) ds  over d_p < s < d"),
    Readout("depth", lambda c: c.states.depth, "Indentation depth below the virgin surface."),
    Readout("relative_depth", _relative, "Depth over the critical depth. Nothing yields below 1; far above it almost all of the contact does.", "(19)  d_c = π q_c/(2E*)", ("d/d_c", "", "relative depth")),
    Readout("contact_radius", lambda c: c.states.contact_radius, "Radius of the contact, where the equivalent profile g has risen to the depth.", "(16)  g(a) = d"),
    Readout("plastic_radius", lambda c: c.states.plastic_radius, "Radius inside which the medium has yielded; 0 before. The ring between c and a is elastic.", "(21)  g(c) = d_p"),
    Readout("plastic_depth", lambda c: c.states.plastic_depth, "Depth of the imprint in the 1D foundation: the largest depth so far less the critical depth.", "d_p = d_max − d_c,  § 4"),
    Readout("mean_pressure", lambda c: c.states.mean_pressure, "Mean pressure of the contact, dashpots included. Without them it tends to q_c/a from below.", "p_m = F/(π a²),  § 4"),
    Readout("stored_energy", lambda c: c.stored_energy, "Elastic energy in all springs, in those too that have let go and relax. Without dashpots unloading gives all of it back.", "U = 2E* ∫ (d − s) a(s) ds,  § 6"),
    Readout("plastic_work", lambda c: c.plastic_work, "Work lost to plastic yield so far.", "W_p = d_c φ(d_p),  § 6"),
    Readout("viscous_work", lambda c: c.ledger.viscous_work if c.dashpots else None, "Work lost in the dashpots so far.", "§ 12"),
    Readout("friction_work", _oblique("friction_work"), "Work lost so far where the surface slips.", "W_f = ∫ 2 ∫ q_x (W − ds/dt) dx dt,  § 13"),
    Readout("kinetic_energy", lambda c: None if c.hit is None else c.ledger.kinetic_energy, "Energy of the motion of the body, along the surface too.", "W_k = m v²/2"),
    Readout("time", _motion("time"), "Time since first contact; along a path its own."),
    Readout("velocity", _motion("velocity"), "Speed of the body, or of the indenter along a path, positive into the medium.", "m d²d/dt² = −F,  § 9"),
    Readout("tangential_force", _oblique("tangential_force"), "Force of friction against the speed along the surface.", "m_t dW/dt = −F_x,  § 13"),
    Readout("tangential_velocity", _oblique("tangential_velocity"), "Speed of the contact point along the surface, with that of the spin.", "m_t dW/dt = −F_x,  § 13"),
    Readout("critical_depth", lambda c: None if c.before or c.scene.medium.critical_depth == np.inf else c.scene.medium.critical_depth, "Depth at which yield begins, of every shape alike.", "(19)  d_c = π q_c/(2E*)", ("d_c", "m", "depth at onset of yield")),
    Readout("critical_force", _onset("force", False), "Force at which yield begins, infinitely slowly; of a cone (20).", "(22)  F_c = 2E* ∫ a(s) ds  over 0 < s < d_c", ("F_c", "N", "force at onset of yield")),
    Readout("again_depth", _onset("depth", True), "Depth at which yield goes on, on the imprint that is there.", "d_y = d_0 + d_c,  § 5", ("d_y", "m", "depth where it yields again")),
    Readout("again_force", _onset("force", True), "Force at which yield goes on, on the imprint that is there.", "§ 5", ("F_y", "N", "force where it yields again")),
    Readout("restitution", _hit("restitution"), "Speed of the rebound over that of the impact. The share e² of the energy comes back.", "e = v_r/v_0,  § 9"),
    Readout("contact_time", _hit("contact_time"), "Time from first contact to its loss.", "§ 9"),
    Readout("damaged_area", _hit("damaged_area"), "Damaged area π c²: that of the plastic zone. Of a fast impact it tends to the area of the contact, and under a cone is proportional to the energy.", "(24)  A → 4W/(π q_c s)  of a cone"),
    Readout("rebound_speed", _hit("rebound_speed"), "Speed with which the body leaves, along the normal.", "v_r = e v_0,  § 9"),
    Readout("body_angle", _after("body_angle"), "Angle to the surface at which the body leaves; above 90° it goes back.", "tan α_r = v_r/V_x,  § 13", ("α_r", "rad", "rebound angle to the surface")),
    Readout("tangential_restitution", _after("tangential_restitution"), "Tangential restitution of the contact point: −1 without friction, 0 if it rolls or stays, above 0 if it springs back.", "e_t = −W/W_0  after,  § 13"),
    Readout("body_speed", _after("body_speed"), "Speed of the body along the surface after the impact.", "V_x = W_0 + m_t(W − W_0)/m,  § 13", ("V_x", "m/s", "rebound along the surface")),
    Readout("max_tangential_force", _after("max_tangential_force"), "Largest force along the surface.", "|F_x| ≤ μ F,  § 13"),
    Readout("spin", _after("spin"), "Spin of the ball after the impact, negative where it rolls on.", "Ω = (W − V_x)/R,  § 13", ("Ω", "rad/s", "spin after")),
    Readout("spin_speed", _after("spin_speed"), "Spin of the ball after the impact times its radius, negative where it rolls on.", "RΩ = W − V_x,  § 13", ("RΩ", "m/s", "spin after, times R")),
    Readout("chain_error", lambda c: c.states.error if c.chained else None, "Error that the chain of springs and dashpots estimates of itself: of force and energies along a depth, of the depth under a force, each relative to its largest.", "§ 14", ("ε", "", "error of the chain")),
)  # fmt: skip


def readings(course: Course) -> dict[Readout, Any]:
    """All that can be read of a course: one value, or one for each state."""
    found = ((readout, readout.of(course)) for readout in READOUTS)
    return {readout: values for readout, values in found if values is not None}


def here(values: Any, i: int) -> float:
    """The value of a number in state i: it has one, or one for each state."""
    return float(values if np.ndim(values) == 0 else values[i])


def text(readout: Readout, values: Any, i: int, count: int = 4) -> str:
    """A number in state i with its unit."""
    return written(here(values, i), KINDS[readout.known.unit], count)


def line(course: Course, found: dict[Readout, Any]) -> list[Readout]:
    """The readouts that are always seen."""
    names = drive_of(course.scene).line
    return [readout for readout in found if readout.name in names]


def values(course: Course, found: dict[Readout, Any], i: int) -> str:
    """The cells of the line in state i, as HTML."""
    cells = (
        f'<output data-name="{each.name}">{text(each, found[each], i)}</output>'
        for each in line(course, found)
    )
    return f'<div class="strip">{"".join(cells)}</div>'


def heads(course: Course, found: dict[Readout, Any]) -> str:
    """What stands above the cells of the line; each says what it is."""
    return f'<div class="strip">{"".join(map(_head, line(course, found)))}</div>'


def table(course: Course, found: dict[Readout, Any], i: int) -> str:
    """All numbers in state i, as HTML."""
    rows = (
        f'<tr data-name="{each.name}"><th scope="row">{_head(each)}</th><td>{text(each, value, i)}</td></tr>'
        for each, value in found.items()
    )
    return f'<p class="phase">{phase(course, i)}</p><table>{"".join(rows)}</table>'


@cache
def _head(readout: Readout) -> str:
    known = readout.known
    about = f"<p>{linked(readout.help)}</p><em>{linked(readout.equation)}</em>"
    return explained(f"about-{readout.name}", f"{symbol(known.symbol)} {known.long_name}", about)


def phase(course: Course, i: int) -> str:
    """Where a state stands on its path, in words."""
    share, rise = course.progress[i], course.states.depth[i] - course.states.depth[max(i - 1, 0)]
    if i == course.peak:
        words = "deepest"
    elif i and (course.states.contact_radius[i] == 0 or (share >= 2 and not course.turns)):
        words = "load gone"
    else:
        words = "unloading" if rise < 0 else "holding" if i and rise == 0 else "loading"
    words += f", {course.pending}" if course.pending else ""
    if course.motion is None:
        return words
    unit = fitting(float(course.motion.time[-1]), "time")
    return f"{words}, t = {digits(float(course.motion.time[i]) / unit.factor, 3)} {unit.name}"


def limits(course: Course, state: State) -> Iterator[tuple[str, str]]:
    """How far the assumptions hold, as the core says: "good", "note" or "beyond", with a sentence."""
    found = list((course.states if course.hit is None else course.hit).limits)
    if course.hit is not None and state.inertia == "density":
        found.append(course.hit.speed_limit(state.density))
    found += friction_limits(course.scene.medium) if course.oblique is not None else ()
    given = state.elasticity != "modulus"
    for limit in sorted(found, key=lambda limit: limit.concerns != "result"):
        if limit.what == "Poisson ratio" and not given:
            yield "note", "Dashpots beside springs are exact for ν = ½ only; ν is not given with E*."
        elif limit.what == "coupling" and not given:
            yield "note", "Friction along the surface is that of ν = ½; ν is not given with E*."
        else:
            areas = _areas(course.hit) if limit.what == "fast limit" and np.isfinite(limit.value) else ""
            yield limit.level, plain(limit.sentence) + areas


def _areas(hit: Any) -> str:
    """Both areas that the fast limit may be compared with."""
    limit = float(hit.fast_limit.contact_area)
    area = {"πa²": float(np.pi * hit.contact_radius**2), "A = πc²": float(hit.damaged_area)}
    texts = (
        f"{written(value, 'area')} ({name}, {_percent(limit / value - 1)})" for name, value in area.items()
    )
    return f" Its area is {written(limit, 'area')}, beside that of the contact and the damaged one: {', '.join(texts)}."


def _percent(share: float) -> str:
    return f"{100 * share:+.3g} %".replace("-", "−")


def warnings(course: Course, state: State) -> str:
    """What is exceeded, as HTML; what holds is folded."""
    said = [
        (level, f'<span class="{level}">{linked(sentence)}</span>')
        for level, sentence in limits(course, state)
    ]
    seen = "".join(html for level, html in said if level == "beyond")
    rest = "".join(html for level, html in said if level != "beyond")
    return (
        f"{seen}<details><summary>Assumptions that hold, and notes</summary>{rest}</details>"
        if rest
        else seen
    )


def sketch(course: Course, shape: str) -> str:
    """A small drawing of the indenter z(r), its height stretched to fit, with its formulas, as HTML."""
    profile, a = course.scene.profile, float(course.deepest.contact_radius)
    width, height, half = 104, 46, min(1.5 * a, profile.known_radius)
    r = np.unique(np.append(np.linspace(0, half, 60), min(profile.wall, half)))
    z = profile.height(r)
    finite = np.isfinite(z)
    top = z[finite].max() or 1.0
    x, y = r[finite] / half * (width / 2 - 4), height - 8 - z[finite] / top * (height - 14)
    if not finite.all():
        x, y = np.append(x, x[-1]), np.append(y, 4)
    x, y = np.concatenate([-x[::-1], x]) + width / 2, np.concatenate([y[::-1], y])
    points = " ".join(f"{px:.1f},{py:.1f}" for px, py in zip(x, y, strict=True))
    words, size = SHAPES[shape], f'width="{width}" height="{height}"'
    ground = f'<line x1="0" y1="{height - 7}" x2="{width}" y2="{height - 7}"/>'
    drawing = (
        f'<svg {size} role="img" aria-label="{words.label}">{ground}<polygon points="{points}"/></svg>'
    )
    formulas = f"{marked(words.height)}<br>{marked(words.reduced)}"
    return f"<figure>{drawing}<figcaption>{formulas}</figcaption></figure>"


def summary(state: State) -> str:
    """A scene in a line: its shape, medium and drive with their main numbers."""
    made, drive = medium(state), DRIVES[state.drive]
    names = [name for name, _ in shape_quantities(state.shape)]
    names += [name for name in ("E_star", "q_c", "eta") if 0 < getattr(made, name) < np.inf]
    names += USED["drive"][state.drive]
    names += ["plastic_depth"] * ("surface" in drive.form and state.surface == "imprint")
    words = [SHAPES[state.shape].label]
    for name in names:
        value = float(getattr(made, name)) if name in ("E_star", "q_c", "eta") else state[name]
        words.append(f"{QUANTITIES[name].symbol} = {written(value, QUANTITIES[name].kind, 3)}")
    return ", ".join([*words, *drive.words(state)])
