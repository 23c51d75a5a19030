"""What the project has set itself, and what was measured, always at equal or smaller error."""

import numpy as np


def bars(records, million):
    """One record for each bar: what, wanted, measured, and against what."""
    return [_field(records), *_transforms(records), _digits(records), *_impacts(records, million)]


def _bar(what, wanted, measured, against):
    return {
        "what": what,
        "wanted": wanted,
        "measured": measured,
        "met": measured is not None and measured >= wanted,
        "against": against,
    }


def _field(records):
    grid = [
        r
        for r in records
        if r["title"].startswith("elastic cone, field") and r["setting"].startswith("128²")
    ]
    peers = [r for r in grid if not r["family"].startswith("mdr_core")]
    own = [r for r in grid if r["family"] == "mdr_core"]
    what = "field of a cone on 128² points, times faster than boundary elements"
    if not peers or not own:
        return _bar(what, 250, None, "no peer was measured")
    best = min(peers, key=lambda r: r["seconds"])
    return _bar(what, 250, best["seconds"] / own[0]["seconds"], f"{best['family']} {best['setting']}")


def _sampled(records, title):
    """Own transforms of samples of one problem, by family."""
    kinds = "even samples", "graded samples", "cubic", "kink known"
    sampled = [f"mdr_core, {kind}" for kind in kinds]
    own = [r for r in records if r["title"] == title and r["family"] in sampled]
    return [[r for r in own if r["family"] == family] for family in sorted({r["family"] for r in own})]


def _transforms(records):
    """Each cold PyAbel method at N = 1001 against the own curve, read off at its error."""
    result = []
    for r in records:
        if r["setting"] != "N = 1001, cold":
            continue
        own = min(_time_at(curve, r["error"]) for curve in _sampled(records, r["title"]))
        what = f"transform of 1001 samples, cold ({r['title']}), times faster at equal error"
        result.append(_bar(what, 5, r["seconds"] / own, f"{r['family']}, error {r['error']:.0e}"))
    return result


def _time_at(curve, error):
    """Time (s) of a family of methods at an error, between its settings by logarithms."""
    curve = sorted(curve, key=lambda r: r["seconds"])
    if curve[0]["error"] <= error:
        return curve[0]["seconds"]
    if curve[-1]["error"] > error:
        return float("inf")
    errors, times = (np.log([r[key] for r in curve]) for key in ("error", "seconds"))
    return float(np.exp(np.interp(-np.log(error), -np.minimum.accumulate(errors), times)))


def _digits(records):
    hard = [r for r in records if r["question"] == "transform" and r["case"] == "hard"]
    own = [r["error"] for r in hard if r["family"].endswith("kink known") and r["setting"] == "N = 1001"]
    peers = [r for r in hard if r["setting"] == "N = 1001, cold"]
    what = "transform of a load with a known kink, N = 1001, digits more"
    if not peers or not own:
        return _bar(what, 10, None, "no peer was measured")
    best = min(peers, key=lambda r: r["error"])
    return _bar(what, 10, float(np.log10(best["error"] / own[0])), f"{best['family']}")


def _impacts(records, million):
    """The loop that is fastest, at whatever error; per impact as measured, times a million."""
    for quantity in ("restitution", "contact time"):
        loops = [
            r
            for r in records
            if r["question"] == quantity and r["case"] == "hard" and r["family"].startswith("solve_ivp")
        ]
        best = min(loops, key=lambda r: r["seconds"])
        ratio = best["seconds"] / best["items"] * 10**6 / million[quantity.replace(" ", "_")]
        yield _bar(
            f"{quantity} of a million impacts, times faster than a loop of solve_ivp",
            1e4,
            ratio,
            f"{best['family']} {best['setting']}, error {best['error']:.0e}",
        )
