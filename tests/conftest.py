"""Which cases of a parametrisation are run."""

import zlib

import mdr_core as mdr

#: Cases of one test over shapes that are run without --full.
CASES = 3


def pytest_addoption(parser):
    group = parser.getgroup("extent", "how much is run (otherwise three cases of each test over shapes)")
    group.addoption("--full", action="store_true", help="all cases, as before a release")
    group.addoption(
        "--quick", action="store_true", help="at most two cases of each parametrisation, nothing slow"
    )


def pytest_configure(config):
    config.addinivalue_line("markers", "slow: takes more than two seconds; left out by --quick")
    config.addinivalue_line(
        "markers", "full: is run with --full alone, because others notice nearly all it notices"
    )
    config.addinivalue_line("markers", "few(n): so many cases of the test are run without --full")


def pytest_collection_modifyitems(config, items):
    if config.option.full:
        return
    tests = {}
    for item in items:
        tests.setdefault(item.nodeid.partition("[")[0], []).append(item)
    kept = set()
    for name, cases in tests.items():
        cases = [case for case in cases if not _left_out(case, config.option.quick)]
        most = _most(cases, config.option.quick)
        kept.update(_spread(name, cases, most) if len(cases) > most else cases)
    config.hook.pytest_deselected(items=[item for item in items if item not in kept])
    items[:] = [item for item in items if item in kept]


def _left_out(item, quick):
    return item.get_closest_marker("full") or (quick and item.get_closest_marker("slow"))


def _most(cases, quick):
    """The largest number of cases of one test that are run."""
    few = cases[0].get_closest_marker("few") if cases else None
    if quick:
        return min(2, few.args[0]) if few else 2
    if few:
        return few.args[0]
    return CASES if any(map(_is_over_shapes, cases)) else len(cases)


def _parameters(item):
    return item.callspec.params if hasattr(item, "callspec") else {}


def _is_over_shapes(item):
    # Classes have capitals; a name is imported when it is asked for.
    names = {value for value in dir(mdr) if value[0].isupper()}
    return any(
        isinstance(value, mdr.Profile) or getattr(value, "__name__", None) in names or key == "shape"
        for key, value in _parameters(item).items()
    )


def _spread(name, cases, most):
    """So many cases that share as few parameters as possible, others for each test."""
    # A hash that is the same in each process and version.
    first = zlib.crc32(name.encode()) % len(cases)
    left = cases[first:] + cases[:first]
    chosen = [left.pop(0)]
    while len(chosen) < most:
        used = [set(case.callspec._idlist) for case in chosen]
        left.sort(key=lambda case: sum(len(ids & set(case.callspec._idlist)) for ids in used))
        chosen.append(left.pop(0))
    return chosen
