"""Scenes survive JSON exactly, and nothing else passes for one."""

import json
from pathlib import Path

import numpy as np
import pytest

import mdr_core as mdr

from .approx import approx
from .shapes import SHAPES, name

SCENE = mdr.Scene(mdr.Cone(0.1), mdr.Medium(1e9, q_c=1 / 3), mdr.scene.DepthPath((0.0, 1e-9, 1 / 7)))


@pytest.mark.parametrize(
    "drive",
    [
        mdr.scene.DepthPath(1e-9),
        mdr.scene.DepthPath([1e-9, 0]),
        mdr.scene.FreeImpact(1e-3, 0.1),
        mdr.scene.FreeImpact(1e-3, 0.1, plastic_depth=1e-9),
        mdr.scene.FreeImpact(1e-3, 0.1, structure=mdr.Structure.plate(4e-3, 50e9, 0.3, 1600.0, edge=0.1)),
        mdr.scene.FreeImpact(1e-3, 0.1, structure=mdr.Structure(stiffness=1e7)),
        mdr.scene.FreeObliqueImpact(1e-3, 0.1, -1 / 3, 0.3),
    ],
)
@pytest.mark.parametrize("medium", [mdr.Medium(1e9, poisson=0.3), mdr.Medium(1 / 3, q_c=0.1, eta=1e-30)])
@pytest.mark.few(12)
@pytest.mark.parametrize("shape", [*SHAPES, mdr.Sampled([0, 1e-6, 3e-6], [0, 1e-7, 7e-7])], ids=name)
def test_round_trip_is_exact(shape, medium, drive):
    scene = mdr.Scene(shape, medium, drive)
    assert mdr.Scene.from_json(scene.to_json()) == scene


def test_solve_gives_what_the_functions_give():
    path = SCENE.solve()
    np.testing.assert_array_equal(
        path.force, mdr.indent(SCENE.profile, SCENE.medium, SCENE.drive.depth).force
    )
    hit = mdr.Scene(SCENE.profile, SCENE.medium, mdr.scene.FreeImpact(1e-3, 0.1)).solve()
    assert hit.restitution == mdr.impact(SCENE.profile, SCENE.medium, 1e-3, 0.1).restitution


def test_an_oblique_impact_is_solved_as_one():
    medium, ball = mdr.Medium(1e9, q_c=10.0), mdr.Ball(1e-9, 1e-5)
    drive = mdr.scene.FreeObliqueImpact(1e-9, 0.1, 0.1, 0.3, ball.tangential_mass)
    hit = mdr.Scene(mdr.Cone(0.1), medium, drive).solve()
    expected = mdr.oblique_impact(
        mdr.Cone(0.1), medium, 1e-9, 0.1, 0.1, 0.3, tangential_mass=ball.tangential_mass
    )
    assert hit.tangential_velocity == expected.tangential_velocity
    # Of a body that cannot turn it is the mass.
    assert mdr.scene.FreeObliqueImpact(1e-9, 0.1, 0.1, 0.3).tangential_mass == 1e-9
    with pytest.raises(ValueError, match="FreeObliqueImpact friction = -1"):
        mdr.scene.FreeObliqueImpact(1e-9, 0.1, 0.1, -1.0)


@pytest.mark.parametrize("eta", [0.0, 20.0])
def test_impact_on_an_imprint_is_solved_as_one(eta):
    medium, again = mdr.Medium(1e9, q_c=10.0, eta=eta), mdr.scene.FreeImpact(1e-9, 0.1, plastic_depth=2e-8)
    scene = mdr.Scene(mdr.Cone(0.1), medium, again)
    expected = mdr.impact(scene.profile, medium, 1e-9, 0.1, plastic_depth=2e-8)
    assert scene.solve().restitution == expected.restitution
    assert "chain" not in scene.models
    with pytest.raises(ValueError, match="FreeImpact plastic_depth = -1"):
        mdr.scene.FreeImpact(1e-9, 0.1, plastic_depth=-1.0)


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
        ("", "scene: not JSON text .Expecting value"),
        ("[1, 2", "scene: "),
        ("null", "must have exactly"),
        ("[" * 100_000, "nested too deeply"),
        ('{"format": 1, "format": 1}', "a key is repeated"),
        (changed(version=2), "version 2 .* must be 'mdr-scene' version 1"),
        (changed(note="hi"), "got .*note"),
        (changed(medium=None), "must have exactly"),
        (changed(medium__E_star=-1), "scene medium: effective modulus E_star = -1"),
        (changed(medium__E_star="1e9"), "must be one real number"),
        (changed(medium__E_star=10**400), "scene medium: effective modulus"),
        (changed(medium__viscosity=1), "scene medium must have exactly"),
        (changed(profile__type="Pyramid"), "profile needs a type, one of FlatPunch, Cone"),
        (changed(profile__type=["Cone"]), "profile needs a type"),
        (changed(profile__slope=float("nan")), "NaN is not a finite number"),
        (changed(drive__depth="deep"), "scene drive: DepthPath depth"),
        (changed(drive__depth=[]), "must be a number or a path"),
        (changed(drive__depth=[[1.0, 2.0]]), "must be a number or a path"),
        (changed(drive__depth=[1.0, [2.0]]), "scene drive: DepthPath depth"),
        (changed(drive="down"), "drive needs a type"),
    ],
)
def test_bad_scenes_are_refused(text, says):
    with pytest.raises(ValueError, match=says):
        mdr.Scene.from_json(text)


def test_wrong_parts_are_refused():
    with pytest.raises(TypeError, match="scene medium must be a Medium, got"):
        mdr.Scene(mdr.Cone(1.0), 1e9, mdr.scene.DepthPath(1.0))


class TestModel:
    """A scene picks the cheapest model that is exact, says which, and can be asked for another."""

    DRY, VISCOUS = mdr.Medium(1e9, q_c=10.0), mdr.Medium(1e9, q_c=10.0, eta=20.0)
    PATH, TIME = (0.0, 60e-9, 60e-9, 40e-9), (0.0, 1e-6, 2e-6, 3e-6)
    HIT = mdr.scene.FreeImpact(mass=1e-9, speed=0.1)

    @pytest.mark.parametrize(
        ("medium", "drive", "model", "kind"),
        [
            (DRY, mdr.scene.DepthPath(PATH), "closed form", mdr.Indentation),
            (VISCOUS, mdr.scene.DepthPath(PATH), "closed form", mdr.Indentation),
            (DRY, mdr.scene.DepthPath(PATH, TIME), "closed form", mdr.Indentation),
            (VISCOUS, mdr.scene.DepthPath(PATH, TIME), "chain", mdr.TimedIndentation),
            (VISCOUS, mdr.scene.ForcePath((0.0, 1e-6, 1e-6), TIME[:3]), "scalar ODE", mdr.TimedIndentation),
            (DRY, HIT, "closed form", mdr.Impact),
            (VISCOUS, HIT, "scalar ODE", mdr.Impact),
        ],
    )
    def test_the_cheapest_that_is_exact(self, medium, drive, model, kind):
        scene = mdr.Scene(mdr.Cone(0.3), medium, drive)
        result = scene.solve()
        assert isinstance(result, kind)
        assert result.model == scene.models[0] == model
        assert len(result.model.reason) > 20
        assert mdr.Scene.from_json(scene.to_json()) == scene

    @pytest.mark.parametrize("medium", [DRY, VISCOUS])
    def test_all_models_of_an_impact_agree(self, medium):
        scene = mdr.Scene(mdr.Cone(0.3), medium, self.HIT)
        exact = scene.solve()
        for model in scene.models:
            other = scene.solve(model=model)
            assert other.model == model
            # The chain is refined until its estimate is 1e-6.
            assert other.restitution == approx(exact.restitution, rel=2e-6)
            assert other.max_depth == approx(exact.max_depth, rel=2e-6)

    @pytest.mark.parametrize(
        "drive", [mdr.scene.DepthPath(PATH), mdr.scene.DepthPath(60e-9), mdr.scene.ForcePath((0.0, 1e-6))]
    )
    def test_all_models_of_a_path_agree(self, drive):
        scene = mdr.Scene(mdr.Paraboloid(1e-6), self.VISCOUS, drive)
        exact, chain = scene.solve(), scene.solve(model="chain")
        # Tolerance 1e-6 of the largest force on a depth path, 1e-4 of the largest depth on a force path.
        np.testing.assert_allclose(chain.force, exact.force, rtol=2e-6, atol=1e-12)
        np.testing.assert_allclose(chain.depth, exact.depth, rtol=2e-4, atol=1e-14)

    def test_a_model_that_cannot_is_refused(self):
        scene = mdr.Scene(mdr.Cone(0.3), self.VISCOUS, self.HIT)
        with pytest.raises(ValueError, match="'closed form' must be one of 'scalar ODE', 'chain'"):
            scene.solve(model="closed form")

    def test_a_scene_is_one_indenter_on_one_medium(self):
        with pytest.raises(ValueError, match="a single indenter and a single medium"):
            mdr.Scene(mdr.Cone([0.1, 0.2]), self.DRY, self.HIT)


@pytest.mark.parametrize(
    ("part", "keys"),
    [("medium", "poisson"), ("medium", "hardness f_c"), ("drive", "plastic_depth"), ("drive", "time")],
)
def test_a_file_from_before_a_parameter_is_read(part, keys):
    """As one without its effect: an incompressible medium of class (b), a virgin one, a slow path."""
    drive = mdr.scene.DepthPath(1e-9) if keys == "time" else mdr.scene.FreeImpact(1e-9, 0.1)
    scene = mdr.Scene(mdr.Cone(0.3), mdr.Medium(70e9, q_c=5.0), drive)
    data = json.loads(scene.to_json())
    for key in keys.split():
        del data[part][key]
    assert mdr.Scene.from_json(json.dumps(data)) == scene


@pytest.mark.parametrize("name", ["scene.json", Path("somewhere/scene.json"), Path("scene")])
def test_the_name_of_a_file_is_no_scene(name):
    with pytest.raises(ValueError, match=r"scene: .* is the name of a file.*read_text\(\)"):
        mdr.Scene.from_json(name)


def test_scenes_of_every_class_of_hardness():
    for given in ({"hardness": 9e9}, {"f_c": 1e-3, "q_c": 5.0}, {"q_c": 5.0}, {}):
        scene = mdr.Scene(mdr.Cone(0.3), mdr.Medium(70e9, **given), mdr.scene.FreeImpact(1e-9, 0.1))
        assert mdr.Scene.from_json(scene.to_json()) == scene
        arguments = ", ".join(
            f"{name}={given[name]!r}" for name in ("q_c", "hardness", "f_c") if name in given
        )
        assert f"mdr.Medium(E_star=70000000000.0{', ' * bool(given)}{arguments})" in scene.to_python()


def test_an_oblique_impact_without_friction_keeps_its_speed_along_the_surface():
    """μ = 0 is no friction, not a mistake; less is one."""
    drive = mdr.scene.FreeObliqueImpact(1e-9, 0.1, tangential_speed=0.3, friction=0.0)
    hit = mdr.Scene(mdr.Paraboloid(1e-3), mdr.Medium(1e9), drive).solve()
    assert hit.tangential_velocity == 0.3
    with pytest.raises(ValueError, match=r"friction .*must be finite and not negative"):
        mdr.scene.FreeObliqueImpact(1e-9, 0.1, tangential_speed=0.3, friction=-0.1)
