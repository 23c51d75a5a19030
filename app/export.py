"""What is taken away as text: curves as CSV, and the state as a Python snippet."""

from importlib.metadata import PackageNotFoundError, version

import numpy as np

import mdr_core as mdr

from .trajectory import INSTANTS

_INPUT = "#   {}: {}"


def csv(trajectory, explorer):
    """Every state along the way as CSV in SI, with inputs, units and version in its header."""
    states, motion = trajectory.states, trajectory.motion
    columns = {
        "depth d (m)": states.depth,
        "force F (N)": trajectory.force,
        "contact radius a (m)": states.contact_radius,
        "plastic radius c (m)": states.plastic_radius,
        "plastic depth d_p (m)": states.live.lower,
        "stored energy U (J)": trajectory.stored_energy,
        "plastic work W_p (J)": trajectory.plastic_work,
    }
    if motion is not None:
        columns = {"time t (s)": motion.time} | columns
        columns["velocity v (m/s)"] = motion.velocity
        columns["kinetic energy (J)"] = motion.kinetic_energy
        columns["viscous work (J)"] = motion.viscous_work
    return _table(trajectory, explorer, "states along the way", columns)


def pressure_csv(trajectory, explorer, points=401):
    """Pressure, line load and reduced profile of the present state as CSV in SI."""
    state, profile = trajectory.state, trajectory.scene.profile
    largest = 1.25 * float(trajectory.deepest.contact_radius)
    r = np.linspace(0, min(largest, profile.known_radius), points)
    columns = {
        "radius r (m)": r,
        "sigma_zz (Pa)": 0.0 - state.pressure(r),
        "line load q (N/m)": state.line_load(r),
        "reduced profile g (m)": profile.reduced(r),
    }
    depth, force = float(state.depth), float(trajectory.force[trajectory.now])
    notes = _MEASURED if isinstance(profile, mdr.Sampled) else ()
    return _table(
        trajectory, explorer, f"state at depth d = {depth!r} m, force F = {force!r} N", columns, notes
    )


#: How far the pressure of a measured tip can be trusted.
_MEASURED = (
    "sigma_zz: Eq. (10) of Popov (2015), to rounding for the tip with straight lines between its samples",
    "every sample is a kink: next to a sharp one the pressure is that of the kink, not of the real tip",
    "the page draws it from 402 values of the line load: within 0.2 % of the mean pressure but at a kink",
)


def _table(trajectory, explorer, title, columns, notes=()):
    lines = [f"# mdr_core {_version()}: {title}", "# inputs, SI units:"]
    lines += [_INPUT.format(name, value) for name, value in _inputs(trajectory.scene, explorer)]
    lines += [f"# {note}" for note in notes]
    lines.append(",".join(columns))
    rows = zip(*(np.asarray(values, float).tolist() for values in columns.values()), strict=True)
    lines += [",".join(map(repr, row)) for row in rows]
    return "\n".join(lines) + "\n"


def _inputs(scene, explorer):
    medium = scene.medium
    if explorer.preset:
        yield "preset", f"{explorer.preset}{', altered' if explorer.altered else ''}"
    yield "profile", _profile(scene.profile, limit=6)
    yield "medium", f"E_star = {medium.E_star!r} Pa, q_c = {medium.q_c!r} N/m, eta = {medium.eta!r} Pa·s"
    # What the medium was made of.
    given = [name for name in explorer.used() if name not in ("E_star", "q_c", "eta")]
    yield "set on the page", ", ".join(f"{name} = {getattr(explorer, name)!r}" for name in given)
    yield "drive", repr(scene.drive)


def _version():
    try:
        return version("mdr-core")
    except PackageNotFoundError:
        return "(not installed)"


def _profile(profile, limit=None):
    """A profile as Python makes it; of many samples only the first, if there is a limit."""
    if isinstance(profile, mdr.Sampled) and limit and len(profile.r) > limit:
        return f"Sampled of {len(profile.r)} samples to r = {profile.r[-1]!r} m, z = {profile.z[-1]!r} m"
    return repr(profile)


def python(trajectory, held=None):
    """A snippet that comes to the present state with `mdr_core`, and to the one held beside it."""
    lines = ["import mdr_core as mdr", "", *_solved(trajectory)]
    if held is not None:
        lines += ["", "# What is held to compare with:", *_solved(held, "held_")]
    return "\n".join(lines) + "\n"


def _solved(trajectory, prefix=""):
    scene = trajectory.scene
    medium = scene.medium
    q_c = "" if np.isinf(medium.q_c) else f", q_c={medium.q_c!r}"
    eta = f", eta={medium.eta!r}" if medium.eta > 0 else ""
    profile = f"{prefix}profile"
    lines = [
        f"{profile} = mdr.{_profile(scene.profile)}",
        f"{prefix}medium = mdr.Medium(E_star={medium.E_star!r}{q_c}{eta})  # Pa, N/m, Pa·s",
    ]
    given = f"{profile}, {prefix}medium"
    if trajectory.hit is not None:
        return lines + _hit(trajectory, prefix, given)
    deepest, now = float(trajectory.deepest.depth), float(trajectory.state.depth)
    path = f"[{deepest!r}, {now!r}]" if trajectory.now > trajectory.peak else f"[{now!r}]"
    state = f"{prefix}state"
    return [
        *lines,
        f"{state} = mdr.indent({given}, {path})[-1]  # m",
        f"print({state}.force, {state}.contact_radius, {state}.plastic_radius)",
    ]


def _hit(trajectory, prefix, given):
    """Lines for an impact, and for the instant at which the page stands if it is not the turning point."""
    drive, now, peak = trajectory.scene.drive, trajectory.now, trajectory.peak
    before = f", plastic_depth={drive.plastic_depth!r}" if drive.plastic_depth > 0 else ""
    hit, motion = f"{prefix}hit", f"{prefix}motion"
    lines = [
        f"{hit} = mdr.impact({given}, mass={drive.mass!r}, speed={drive.speed!r}{before})",
        f"print({hit}.max_depth, {hit}.max_force, {hit}.restitution, {hit}.contact_time)",
    ]
    if now == peak:
        return lines
    values = ("time", "depth", "velocity", "force", "contact_radius", "plastic_radius")
    shown = ", ".join(f"{motion}.{value}[i]" for value in values)
    return [*lines, f"{motion} = {hit}.motion({INSTANTS})", f"i = {now}", f"print({shown})"]
