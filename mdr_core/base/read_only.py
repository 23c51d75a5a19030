"""Read-only arguments for users' functions, because the caller still needs these arrays."""

import inspect
from functools import wraps

import numpy as np

from .errors import InvalidArgument

_REMEDY = (
    "return new values, for example by numpy.where or numpy.maximum, or begin with a copy of the argument"
)


def guard_methods(kind, names):
    """Give read-only arrays to the methods with these names that a user wrote for a class."""
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
    """Wrap a user's function: its arrays are read-only, and a clear error is raised if it changes them."""

    @wraps(function)
    def guarded(*given, **named):
        try:
            result = function(*map(_view, given), **named)
        except ValueError as error:
            if "buffer source" in str(error):
                # Compiled code of SciPy before 1.13 needs a writable array, but does not write to it.
                return function(*map(_copy, given), **named)
            if "read-only" not in str(error) or isinstance(error, InvalidArgument):
                raise
            what = f"changes its argument in place ({error})"
            raise InvalidArgument(
                f"{name} {what}: {_REMEDY}", name, given[-1], what, "", _REMEDY
            ) from error
        # This may be the argument or a part of it. The caller may change the returned array.
        return result.copy() if isinstance(result, np.ndarray) and not result.flags.writeable else result

    return guarded


def _view(value):
    """Return a read-only view of an array, and any other value unchanged."""
    if not isinstance(value, np.ndarray):
        return value
    value = value.view()
    value.setflags(write=False)
    return value


def _copy(value):
    return value.copy() if isinstance(value, np.ndarray) else value
