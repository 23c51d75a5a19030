"""Scenes survive JSON exactly, and nothing else passes for one."""

import json

import numpy as np
import pytest

import mdr_core as mdr

from .shapes import SHAPES, name

SCENE = mdr.Scene(mdr.Cone(0.1), mdr.Medium(1e9, 1 / 3), mdr.DepthPath((0.0, 1e-9, 1 / 7)))


@pytest.mark.parametrize(
    "drive", [mdr.DepthPath(1e-9), mdr.DepthPath([1e-9, 0]), mdr.FreeImpact(1e-3, 0.1)]
)
@pytest.mark.parametrize("medium", [mdr.Medium(1e9), mdr.Medium(1 / 3, 0.1, 1e-300)])
@pytest.mark.parametrize("shape", SHAPES, ids=name)
def test_round_trip_is_exact(shape, medium, drive):
    scene = mdr.Scene(shape, medium, drive)
    assert mdr.Scene.from_json(scene.to_json()) == scene


def test_solve_gives_what_the_functions_give():
    path = SCENE.solve()
    np.testing.assert_array_equal(
        path.force, mdr.indent(SCENE.profile, SCENE.medium, SCENE.drive.depth).force
    )
    hit = mdr.Scene(SCENE.profile, SCENE.medium, mdr.FreeImpact(1e-3, 0.1)).solve()
    assert hit.restitution == mdr.impact(SCENE.profile, SCENE.medium, 1e-3, 0.1).restitution


def changed(**changes):
    data = json.loads(SCENE.to_json())
    for path, value in changes.items():
        *parents, last = path.split("__")
        target = data
        for parent in parents:
            target = target[parent]
        if value is None:
            del target[last]
        else:
            target[last] = value
    return json.dumps(data)


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("", "scene: Expecting value"),
        ("[1, 2", "scene: "),
        ("null", "must have exactly"),
        ("[" * 100_000, "nested too deeply"),
        ('{"format": 1, "format": 1}', "the same key stands twice"),
        (changed(version=2), "version 2 cannot be read"),
        (changed(note="hi"), "found .*note"),
        (changed(medium=None), "must have exactly"),
        (changed(medium__E_star=-1), "scene medium: effective modulus E_star = -1"),
        (changed(medium__E_star="1e9"), "must be one real number"),
        (changed(medium__E_star=10**400), "scene medium: effective modulus"),
        (changed(medium__viscosity=1), "scene medium must have exactly"),
        (changed(profile__type="Pyramid"), "profile needs a type out of FlatPunch, Cone"),
        (changed(profile__type=["Cone"]), "profile needs a type"),
        (changed(profile__slope=float("nan")), "NaN is not a number"),
        (changed(drive__depth="deep"), "scene drive: DepthPath depth"),
        (changed(drive__depth=[]), "must be a number or a path"),
        (changed(drive__depth=[[1.0, 2.0]]), "must be a number or a path"),
        (changed(drive__depth=[1.0, [2.0]]), "scene drive: DepthPath depth"),
        (changed(drive="down"), "drive needs a type"),
    ],
)
def test_what_is_not_a_scene_is_refused(text, says):
    with pytest.raises(ValueError, match=says):
        mdr.Scene.from_json(text)


def test_wrong_parts_are_refused():
    with pytest.raises(TypeError, match="scene medium is of the wrong type"):
        mdr.Scene(mdr.Cone(1.0), 1e9, mdr.DepthPath(1.0))
