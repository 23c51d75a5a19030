"""The hardness of a fit: its class is chosen, told, held and taken over to the page."""

import re

import numpy as np
import pytest

import mdr_core as mdr
from app import changes, link
from app.extras import fit as fitting
from app.extras.fit.measured import CONSTANTS, agrees, read_curve
from app.page import Page
from app.state import medium, preset_state, profile, yield_constant

from .states import linked_state, part, side, table

SILICA = "berkovich-fused_silica"


def curve_of(start, timed=False):
    """A curve of a scene without noise, from before first contact to a tenth back."""
    d = start.max_depth * np.append(np.linspace(-0.05, 1, 200), np.linspace(1, 0.9, 100))
    F = mdr.indent(profile(start), medium(start), d).force
    columns = {"t (s)": np.arange(300.0)} if timed else {}
    return read_curve(table(columns | {"h (nm)": 1e9 * d, "F (mN)": 1e3 * F}).encode(), "run.csv")


@pytest.mark.parametrize(("option", "letter"), [("constant", "a"), ("q_c", "b"), ("line", "c")])
def test_the_class_of_a_made_curve_is_told_and_its_constant_is_found(option, letter):
    """A curve without noise is fitted by its own class alone, with the constant it was made with."""
    start = changes.choose(preset_state(SILICA), "plasticity", option)
    (name,) = yield_constant(start)
    state = fitting.take(start, curve_of(start))
    # A new curve is fitted with the hardness of the page.
    assert CONSTANTS[option] == state["fit.hardness"]
    for fitted_option, constant in CONSTANTS.items():
        found = fitting.fit(state.replace(**{"fit.hardness": constant}))
        assert found.plasticity == fitted_option
        assert agrees(found)
        text = fitting.result(found)
        told, misfits = re.search(r"Class of hardness: \((\w)\) [^;]+; misfit (.*?) of the", text).groups()
        assert told == letter
        misfits = {each[0]: float(each[1]) for each in re.findall(r"\((\w)\) ([-+.\de]+) %", misfits)}
        # Samples are written with 10⁻⁶ nm; another class misses the force by more than a thousandth.
        assert misfits.pop(letter) < 1e-3
        assert min(misfits.values()) > 0.1
        assert ("This fit is of class" in text) == (fitted_option != option)
        assert "The class presumes a known tip that is not worn, one loading" in text
        if fitted_option == option:
            assert found.E_star == pytest.approx(start.E_star, rel=1e-4)
            assert found[name] == pytest.approx(start[name], rel=1e-4)
            assert fitting.quantity_of(constant).symbol in found["fit.note"]


def test_the_class_of_fused_silica_is_told_to_be_that_of_constant_hardness():
    """Also by a fit of q_c, which says that it is of another class."""
    state = fitting.silica(preset_state())
    for constant, other in (("hardness", False), ("q_c", True)):
        page = Page()
        page.apply(lambda _, constant=constant: fitting.fit(state.replace(**{"fit.hardness": constant})))
        text = side(page, "fit").said.object
        assert "Class of hardness: (a) constant; misfit (a) 0." in text
        assert ("This fit is of class (b), ∝ 1/a." in text) is other
        # Without a given noise of the force χ² is not known.
        assert "nan" not in text + page.state["fit.note"]
        # Once, not in the table as well.
        assert text.count("misfit (a)") == text.count("presumes") == 1


def test_a_fit_holds_the_hardness_of_the_page_or_says_why_not():
    start = preset_state(SILICA)
    fixed = ("hardness", *fitting.DEFAULT_FIXED)
    state = fitting.take(start, curve_of(start)).replace(**{"fit.fixed": fixed})
    held = fitting.fit(state)
    assert held.volume_hardness == start.volume_hardness
    assert "H = " not in held["fit.note"]
    with pytest.raises(ValueError, match="holds the constant hardness, and the page has another"):
        fitting.fit(state.replace(plasticity="q_c"))
    # An elastic medium is held as such, whatever the class.
    assert fitting.fit(state.replace(plasticity="none")).plasticity == "none"
    assert "Class of hardness" not in fitting.result(fitting.fit(state.replace(plasticity="none")))


def test_a_constant_hardness_with_viscosity_or_adhesion_is_refused_in_words_of_the_page():
    start = preset_state(SILICA)
    state = fitting.take(start, curve_of(start))
    adhesive = state.replace(plasticity="none", adhesion="work")
    with pytest.raises(ValueError, match="elastic medium: choose yield none, and hold the hardness"):
        fitting.fit(adhesive)
    with pytest.raises(ValueError, match="adhesion is modelled for a hardness ∝ 1/a only"):
        fitting.fit(adhesive.replace(plasticity="constant"))
    state = fitting.take(start, curve_of(start, timed=True))
    with pytest.raises(ValueError, match="with viscosity a fit is of a hardness ∝ 1/a: choose that one"):
        fitting.fit(state.replace(**{"fit.fixed": ("drag",)}))
    # No viscosity, held: the default.
    assert fitting.fit(state).plasticity == "constant"


def test_the_chosen_constant_is_offered_and_the_choice_is_in_links():
    page = Page()
    page.apply(fitting.silica)
    panel = side(page, "fit")
    row = part(page, "fit.hardness").look
    assert row["value"] == "hardness"
    assert [option for option, _ in row["options"]] == ["q_c", "hardness", "f_c"]
    shown = {fitting.quantity_of(name).label for name in CONSTANTS.values()}
    for constant in ("f_c", "q_c", "hardness"):
        page.choose("fit.hardness", constant)
        assert shown & set(panel.fixed.options) == {fitting.quantity_of(constant).label}
    assert linked_state(page.state)["fit.hardness"] == "hardness"
    # As links of version 0.6 are.
    assert link.read("preset=berkovich-pdms&fixed=q_c+tilt")["fit.hardness"] == "q_c"
