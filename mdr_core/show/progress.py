"""Progress of long calculations, shown by tqdm where it is installed."""

import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from ..solver.numerics.blocks import chunks

#: Time (s) before a bar appears.
_DELAY = 2.0


@contextmanager
def progress(size: int, unit: str) -> Iterator[Callable[[int], object]]:
    """A function to call with the number of further entries that are done; it shows their number of `size`.

    Nothing is shown without tqdm, where the error output is no terminal (a pipe or a file), and in the
    threads of dask, which has a bar of its own. `unit` is the word for what is counted, in the plural.
    """
    try:
        from tqdm.auto import tqdm
    except ImportError:
        yield lambda count: None
        return
    # None hides the bar where the output is no terminal.
    hidden = None if threading.current_thread() is threading.main_thread() else True
    with tqdm(total=size, unit=f" {unit}", delay=_DELAY, disable=hidden, leave=False) as bar:
        yield bar.update


def tracked_chunks(size: int, most: int, unit: str) -> Iterator[slice]:
    """Yields slices of at most `most` of `size` rows, with the progress of what is done with them."""
    with progress(size, unit) as done:
        for rows in chunks(size, most):
            yield rows
            done(min(rows.stop, size) - rows.start)
