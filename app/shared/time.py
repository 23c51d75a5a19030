"""The axis of time of the plots over time, and the line at the present time."""

import numpy as np

from mdr_core.show.quantities import QUANTITIES

from ..plot import Along, View

T = Along(QUANTITIES["time"].title, "time", lambda course: (0.0, float(course.motion.time[-1])))


def line_at_time(view: View, i: int, up: Along) -> tuple:
    """Vertical line at the time of state i, over the whole axis `up`."""
    return view.course.motion.time[[i, i]], np.array([view.axis(up).start, view.end(up)])
