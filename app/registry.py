"""Registries: what there is by its name, on the page and of extras."""

from typing import Any, ClassVar


class Registry(dict[Any, Any]):
    """A dict that is closed once all extras are in it, and from then on the same for every session."""

    _all: ClassVar[list["Registry"]] = []

    def __init__(self, *given: Any):
        super().__init__(*given)
        self._closed = False
        self._all.append(self)

    @classmethod
    def close_all(cls) -> None:
        """Close all that there are."""
        for each in cls._all:
            each._closed = True

    def _changing(self) -> None:
        if self._closed:
            raise TypeError("a registry does not change once all extras are in it")

    def __setitem__(self, key: Any, value: Any) -> None:
        self._changing()
        super().__setitem__(key, value)

    def __delitem__(self, key: Any) -> None:
        self._changing()
        super().__delitem__(key)

    def update(self, *given: Any, **named: Any) -> None:
        self._changing()
        super().update(*given, **named)

    def setdefault(self, key: Any, default: Any = None) -> Any:
        self._changing()
        return super().setdefault(key, default)

    def pop(self, *given: Any) -> Any:
        self._changing()
        return super().pop(*given)

    def popitem(self) -> tuple[Any, Any]:
        self._changing()
        return super().popitem()

    def clear(self) -> None:
        self._changing()
        super().clear()
