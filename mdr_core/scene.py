"""Whole calculations as values: the scene and the drives of its body.

An example:

>>> from mdr_core import Cone, Medium, scene
>>> state = scene.Scene(Cone(slope=1.0), Medium(E_star=1.0), scene.DepthPath(1.0)).solve()
>>> print(round(state.force, 6))  # 2/π
0.63662
"""

from .scenes.drives import DepthPath, ForcePath, FreeImpact, FreeObliqueImpact
from .scenes.scene import Scene

__all__ = ["DepthPath", "ForcePath", "FreeImpact", "FreeObliqueImpact", "Scene"]
