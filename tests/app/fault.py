"""Setup script (panel serve app --setup tests/app/fault.py) of a server whose solver fails at one depth."""

import mdr_core as mdr

DEPTH = 13e-9
_solve = mdr.Scene.solve


def _failing(scene, model=None):
    if isinstance(scene.drive, mdr.scene.DepthPath) and abs(scene.drive.depth - DEPTH) < 1e-6 * DEPTH:
        raise ArithmeticError("made to fail")
    return _solve(scene, model)


mdr.Scene.solve = _failing
