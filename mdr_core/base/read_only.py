"""Functions that users write get arrays that they cannot change: the caller goes on to use them."""

import inspect
from functools import wraps

import numpy as np

from .errors import InvalidArgument

_REMEDY = "return new values, as by numpy.where or numpy.maximum, or begin with a copy of the argument"


def guard_methods(kind, names):
    """Make the methods of these names that a user wrote for a class take arrays that they cannot change."""
    for name in names:
        method = inspect.getattr_static(kind, name, None)
        bare = method.__func__ if isinstance(method, staticmethod) else method
        own = inspect.isfunction(bare) and not (bare.__module__ or "").startswith(
            f"{__package__.partition('.')[0]}."
        )
        if own and not hasattr(bare, "__wrapped__"):
            guarded = read_only(bare, f"{kind.__name__}.{name}")
            setattr(kind, name, guarded if bare is method else staticmethod(guarded))


def read_only(function, name):
    """A user's function with arrays that it cannot change, refused in words if it tries."""

    @wraps(function)
    def guarded(*given, **named):
        try:
            result = function(*map(_view, given), **named)
        except ValueError as error:
            if "buffer source" in str(error):
                # Compiled code of SciPy before 1.13 wants an array that it may write to, and does not.
                return function(*map(_copy, given), **named)
            if "read-only" not in str(error) or isinstance(error, InvalidArgument):
                raise
            what = f"changes its argument in place ({error})"
            raise InvalidArgument(
                f"{name} {what}: {_REMEDY}", name, given[-1], what, "", _REMEDY
            ) from error
        # The argument itself, or a part of it: what is returned may be changed.
        return result.copy() if isinstance(result, np.ndarray) and not result.flags.writeable else result

    return guarded


def _view(value):
    """An array without the right to change it; other values as they are."""
    if not isinstance(value, np.ndarray):
        return value
    value = value.view()
    value.setflags(write=False)
    return value


def _copy(value):
    return value.copy() if isinstance(value, np.ndarray) else value
