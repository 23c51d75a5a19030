"""How often each remark is made, and how often it is right, on made and on measured curves.

    python -m tests.benchmarks.remarks

prints the table, which is a part of assets/fits.md.
"""

import tempfile
from collections import Counter, defaultdict
from importlib.util import find_spec
from pathlib import Path

import numpy as np

import mdr_core as mdr
from mdr_core.base.remark import KINDS

from ..measurements.fit import families
from ..measurements.fit.test_fit import AFM, HERTZ, measured
from ..measurements.fit.test_fit_in_time import fit_of
from ..measurements.fit.test_fit_of_classes import BERKOVICH, BOUNDS, DATA, real
from ..measurements.unloading.test_creep import record

GEL, GLASS, METAL = families.KINDS.values()
#: Kinds of remarks that name what a family of simulated curves has.
NAMES = {
    "tilt": {"tilt", "misfit"},
    "retract": {"unloading", "misfit"},
    "drift": {"drift", "unloading", "creep", "misfit"},
    "creep": {"drift", "unloading", "misfit", "creep"},
    "correlated noise": {"errors"},
    "outliers": {"outliers"},
    "few samples": {"errors", "undetermined", "vague"},
}
#: The kind of errors and of numbers that are not quoted, which no result has among its remarks.
OF_ERRORS = "no unloading"
#: Remarks on correlated residuals are right where these are not noise.
CORRELATED = {"tilt", "retract", "drift", "creep", "correlated noise"}


def kinds(result):
    return {remark.kind for remark in result.remarks}


def of_families(seeds):
    """Yields the kinds of remarks on each curve of the families, and which are right."""
    for medium in families.KINDS.values():
        for family, sizes in families.FAMILIES.items():
            for size in sizes:
                fit = families.fits(medium, family, size, range(seeds))
                covered = families.covered(medium, fit)
                for i in range(seeds):
                    made = kinds(fit[i])
                    right = made & NAMES.get(family, set())
                    right |= made & {"errors"} if family in CORRELATED else set()
                    yield made, right if covered[i] else made


def of_a_kind(medium, seed):
    """Yields the remarks on simulated curves that have one thing each, with the kind that names it."""
    depth, force, time = families.curve(medium, "clean", 0.0, seed)
    top, random, given = force.max(), np.random.default_rng(seed), {**medium.options}
    count, elastic = depth.size, medium is GEL

    def fit(z=depth, F=force, **options):
        return mdr.fit_indentation(medium.tip, z, F, **given | options)

    yield fit(), set()
    yield fit(F=np.where(np.arange(count) % 50, force, np.nan)), {"left out"}
    yield fit(force_noise=0.3 * families.NOISE * top), {"noise"}
    yield fit(z=depth * 1e9, F=force * 1e9), {"units"}
    yield fit(z=-depth), {"units", "errors", "undetermined"}
    # Of noise alone nothing is determined, and no yield is seen in it.
    of_noise = {"no contact", "undetermined", "vague", "errors", "constant"}
    yield fit(F=families.NOISE * top * random.normal(size=count)), of_noise
    if elastic:
        yield fit(q_c=None), {"constant"}
        yield fit(time=time, eta=None), {"constant"}
        drag = 0.05 * top * np.gradient(depth, time) / np.abs(np.gradient(depth, time)).max()
        yield fit(F=force + drag, time=time), {"drag", "unloading"}
        sticky = mdr.Medium(1e4, work_of_adhesion=1e-4)
        pulled = mdr.indent(medium.tip, sticky, depth - 1e-7).force
        pulled = pulled + 4e-3 * top * random.normal(size=count)
        yield fit(F=pulled, work_of_adhesion=None), {"adhesion"}
        yield fit(F=pulled), {"adhesion"}
        yield fit(work_of_adhesion=None), {"adhesion"}
    else:
        shuffled = random.permutation(count)
        for order in (shuffled, slice(None, None, -1)):
            yield fit(z=depth[order], F=force[order]), {"order"}
        noisy = depth + 0.01 * np.ptp(depth) * random.normal(size=count)
        yield fit(z=noisy), {"noise"}
        yield fit(z=depth[: count // 2], F=force[: count // 2]), {"vague", "undetermined"}
        yield fit(hardness=None, q_c=None), {"constant"}
        moments = np.linspace(0.0, 140.0, count)
        pressed = 1e-9 * np.interp(moments, [0, 5, 85, 105, 140], [-20, 0, 600, 600, 400])
        holding = mdr.indent(medium.tip, medium.medium, pressed).force
        holding = holding + 4e-3 * top * random.normal(size=count)
        yield fit(z=pressed + 3e-10 * moments, F=holding, time=moments), {"creep", "drift"}
        other = {"q_c": None, "hardness": 0.0} if medium is GLASS else {"q_c": 0.0, "hardness": None}
        yield fit(**other), {"misfit"}


def of_unloadings(medium, seed):
    """Yields results of Oliver and Pharr for simulated records with one thing each, and its kinds.

    A wrong zero of the depth, a blunt tip or creep lets H/E* or the exponent exceed the elastic one.
    """
    tip, top, random = medium.tip, medium.depths[1], np.random.default_rng(seed)

    def loaded(depth, tip=tip):
        force = mdr.indent(tip, medium.medium, depth).force
        return force + 5e-4 * force.max() * random.normal(size=force.size)

    depth = np.append(np.linspace(0, top, 300), np.linspace(top, 0.3 * top, 200))
    force, time = loaded(depth), np.linspace(0.0, 60.0, 500)
    yield mdr.oliver_pharr(tip, depth, force), {"taken"}
    air = np.append(np.linspace(-0.3 * top, 0, 100, endpoint=False), depth)
    yield mdr.oliver_pharr(tip, air + 0.3 * top, loaded(air)), {"taken"}
    later = int(np.argmax(force > 0.1 * force.max()))
    yield mdr.oliver_pharr(tip, depth[later:] - depth[later], force[later:]), {"zero", "units", "misfit"}
    yield mdr.oliver_pharr(tip, depth, force, time=time), {"taken"}
    yield mdr.oliver_pharr(tip, 1e3 * depth, 1e-3 * force), {"taken", "units"}
    twice = np.append(0.6 * depth, depth)
    yield mdr.oliver_pharr(tip, twice, loaded(twice)), {"taken"}
    spoiled = loaded(twice)
    spoiled[300:500] = spoiled[299] * np.linspace(1, 0.2, 200) ** 0.2
    yield mdr.oliver_pharr(tip, twice, spoiled, cycles=True), {"taken", "left out"}
    stiffness = np.array(mdr.indent(tip, medium.medium, depth).stiffness)
    stiffness[::50] = np.nan
    right = {"taken", "left out"}
    if medium is GEL:
        yield mdr.oliver_pharr(tip, depth, force, stiffness=stiffness), right
        return
    moments, z, F = record(0.4, "viscous")
    yield mdr.oliver_pharr(tip, z, F), {"creep", "misfit"}
    moments, z, F = record(0.2, "viscous")
    yield mdr.oliver_pharr(tip, z, F, time=moments), {"taken", "creep"}
    # A new tip and a worn one, as ideal: right where the hardness is off by more than 5 %.
    for radius in (50e-9, 200e-9):
        real = mdr.RoundedCone(tip_radius=radius, slope=tip.slope)
        for z in (depth, depth / 5):
            state, F = mdr.indent(real, medium.medium, z), loaded(z, real)
            for stiffness in (None, state.stiffness):
                found, true = (mdr.oliver_pharr(each, z, F, stiffness=stiffness) for each in (tip, real))
                off = np.nanmax(np.divide(found.hardness, true.hardness)) > 1.05
                yield found, {"taken", "left out"} | ({"tip", "misfit"} if off else set())


def beside_fits():
    """Yields files, tips and fits of hardnesses with one thing each, and the kinds that name it."""
    yield from of_files()
    z = np.append(np.linspace(-10e-9, 60e-9, 60), np.linspace(60e-9, 0, 60))
    F = mdr.indent(mdr.Cone(0.3), mdr.Medium(10e9), z).force
    map_of_two = mdr.fit_indentation(mdr.Cone(0.3), [z, z], [F, 0 * F], q_c=np.inf, invalid="nan")
    yield map_of_two, {"invalid"}
    for coefficients in ([24.5, 0.0, 50.0], [24.5, 200.0, -300.0]):
        yield mdr.Sampled.from_area_function(coefficients, 1e-6, unit="nm"), {"changed"}
    cone, media = (
        mdr.Cone(0.3),
        (mdr.Medium(10e9, hardness=0.5e9), mdr.Medium(10e9, q_c=20.0, hardness=0.3e9)),
    )
    depths = np.array([20e-9, 40e-9, 80e-9, 160e-9])
    for medium in media:
        state = mdr.indent(cone, medium, depths)
        data = state.mean_pressure, state.contact_radius
        few = tuple(each[:1] for each in data)
        above = np.append(data[0], 2e9), np.append(data[1], 1e-9)
        yield mdr.fit_hardness(cone, *few, E_star=10e9), {"errors"}
        yield mdr.fit_hardness(cone, *above, E_star=10e9, hardness=None), {"left out", "misfit"}
        yield mdr.fit_hardness(cone, *data, E_star=10e9, f_c=None), {"misfit"}
        both = mdr.fit_hardness(
            cone, data[0] * [1, 1.1, 0.9, 1], data[1], E_star=10e9, hardness=None, q_c=None
        )
        yield both, {"constant"}


def of_files():
    """Yields curves of files with one thing each, and the kinds that name it."""
    depth = np.append(np.arange(20.0), np.arange(18.0, 4.0, -1.0))
    rows = [[f"{h:g}", f"{h**2:g}", f"{t:g}"] for t, h in enumerate(depth)]

    def text(lines, head="Depth (nm);Load (mN);Time (s)"):
        return "\n".join([head, *(";".join(line) for line in lines)])

    files = (
        (text(rows), {}, set()),
        (text([*rows[:5], ["", "3", "4"], *rows[5:]]), {}, {"left out"}),
        (text([["-" + line[0], *line[1:]] for line in rows]), {}, {"changed"}),
        (text([[*line[:2], "7" if k % 9 else "1"] for k, line in enumerate(rows)]), {}, {"left out"}),
        (
            text(rows, "Spring constant: 50 N/m\nDepth (nm);Load (mN);Time (s)"),
            {"columns": {"piezo": (0, "nm"), "force": (1, "mN")}},
            {"taken"},
        ),
    )
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "run.csv"
        for content, given, right in files:
            path.write_text(content, encoding="utf-8")
            yield mdr.read_curve(path, **given), right
        curve = mdr.read_curve(path, columns={"depth": (0, "nm"), "force": (1, "mN")})
        yield curve.minus_frame(1e-9), {"changed"}
        path.write_text("\n".join(f"Test {k}\n{text(rows)}" for k in (1, 2)), encoding="utf-8")
        yield mdr.read_curve(path, 1), {"taken"}
    # Files of AFM instruments are read by an optional package.
    if find_spec("afmformats"):
        yield _without_stiffness(), {"deflection"}


def _without_stiffness():
    """A curve of an AFM whose file has no stiffness of the cantilever, as `afmformats` reads it."""
    import afmformats

    depth = 1e-6 * np.append(np.linspace(-1.0, 0.6, 60), np.linspace(0.6, -1.0, 40))
    force = mdr.indent(mdr.Paraboloid(5e-6), mdr.Medium(20e3), depth).force
    data = {"force": force, "height (measured)": -depth - force / 0.05}
    data["segment"] = np.repeat([0, 1], [60, 40]).astype(np.uint8)
    known = {"enum": 0, "path": "made", "imaging mode": "force-distance"}
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "run.tab"
        afmformats.mod_force_distance.AFMForceDistance(data, known).export_data(path, fmt="tab")
        return mdr.read_curve(path)


def record_of(name):
    """Depth (m), force (N) and time (s) of a measured curve that yields."""
    path = DATA / f"{name}.csv" if name != "silica" else mdr.example("silica.csv")
    data = np.genfromtxt(path, delimiter=",", names=True)
    return 1e-9 * data["depth_nm"], 1e-3 * data["force_mN"], data["time_s"]


def of_measured():
    """Yields the kinds of remarks on measured curves, and those that are known to be right.

    Glass and quartz are of class (a), none of the four is elastic, steel has a noisy depth and NiAl a
    pop-in; approach and retract of the gels differ, as these stick on the retract, and the curve of a cell
    is nearly noise. All four have a hold before the unloading, none begins in the air, and the contact of
    steel is the one below 200 nm.
    """
    for name in AFM:
        for tip in HERTZ.values():
            for segment in ("approach", "retract"):
                fit = mdr.fit_indentation(tip, *measured(name, segment), q_c=np.inf, baseline=None)
                right = {"misfit", "vague", "undetermined", "tilt"}
                yield kinds(fit), right | ({"adhesion"} if segment == "retract" else set())
    for name in AFM[:2]:
        yield kinds(fit_of(name)), {"drag", "misfit", "unloading", "tilt"}
    for name in BOUNDS:
        for options in (
            {"hardness": None},
            {},
            {"f_c": None},
            {"q_c": np.inf},
            {"q_c": None, "hardness": None},
        ):
            fit = mdr.fit_indentation(BERKOVICH, *real(name), **options)
            wrong_class = "hardness" not in options or name in ("nial", "steel")
            right = {"constant", "errors", "vague"} | ({"misfit", "unloading"} if wrong_class else set())
            yield kinds(fit), right | ({"noise"} if name == "steel" else set())
        depth, force, time = record_of(name)
        for times in (None, time):
            result = mdr.oliver_pharr(BERKOVICH, depth, force, time=times)
            right = {"taken", "left out"}
            # The correction of steel is 10 % of E*.
            yield kinds(result), right | ({"tip", "creep"} if name == "steel" else set())


def cases(seeds):
    """Yields "made" or "measured", the kinds of remarks on each case, and those that are right."""
    for made, true in of_families(seeds):
        yield "made", made, true
    for medium in families.KINDS.values():
        for seed in range(seeds):
            for fit, true in of_a_kind(medium, seed):
                covered = "E_star" in fit.standard_errors and families.covered(medium, fit)
                yield "made", kinds(fit), true if covered else kinds(fit)
            # Each record ends above zero force, where quantities are extrapolated.
            for result, true in of_unloadings(medium, seed):
                yield "made", kinds(result), true | {"left out"}
    for result, true in beside_fits():
        yield "made", kinds(result), true
    for made, true in of_measured():
        yield "measured", made, true


def table(seeds=6):
    """The table as Markdown: of each kind how often it is made, and how often it is right."""
    counts, right, curves = defaultdict(Counter), defaultdict(Counter), Counter()
    for source, made, true in cases(seeds):
        counts[source].update(made)
        right[source].update(made & true)
        curves[source] += 1
    rows = [
        f"| remark | {curves['made']} simulated cases | {curves['measured']} of measured curves |",
        "| --- | --- | --- |",
    ]
    for kind in (kind for kind in KINDS if kind != OF_ERRORS):
        cells = []
        for source in ("made", "measured"):
            number = counts[source][kind]
            share = f", {100 * right[source][kind] / number:.0f} %" if number else ""
            cells.append(f"{number}{share}")
        rows.append(f"| {kind} | {' | '.join(cells)} |")
    return "\n".join(rows)


if __name__ == "__main__":
    print(table())
