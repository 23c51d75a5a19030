"""The measured examples of the page: a click away, with tip and sample told."""

from dataclasses import dataclass

from ..quantities import ASSETS
from .setting import Setting


@dataclass(frozen=True)
class Example:
    """A file of the assets, the name that is shown, and the setting that it comes with."""

    path: str
    name: str
    setting: Setting

    def read(self) -> bytes:
        """What is in the file."""
        return (ASSETS / self.path).read_bytes()


def _silica() -> Setting:
    """Fused silica under a diamond Berkovich tip; depths of this file count from first contact."""
    asked = Setting(tip="berkovich", poisson=0.17, tip_modulus=1141e9, tip_poisson=0.07)
    asked = asked.with_medium("constant")
    return asked.replace(held=asked.held | {"contact_point": 0.0})


def _gel() -> Setting:
    """A gel under a colloid of nominal radius."""
    return Setting(tip="paraboloid", radius=10e-6, poisson=0.5).with_medium("gel")


#: By their names; files are named so in links.
EXAMPLES = {
    "silica": Example("silica.csv", "Fused silica, Berkovich tip.csv", _silica()),
    "gel": Example("gel.csv", "Gel, AFM, colloid of 10 µm.csv", _gel()),
}


def example_named(file: str) -> str:
    """Name of the example with a file that a link asks for, or nothing."""
    return next((name for name, each in EXAMPLES.items() if each.name == file), "")
