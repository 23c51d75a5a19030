"""Where a motion ends, by SciPy's steps, as accurate as the steps themselves."""

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import newton


def until(rate, start, ends, longest, **options):
    """Number of the first of some ends, functions of time and state that cross 0; its time, its state.

    SciPy finds an event on polynomials between its steps, which are less accurate than the steps: by 10⁻⁶
    for short steps of a stiff motion. So the time is found by states that are integrated from the step
    before. `start` is a time with its state, and `longest` a time until when an end is reached.
    """
    for end in ends:
        end.terminal = True
    steps = solve_ivp(rate, (start[0], longest), start[1], "DOP853", events=ends, **options)
    (which,) = (k for k, times in enumerate(steps.t_events) if times.size)
    near = steps.t[-1]
    # Steps are short where the rate has a kink at the end.
    last = np.searchsorted(steps.t, near - 1e-6 * (near - start[0])) - 1
    before, known = steps.t[last], steps.y[:, last]
    options["first_step"] = None

    def state_at(time):
        return solve_ivp(rate, (before, time), known, "DOP853", **options).y[:, -1]

    def value(time):
        return ends[which](time, state_at(time))

    time = newton(value, near, x1=near - 1e-3 * (near - before), tol=1e-13 * near)
    return which, time, state_at(time)
