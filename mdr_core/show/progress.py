"""Progress of long calculations, shown by tqdm if it is installed."""

import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from ..solver.numerics.blocks import chunks

#: Time (s) before a bar appears.
_DELAY = 2.0


@contextmanager
def progress(size: int, unit: str) -> Iterator[Callable[[int], object]]:
    """Show a progress bar for `size` entries; yield a function to call with the number of new entries.

    No bar appears without tqdm, or if the error output is not a terminal but a pipe or a file. Threads of
    dask show none either, because dask has its own bar. `unit` is the plural name of the entries.
    """
    try:
        from tqdm.auto import tqdm
    except ImportError:
        yield lambda count: None
        return
    # None hides the bar if the output is not a terminal.
    hidden = None if threading.current_thread() is threading.main_thread() else True
    with tqdm(total=size, unit=f" {unit}", delay=_DELAY, disable=hidden, leave=False) as bar:
        yield bar.update


def tracked_chunks(size: int, most: int, unit: str) -> Iterator[slice]:
    """Yield slices of at most `most` of `size` rows, and show the progress."""
    with progress(size, unit) as done:
        for rows in chunks(size, most):
            yield rows
            done(min(rows.stop, size) - rows.start)
