"""What is said of a number is a sentence, and a value: its kind, a text for a page, and what one can do."""

import copy
import json
import pickle
import re

import numpy as np
import pytest

import mdr_core as mdr
from mdr_core.base.remark import ACTIONS, KINDS, MeasurementError, Remedy
from mdr_core.measurements.fit.parameters import PARAMETERS
from mdr_core.measurements.fit.result import IndentationFit

from ...benchmarks.remarks import GEL, beside_fits, of_a_kind, of_unloadings
from ...said import kinds, remark_of
from .families import KINDS as MEDIA
from .families import curve
from .test_fit import silica

#: Names of arguments that are no symbols of the paper, calls, keywords and modules.
PYTHON = re.compile(
    r"\b(?:E_star|eta|contact_point|work_of_adhesion|depth_noise|force_noise|spring_constant)\b"
    r"|\w\(|\w=|=None|\bNaN\b|\bnp\.|\bcolumns=|\bmdr\b|\bTrue\b|\binf\b"
)
NAMES = {
    *PARAMETERS, "depth", "force", "time", "columns", "spring_constant", "sensitivity", "depth_noise",
    "profile", "cycles", "by", "index",
}  # fmt: skip


def sound(remark):
    """Whether a remark is one: of a kind in the list, with a plain text and remedies with public names."""
    assert isinstance(remark, mdr.Remark)
    assert remark.kind in KINDS
    assert not PYTHON.search(remark.text), remark.text
    for remedy in remark.remedy:
        assert remedy.action in ACTIONS
        if remedy.action in ("free", "hold"):
            assert remedy.what in PARAMETERS
        if remedy.action in ("give", "unit"):
            assert remedy.what in NAMES, remedy
        if remedy.action == "class":
            assert remedy.what in ("a", "b", "c", "elastic")
        if remedy.action == "part":
            assert remedy.what in ("all", "loading", "unloading")
    return True


def test_all_that_is_said_of_curves_is_a_remark():
    """On curves of three media with one thing wrong each, their unloadings, on files, tips, hardnesses."""
    seen = set()
    for medium in MEDIA.values():
        others = beside_fits() if medium is GEL else ()
        for result, _ in (*of_a_kind(medium, 0), *of_unloadings(medium, 0), *others):
            assert all(map(sound, result.remarks))
            seen |= kinds(result)
            if isinstance(result, IndentationFit) and not result.shape:
                quoted = result.quoted
                assert not PYTHON.search(quoted.reason), quoted.reason
                assert (quoted.kind is None) == (quoted.value is not None)
                assert quoted.kind is None or sound(mdr.Remark(quoted.reason, quoted.kind, *quoted.remedy))
    # Most of the two dozen; the others are of maps, and of noise that is not the same everywhere.
    assert len(seen) > 16


def test_a_remark_stays_one():
    """Through a pickle, as by a queue, through copies, and as a str among others."""
    remedy = (mdr.Remedy("hold", "eta", 0.0),)
    remark = mdr.Remark("η is 0", "constant", *remedy)
    for again in (pickle.loads(pickle.dumps(remark)), copy.copy(remark), copy.deepcopy(remark)):
        assert (again, again.kind, again.text, again.remedy) == (remark, "constant", "η is 0", remedy)
    assert remark == "η is 0; hold eta = 0"
    assert " ".join((remark, remark)) == "η is 0; hold eta = 0 η is 0; hold eta = 0"
    assert json.loads(json.dumps(remark.to_dict())) == {
        "kind": "constant",
        "text": "η is 0",
        "remedy": [{"action": "hold", "what": "eta", "value": 0.0}],
    }


def test_a_kind_or_an_action_that_is_none_is_refused():
    """A word that the page does not know would be said by nobody."""
    with pytest.raises(ValueError, match="kind = 'missfit'"):
        mdr.Remark("", "missfit")
    with pytest.raises(ValueError, match="action = 'fix'"):
        mdr.Remedy("fix", "eta")


def test_a_remedy_does_what_it_says():
    """What is freed or held as a remark says makes it go: of a drag here, and of a viscosity of 0."""
    for result, right in of_a_kind(GEL, 0):
        for remark in result.remarks:
            if remark.kind in right & {"drag", "constant"} and remark.remedy[0].action != "class":
                (remedy,) = remark.remedy
                given = {remedy.what: None if remedy.action == "free" else remedy.value}
                options = dict(GEL.options) | {"time": result.time} | given
                again = mdr.fit_indentation(GEL.tip, result.depth, result.force, **options)
                assert remark.kind not in kinds(again)


def test_of_many_curves_the_first_is_told_with_their_number():
    """Two of three have a slope; the text is that of the first of them, and each has its own."""
    medium = GEL
    depth, force, _ = curve(medium, "clean", 0.0, 0)
    force = np.stack([force, *(force + 0.05 * force.max() * depth / 1e-6,) * 2])
    fit = mdr.fit_indentation(medium.tip, [depth] * 3, force, **medium.options)
    tilt = remark_of(fit, "tilt")
    assert tilt.startswith("curve 1 (2 of 3 curves): a tilt of ")
    own = remark_of(fit[1], "tilt")
    assert tilt.text.endswith(own.text)
    assert tilt.remedy == own.remedy
    assert not own.startswith("curve")
    assert own.remedy[0] == mdr.Remedy("free", "tilt")


REFUSED = {
    "viscosity without times": {"eta": None, "q_c": np.inf},
    "adhesion of a medium that yields": {"work_of_adhesion": None},
    "adhesion and viscosity": {
        "work_of_adhesion": None, "q_c": np.inf, "eta": None, "time": np.arange(200.0),
    },
    "viscosity of a glass": {"hardness": None, "eta": None, "time": np.arange(200.0)},
}  # fmt: skip


@pytest.mark.parametrize("what", REFUSED)
def test_a_refusal_has_a_text_and_a_remedy(what):
    depth = np.append(np.linspace(-5e-8, 6e-7, 100), np.linspace(6e-7, 0, 100))
    force = mdr.indent(mdr.Cone(0.3), mdr.Medium(10e9), depth).force
    with pytest.raises(MeasurementError) as error:
        mdr.fit_indentation(mdr.Cone(0.3), depth, force, **REFUSED[what])
    assert error.value.kind == "invalid"
    assert sound(mdr.Remark(error.value.text, error.value.kind, *error.value.remedy))
    assert error.value.remedy
    again = pickle.loads(pickle.dumps(error.value))
    assert (str(again), again.text, again.remedy) == (
        str(error.value), error.value.text, error.value.remedy,
    )  # fmt: skip


def test_a_record_without_contact_says_what_to_free():
    depth = np.linspace(0, 1e-7, 50)
    with pytest.raises(ValueError, match="no contact") as error:
        mdr.fit_indentation(mdr.Cone(0.3), depth, -1e-6 - depth, q_c=np.inf)
    assert error.value.remedy == (mdr.Remedy("free", "baseline"),)
    assert not PYTHON.search(error.value.text)
    assert error.value.advice.startswith("forces are positive")


class TestIdealTip:
    """A real tip is round: what an ideal one makes of it at small depths, and where this is said."""

    REAL, IDEAL = mdr.RoundedCone(tip_radius=300e-9, slope=0.358), mdr.Cone(0.358)

    def record(self, top):
        depth = np.append(np.linspace(-0.2 * top, top, 200), np.linspace(top, 0, 150))
        return depth, mdr.indent(self.REAL, mdr.Medium(70e9, hardness=9e9), depth).force

    @pytest.mark.parametrize(("top", "said"), [(100e-9, True), (1e-6, False)])
    def test_it_is_said_where_the_numbers_are_off(self, top, said):
        """With first contact held: by more than a tenth at 100 nm, by less than 5 % at 1 µm."""
        depth, force = self.record(top)
        held = mdr.fit_indentation(self.IDEAL, depth, force, hardness=None, contact_point=0.0)
        unloading = mdr.oliver_pharr(self.IDEAL, depth[20:], force[20:])
        real = mdr.oliver_pharr(self.REAL, depth[20:], force[20:])
        for result, true in ((held.medium, 70e9), (unloading, real.E_star)):
            assert (result.E_star / true > 1.1) == said
            assert said or result.E_star / true < 1.05
        for result in (held, unloading):
            assert ("tip" in kinds(result)) == said
            assert not said or result.remarks[-1].kind == "tip"

    def test_a_fitted_first_contact_takes_the_rounding_up(self):
        """E* within 3 %, and nothing to be said: z₀ is off by the rounding instead."""
        depth, force = self.record(100e-9)
        fit = mdr.fit_indentation(self.IDEAL, depth, force, hardness=None)
        assert abs(fit.medium.E_star / 70e9 - 1) < 0.03
        assert fit.contact_point < -15e-9
        assert "tip" not in kinds(fit)

    def test_of_a_tip_with_a_radius_nothing_is_said(self):
        depth, force = self.record(100e-9)
        for tip in (self.REAL, mdr.Sampled.from_area_function([24.5, 150.0], 1e-6, unit="nm")):
            result = mdr.oliver_pharr(tip, depth[20:], force[20:])
            assert "tip" not in kinds(result)


def test_a_modulus_below_1_kPa_is_asked_about():
    """Silica in µm for nm and N for mN would be some kPa; in the other units it is 70 Pa."""
    depth, force, _ = silica()
    wrong = mdr.oliver_pharr(mdr.Cone.berkovich(), 1e3 * depth, 1e-3 * force)
    assert 1.0 < wrong.E_star < 1e3
    remark = remark_of(wrong, "units")
    assert {each.what for each in remark.remedy} == {"depth", "force"}
    right = mdr.oliver_pharr(mdr.Cone.berkovich(), depth, force)
    assert "units" not in kinds(right)


def test_remedies_that_belong_together_are_joined_by_and_others_by_or():
    tilt, baseline = Remedy("free", "tilt"), Remedy("free", "baseline")
    both = mdr.Remark("a tilt", "tilt", tilt, baseline, together=True)
    either = mdr.Remark("a tilt", "tilt", tilt, baseline)
    assert both == "a tilt; give tilt=None and give baseline=None"
    assert either == "a tilt; give tilt=None or give baseline=None"
    assert both.text == either.text == "a tilt"
    assert both.remedy == either.remedy == (tilt, baseline)
