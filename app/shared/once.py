"""Places of rows that are found once for a view, however many of its states are drawn."""

from collections.abc import Callable

from ..plot import View


def once(places: Callable[[View], dict]) -> Callable[[View, int], dict]:
    """Places in every state, kept with the view, of rows that stay while a scene is played."""

    def kept(view: View, i: int) -> dict:
        if places not in view.computed:
            view.computed[places] = places(view)
        return view.computed[places]

    return kept
