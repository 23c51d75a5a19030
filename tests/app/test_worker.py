"""Processes that read and fit: how many there are, who waits, and what ends them."""

import os
import signal
import subprocess
import sys
import threading

import pytest

from app.fit import folders
from app.fit.refusals import without_folders
from app.fit.worker import LATE, NONE, Turns, Worker, waiting

from .conftest import ROOT

SILICA = str(ROOT / "assets" / "silica.csv")


class Heard:
    """What is told of a job, in the order in which it is."""

    def __init__(self):
        self.answers, self._any = [], threading.Condition()

    def __call__(self, kind, answer):
        with self._any:
            self.answers.append((kind, answer))
            self._any.notify_all()

    def first(self, seconds=600):
        with self._any:
            assert self._any.wait_for(lambda: self.answers, seconds)
            return self.answers[0]

    def wait(self, kind, seconds=120):
        with self._any:
            assert self._any.wait_for(lambda: any(each[0] == kind for each in self.answers), seconds), (
                self.answers
            )
            return next(answer for each, answer in self.answers if each == kind)


@pytest.fixture
def sessions():
    """Workers with room for two processes."""
    turns = Turns(2)
    workers = [Worker(turns) for _ in range(4)]
    yield turns, workers
    for each in workers:
        each.stop()


def read(worker, path=SILICA):
    heard = Heard()
    worker.ask("read", path, {}, 0, tell=heard)
    return heard


@pytest.mark.slow
def test_one_at_rest_gives_way_and_reads_its_file_again(sessions):
    turns, (first, second, third, _) = sessions
    for each in (first, second):
        read(each).wait("done")
    # There is no room, and nobody waits.
    heard = read(third)
    assert heard.wait("done")[1] == 1
    assert heard.answers[0][0] == "done"
    assert turns.having == [second, third]
    assert read(first).wait("done")[1] == 1
    assert turns.having == [third, first]


@pytest.mark.slow
@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="a pipe with a name is needed to hold a job")
def test_who_waits_is_told_how_many_are_before(sessions, tmp_path):
    turns, (first, second, third, fourth) = sessions
    # Who reads a pipe waits until something is written.
    pipes = [tmp_path / f"{k}.csv" for k in (1, 2)]
    for each in pipes:
        os.mkfifo(each)
    one, two = (read(*each) for each in zip((first, second), map(str, pipes), strict=True))
    three, four = read(third), read(fourth)
    assert three.wait("waiting") == 0
    assert four.wait("waiting") == 1
    assert turns.having == [first, second]
    # Another job of one who waits keeps the place, and one who leaves gives it up.
    three = read(third)
    assert three.wait("waiting") == 0
    second.stop()
    assert three.wait("done")[1] == 1
    assert four.wait("done")[1] == 1
    assert len(turns.having) <= 2
    assert [each for each in four.answers if each[0] == "waiting"] == [
        ("waiting", 1), ("waiting", 0), ("waiting", None)
    ]  # fmt: skip
    first.stop()
    assert [*one.answers, *two.answers] == []
    assert [waiting(k) for k in (0, 1, 2)] == [
        "Waiting for a free process, nobody is before you",
        "Waiting for a free process, one person is before you",
        "Waiting for a free process, 2 people are before you",
    ]


def test_a_server_without_room_for_a_process_says_so(monkeypatch):
    """As where the bound of tasks of the service is reached."""

    def none(*arguments, **options):
        raise BlockingIOError(11, "Resource temporarily unavailable")

    turns = Turns(1)
    worker = Worker(turns)
    with monkeypatch.context() as patched:
        patched.setattr(subprocess, "Popen", none)
        worker.start()
        assert read(worker).answers == [("ended", NONE)]
    assert not worker.busy
    assert turns.having == turns.waiting == []


def test_a_start_ahead_takes_nobodys_place(sessions):
    turns, workers = sessions
    for each in workers:
        each.start()
    assert turns.having == workers[:2]


#: Lines at which a pattern that goes back and forth takes minutes; what each is, and the line.
LONG = {
    "a title of blanks": "Title" + " " * 9_990 + "x",
    "words": "depth " * 2_000 + "(nm",
    "a number without end": "1" * 10_000 + "e",
    "brackets": "h " + "(" * 5_000 + "[" * 5_000,
    "units": "F (" + "N/m·" * 2_500 + ")",
    "cells": "," * 10_000,
}


@pytest.mark.slow
@pytest.mark.few(2)
@pytest.mark.parametrize("what", LONG)
def test_an_answer_comes_to_each_line(what, tmp_path):
    """As a curve and as a tip; that it comes is all that counts."""
    path, worker = tmp_path / "long.csv", Worker(Turns(1))
    try:
        for rows in ("1, 2\n3, 4\n", f"{LONG[what]}\n" * 5):
            path.write_text(f"{LONG[what]}\n{rows}", encoding="utf-8")
            for job in (("read", str(path), {}, 0), ("tip", str(path), "long.csv")):
                heard = Heard()
                worker.ask(*job, tell=heard)
                kind, answer = heard.first()
                assert kind in ("done", "refused", "ended")
                assert kind == "done" or len(answer.text) <= 2000
    finally:
        worker.stop()


@pytest.mark.slow
@pytest.mark.skipif(not hasattr(signal, "SIGXCPU"), reason="the system has no bound of processor time")
def test_a_job_that_computes_too_long_is_stopped_and_says_so(monkeypatch, tmp_path):
    """Two million rows take more than a second, which is the bound here."""
    worker, path = Worker(Turns(1)), tmp_path / "long.csv"
    path.write_text("h (nm), F (mN)\n" + "0.123456789, 0.987654321\n" * 2_000_000, encoding="utf-8")
    monkeypatch.setenv("MDR_EXPLORER_SECONDS", "1")
    try:
        assert read(worker, str(path)).wait("ended") == LATE
        # The next one is read by another process.
        assert read(worker).wait("done")[1] == 1
    finally:
        worker.stop()


def test_modules_are_not_those_of_the_folder_in_which_the_server_was_started(tmp_path, monkeypatch):
    """Where it has an `app`, or a name that a module of the page has."""
    (tmp_path / "app").mkdir()
    for name in ("app/__init__.py", "numpy.py", "mdr_core.py"):
        (tmp_path / name).write_text("import pathlib\npathlib.Path(__file__).with_suffix('.ran').touch()\n")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "path", ["", *(each for each in sys.path if each)])
    worker = Worker(Turns(1))
    try:
        assert read(worker).wait("done")[1] == 1
    finally:
        worker.stop()
    assert not [*tmp_path.rglob("*.ran")]


def test_messages_have_no_folder_of_the_server():
    for text, said in (
        ("no such file: '/tmp/mdr-explorer-x/abc/file 1.jpk-force'", "no such file: 'file 1.jpk-force'"),
        ("C:\\Users\\me\\AppData\\file 1.csv is damaged", "file 1.csv is damaged"),
        ("/usr/lib/python3/site-packages/afm/read.py failed", "read.py failed"),
        ("h/d_max, 5 nm/s and N/m² of W/(m K)", "h/d_max, 5 nm/s and N/m² of W/(m K)"),
    ):
        assert without_folders(text) == said


def test_folders_of_a_killed_server_are_cleared_at_the_next_start_and_others_stay(tmp_path):
    """One process is killed, one goes on; a third one starts."""
    load = "import runpy; made = runpy.run_path('app/fit/folders.py'); "
    code = load + "made['Files']().keep(b'1'); print('kept', flush=True); input()"
    own = os.environ | {"TMPDIR": str(tmp_path)}
    begun = [
        subprocess.Popen(
            [sys.executable, "-c", code], cwd=ROOT, env=own, stdin=subprocess.PIPE, stdout=subprocess.PIPE
        )
        for _ in range(2)
    ]
    try:
        for each in begun:
            assert each.stdout.readline() == b"kept\n"
        assert len([*tmp_path.iterdir()]) == 2
        begun[0].kill()
        begun[0].wait(20)
        subprocess.run(
            [sys.executable, "-c", load + "made['clear']()"], cwd=ROOT, env=own, check=True, timeout=120
        )
        (left,) = tmp_path.iterdir()
        assert [*left.rglob("file 1")]
        # At an orderly end nothing is left.
        begun[1].communicate(b"\n", timeout=20)
        assert [*tmp_path.iterdir()] == []
    finally:
        for each in begun:
            each.kill()
            each.wait(20)
            each.stdin.close()
            each.stdout.close()


def test_a_file_is_kept_once_under_a_new_name_each_time():
    files = folders.Files()
    first = files.keep(b"1", ".csv")
    second = files.keep(b"2", ".csv")
    assert first != second
    assert not os.path.exists(first)
    files.clear()
    assert not os.path.exists(second)
