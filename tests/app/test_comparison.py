"""Speed against error: what is compared, how it ends, and what stops it."""

import threading
from itertools import islice

import numpy as np
import pytest

from app import comparison
from app.comparison import compare
from app.presets import PRESETS
from app.state import Explorer

from .person import Person

DROP = next(label for label in PRESETS if "drop weight" in label)


@pytest.mark.parametrize("drive", ["depth", "force"])
def test_chains_come_nearer_to_the_exact_force(drive):
    state = Explorer()
    state.choose("drive", drive)
    scene = state.scene()
    rows = list(compare(scene, scene.solve(), cap=30))
    assert [row.model for row in rows] == ["closed form", *["chain"] * len(comparison.ELEMENTS)]
    assert rows[0].error is None
    errors = [row.error for row in rows[1:]]
    # Of second order in 1/n: from 32 to 4096 elements by about 128².
    assert errors[-1] < errors[0] / 1000
    assert errors[-1] < 1e-5
    assert all(row.seconds > 0 for row in rows)


@pytest.mark.parametrize("damping", ["none", "tau"])
def test_models_of_an_impact_agree(damping):
    state = Explorer(DROP)
    state.choose("damping", damping)
    scene = state.scene()
    # As many as there are models, and two chains more, however long they take.
    rows = list(islice(compare(scene, scene.solve(), cap=np.inf), len(scene.models) + 2))
    names = [row.model for row in rows]
    assert names[: len(scene.models) - 1] == [str(model) for model in scene.models[:-1]]
    assert rows[0].error is None
    assert max(row.error for row in rows[1:]) < 1e-3


def test_no_solution_is_begun_beyond_the_cap_or_once_stopped():
    scene = Explorer(DROP).scene()
    result = scene.solve()
    assert [row.n for row in compare(scene, result, cap=0.0)] == [None, None]
    assert list(compare(scene, result, stopped=lambda: True)) == []


def test_rows_are_sent_as_they_come():
    person = Person()
    person.ask("compare", on=True)
    person.session.comparing.running.result(20)
    messages = [message for message in person.sent if "compared" in message]
    assert [len(message["rows"]) for message in messages[:3]] == [1, 2, 3]
    last = messages[-1]
    assert last["done"]
    assert last["compared"] == person.meta["seq"]
    assert last["used"] == "closed form"
    assert "plastic depth" in last["reason"]


def test_newer_input_stops_what_is_compared(monkeypatch):
    begun, go_on = threading.Event(), threading.Event()

    def slow(scene, result, stopped):
        begun.set()
        go_on.wait(20)
        if not stopped():
            yield comparison.Row("closed form", None, 1.0, None)

    monkeypatch.setattr(comparison, "compare", slow)
    person = Person()
    person.ask("compare", on=True)
    assert begun.wait(20)
    person.ask("type", name="max_depth", text="5 nm")
    go_on.set()
    person.session.comparing.running.result(20)
    assert [message for message in person.sent if "compared" in message] == []


def test_a_fault_of_a_model_is_told_and_logged_with_the_scene(monkeypatch, caplog):
    def broken(scene, result, stopped):
        raise ArithmeticError

    monkeypatch.setattr(comparison, "compare", broken)
    person = Person()
    person.ask("compare", on=True)
    person.session.comparing.running.result(20)
    assert person.sent[-1]["failed"]
    assert '"slope": 0.358' in caplog.text
