"""How often each remark of a fit is made, and how often it is right, on made and on measured curves.

    python -m tests.benchmarks.remarks

prints the table, which is a part of assets/fits.md.
"""

from collections import Counter, defaultdict

import numpy as np

import mdr_core as mdr
from mdr_core.numerics.results import KINDS

from ..fit import families
from ..fit.test_fit import AFM, HERTZ, measured
from ..fit.test_fit_in_time import fit_of
from ..fit.test_fit_of_classes import BERKOVICH, BOUNDS, real

GEL, GLASS, METAL = families.KINDS.values()
#: Kinds of remarks that name what a family of made curves has.
NAMES = {
    "tilt": {"tilt", "misfit"},
    "retract": {"unloading", "misfit"},
    "drift": {"drift", "unloading", "rest", "misfit"},
    "creep": {"drift", "unloading", "misfit", "rest"},
    "correlated noise": {"blocks"},
    "outliers": {"outliers"},
    "few samples": {"few", "undetermined", "second minimum", "vague"},
}
#: Remarks on correlated residuals are right where these are not noise.
CORRELATED = {"tilt", "retract", "drift", "creep", "correlated noise"}


def kinds(fit, i=0):
    return {remark.kind for remark in (fit[i] if fit.shape else fit).remarks}


def of_families(seeds):
    """Yields the kinds of remarks on each curve of the families, and which are right."""
    for medium in families.KINDS.values():
        for family, sizes in families.FAMILIES.items():
            for size in sizes:
                fit = families.fits(medium, family, size, range(seeds))
                covered = families.covered(medium, fit)
                for i in range(seeds):
                    made = kinds(fit, i)
                    right = made & NAMES.get(family, set())
                    right |= made & {"blocks"} if family in CORRELATED else set()
                    yield made, right if covered[i] else made


def of_a_kind(medium, seed):
    """Yields the remarks on made curves that have one thing each, with the kind that names it."""
    depth, force, time = families.curve(medium, "clean", 0.0, seed)
    top, random, given = force.max(), np.random.default_rng(seed), {**medium.options}
    count, elastic = depth.size, medium is GEL

    def fit(z=depth, F=force, **options):
        return mdr.fit_indentation(medium.tip, z, F, **given | options)

    yield fit(), set()
    yield fit(F=np.where(np.arange(count) % 50, force, np.nan)), {"missing"}
    yield fit(force_noise=0.3 * families.NOISE * top), {"noisy"}
    yield fit(z=depth * 1e9, F=force * 1e9), {"units"}
    yield fit(z=-depth), {"units"}
    yield fit(F=families.NOISE * top * random.normal(size=count)), {"no contact", "undetermined", "vague"}
    if elastic:
        yield fit(q_c=None), {"elastic"}
        yield fit(time=time, eta=None), {"inviscid"}
        drag = 0.05 * top * np.gradient(depth, time) / np.abs(np.gradient(depth, time)).max()
        yield fit(F=force + drag, time=time), {"drag", "unloading"}
        sticky = mdr.Medium(1e4, work_of_adhesion=1e-4)
        pulled = mdr.indent(medium.tip, sticky, depth - 1e-7).force
        pulled = pulled + 4e-3 * top * random.normal(size=count)
        yield fit(F=pulled, work_of_adhesion=None), {"contact"}
        yield fit(work_of_adhesion=None), {"adhesion", "contact"}
    else:
        noisy = depth + 0.01 * np.ptp(depth) * random.normal(size=count)
        yield fit(z=noisy), {"jitter"}
        yield fit(z=depth[: count // 2], F=force[: count // 2]), {"loading"}
        yield fit(hardness=None, q_c=None), {"constants"}
        moments = np.linspace(0.0, 140.0, count)
        pressed = 1e-9 * np.interp(moments, [0, 5, 85, 105, 140], [-20, 0, 600, 600, 400])
        holding = mdr.indent(medium.tip, medium.medium, pressed).force
        holding = holding + 4e-3 * top * random.normal(size=count)
        yield fit(z=pressed + 1e-10 * moments, F=holding, time=moments), {"rest", "drift"}
        other = {"q_c": None, "hardness": 0.0} if medium is GLASS else {"q_c": 0.0, "hardness": None}
        yield fit(**other), {"misfit"}


def of_measured():
    """Yields the kinds of remarks on measured curves, and those that are known to be right.

    Glass and quartz are of class (a), none of the four is elastic, steel has a noisy depth and NiAl a
    pop-in; approach and retract of the gels differ, and the curve of a cell is nearly noise.
    """
    for name in AFM:
        for tip in HERTZ.values():
            for segment in ("approach", "retract"):
                fit = mdr.fit_indentation(tip, *measured(name, segment), q_c=np.inf, baseline=None)
                yield kinds(fit), {"misfit", "vague", "second minimum", "undetermined", "tilt"}
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
            right = {"constants", "blocks", "vague"} | ({"misfit", "unloading"} if wrong_class else set())
            yield kinds(fit), right | ({"jitter"} if name == "steel" else set())


def table(seeds=20):
    """The table as Markdown: of each kind how often it is made, and how often it is right."""
    counts, right, curves = defaultdict(Counter), defaultdict(Counter), Counter()
    for made, true in of_families(seeds):
        counts["made"].update(made)
        right["made"].update(true)
        curves["made"] += 1
    for medium in families.KINDS.values():
        for seed in range(seeds):
            for fit, true in of_a_kind(medium, seed):
                made = kinds(fit)
                covered = "E_star" in fit.standard_errors and families.covered(medium, fit)
                counts["made"].update(made)
                right["made"].update(made & true if covered else made)
                curves["made"] += 1
    for made, true in of_measured():
        counts["measured"].update(made)
        right["measured"].update(made & true)
        curves["measured"] += 1
    rows = [
        f"| remark | {curves['made']} made fits | {curves['measured']} fits of measured curves |",
        "| --- | --- | --- |",
    ]
    for kind in KINDS:
        cells = []
        for source in ("made", "measured"):
            number = counts[source][kind]
            share = f", {100 * right[source][kind] / number:.0f} %" if number else ""
            cells.append(f"{number}{share}")
        rows.append(f"| {kind} | {' | '.join(cells)} |")
    return "\n".join(rows)


if __name__ == "__main__":
    print(table())
