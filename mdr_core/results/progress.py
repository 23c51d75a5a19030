"""Progress of long calculations, shown by tqdm where it is installed."""

import threading
from collections.abc import Iterator

from .._numeric import chunks

#: Time (s) before a bar appears.
_DELAY = 2.0


def tracked_chunks(size: int, most: int, unit: str) -> Iterator[slice]:
    """Yields slices of at most `most` of `size` rows, and shows how many rows are done.

    Nothing is shown without tqdm, where the error output is no terminal (a pipe or a file), and in the
    threads of dask, which has a bar of its own. `unit` is the word for what is counted, in the plural.
    """
    try:
        from tqdm.auto import tqdm
    except ImportError:
        yield from chunks(size, most)
        return
    # None hides the bar where the output is no terminal.
    hidden = None if threading.current_thread() is threading.main_thread() else True
    with tqdm(total=size, unit=f" {unit}", delay=_DELAY, disable=hidden, leave=False) as bar:
        for rows in chunks(size, most):
            yield rows
            bar.update(min(rows.stop, size) - rows.start)
