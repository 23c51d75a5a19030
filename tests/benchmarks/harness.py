"""Problems × methods: what a benchmark is made of, and how its time is taken."""

import gc
import math
from collections.abc import Callable
from dataclasses import dataclass
from statistics import median
from time import perf_counter

#: Settings of quadratures and chains.
TOLERANCES, ELEMENTS = (1e-3, 1e-6, 1e-9), (100, 1000, 10_000)
#: A timed stretch lasts at least this long (s); shorter calls are repeated.
_SHORTEST = 2e-3
#: A call that takes longer (s) needs no warming up.
_LONG = 1.0


@dataclass(frozen=True)
class Method:
    """One way to an answer.

    `prepare` sets everything up, untimed, and gives the call to be timed. Methods of one `family` differ in
    one `setting`; `items` says how many of the problem's items the call treats, if not all.
    """

    family: str
    setting: str
    prepare: Callable
    items: int | None = None


def ladder(family, setting, values, run, items=None):
    """Methods that differ in one number: `setting` formats it, `run` takes it."""
    return [
        Method(family, setting.format(value), lambda value=value: lambda: run(value), items=items)
        for value in values
    ]


@dataclass(frozen=True)
class Problem:
    """A question with known answer ("pressure", and the state in words), and the methods that answer it.

    Times are for all of its `items`; `error` is that of a method's result against 50 digits.
    """

    question: str
    title: str
    items: int
    error: Callable
    methods: tuple


def seconds(call, runs=5):
    """Median time (s) of a call, after one that is not counted."""
    call()
    return median(_once(call) for _ in range(runs))


def _once(call, repeats=1):
    start = perf_counter()
    for _ in range(repeats):
        call()
    return (perf_counter() - start) / repeats


def _repeats(call):
    """How often a call that has been made before has to be made to be timed."""
    return max(1, math.ceil(_SHORTEST / _once(call)))


def measure(problem, rounds=5, patience=10.0):
    """One record for each method: error and median time.

    The methods take turns, round by round, so that all of them meet the same disturbances; a method
    that has used up its patience (s) drops out after the first rounds.
    """
    calls, errors, repeats, times = [method.prepare() for method in problem.methods], [], [], []
    for call in calls:
        start = perf_counter()
        result = call()
        first = perf_counter() - start
        errors.append(problem.error(result))
        long = first > _LONG
        times.append([first] if long else [])
        repeats.append(1 if long else _repeats(call))
    gc.collect()
    gc.disable()
    try:
        for _ in range(rounds):
            for call, repeat, taken in zip(calls, repeats, times, strict=True):
                if sum(taken) * repeat > patience:
                    continue
                if repeat > 1:
                    # What came before has emptied the caches.
                    call()
                taken.append(_once(call, repeat))
    finally:
        gc.enable()
    return [_record(problem, *each) for each in zip(problem.methods, errors, times, strict=True)]


def _record(problem, method, error, taken):
    scale = problem.items / (method.items or problem.items)
    return {
        "question": problem.question,
        "title": problem.title,
        "items": problem.items,
        "family": method.family,
        "setting": method.setting,
        "error": error,
        "seconds": scale * median(taken),
    }
