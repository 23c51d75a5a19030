"""Processes that read and fit: how many there are, who waits, and what ends them."""

import asyncio
import os
import signal
import sys
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from functools import wraps
from subprocess import PIPE, Popen, run
from types import SimpleNamespace

import pytest

import mdr_core as mdr
from app.common import process
from app.common.errors import Refused
from app.common.folders import Files
from app.common.process import Places, Replaced, SynchronousWorker, Worker, queue_text

from ..conftest import ROOT


@pytest.fixture
def sessions(monkeypatch):
    """Workers of five sessions with room for two processes, and all processes that are begun."""
    places, begun, create = Places(2), [], asyncio.create_subprocess_exec

    async def recorded(*command, **options):
        begun.append(await create(*command, **options))
        return begun[-1]

    monkeypatch.setattr(asyncio, "create_subprocess_exec", recorded)
    return SimpleNamespace(places=places, workers=[Worker(places) for _ in range(5)], begun=begun)


def in_a_loop(test):
    """Run a test of sessions in a loop of its own, and end their processes before the loop ends."""

    async def ended(sessions, **fixtures):
        try:
            # Without a bound an answer that never comes would hold all tests.
            async with asyncio.timeout(120):
                await test(sessions, **fixtures)
        finally:
            for each in sessions.workers:
                each.stop()
            # One whose process is still being created ends that itself.
            if jobs := asyncio.all_tasks() - {asyncio.current_task()}:
                await asyncio.wait(jobs, timeout=20)
            for each in sessions.begun:
                with suppress(ProcessLookupError):
                    each.kill()
                await each.communicate()

    def run_in_a_thread(**fixtures):
        # In a thread of its own: a browser's driver may have left a loop running in this one.
        with ThreadPoolExecutor(1) as thread:
            thread.submit(lambda: asyncio.run(ended(**fixtures))).result()

    return wraps(test)(run_in_a_thread)


SILICA = str(mdr.example("silica.csv"))


async def read(worker, path=SILICA, **told):
    """The number of curves of a file."""
    return (await worker.run("measurement.analysis.read", str(path), {}, 0, **told))[1]


@pytest.mark.slow
@in_a_loop
async def test_one_at_rest_gives_way_and_reads_its_file_again(sessions):
    (first, second, third, *_), told = sessions.workers, []
    for each in (first, second, third):
        assert await read(each, waits=told.append) == 1
    # There is no room, and nobody waits.
    assert told == []
    assert sessions.places.taken == [second, third]
    await sessions.begun[0].wait()
    assert await read(first) == 1
    assert sessions.places.taken == [third, first]


@pytest.fixture
def pipe(tmp_path):
    """Path of a pipe; who reads it waits until something is written."""
    if not hasattr(os, "mkfifo"):
        pytest.skip("a pipe with a name is needed to hold a job")
    os.mkfifo(tmp_path / "pipe.csv")
    return tmp_path / "pipe.csv"


async def begin(worker, path=SILICA, **told):
    """A job that has asked for its place."""
    task = asyncio.create_task(read(worker, path, **told))
    await asyncio.sleep(0)
    return task


async def replaced(job):
    with pytest.raises(Replaced):
        await job


@pytest.mark.slow
@in_a_loop
async def test_who_waits_is_told_how_many_are_before(sessions, pipe):
    (first, second, third, fourth, fifth), places = sessions.workers, sessions.places
    told = {each: [] for each in (third, fourth, fifth)}
    held = [await begin(each, pipe) for each in (first, second)]
    jobs = {each: await begin(each, waits=told[each].append) for each in told}
    # A number may be told again.
    assert [{*each} for each in told.values()] == [{0}, {1}, {2}]
    assert places.taken == [first, second]
    # Another job of one who waits keeps the place, and one who leaves gives it up.
    other = await begin(third)
    await replaced(jobs[third])
    fourth.stop()
    await replaced(jobs[fourth])
    assert places.waiting == [third, fifth]
    second.stop()
    assert await other == await jobs[fifth] == 1
    assert len(places.taken) <= 2
    assert [*dict.fromkeys(told[fifth])] == [2, 1, 0]
    first.stop()
    for each in held:
        await replaced(each)


def test_a_queue_is_told_in_words():
    nobody, one, two = map(queue_text, (0, 1, 2))
    assert len({nobody, one, two}) == 3
    assert "2" in two


#: What is raised where the bound of tasks of the service is reached, and by a loop without processes.
FAILURES = {process.NO_ROOM: BlockingIOError(11, "not now"), process.NO_PROCESSES: NotImplementedError()}


async def refused(job):
    with pytest.raises(Refused) as caught:
        await job
    return caught.value.text


@pytest.mark.parametrize("said", FAILURES, ids=["room", "processes"])
@in_a_loop
async def test_a_server_that_cannot_start_a_process_says_so(sessions, said, monkeypatch):
    """Places are given to the next one who asks, and nobody waits."""

    async def none(*arguments, **options):
        raise FAILURES[said]

    first, second, third, *_ = sessions.workers
    with monkeypatch.context() as patched:
        patched.setattr(asyncio, "create_subprocess_exec", none)
        assert await refused(read(first)) == await refused(read(second)) == said
    assert not first.busy
    assert sessions.places.waiting == []
    assert await read(third) == 1


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
@in_a_loop
async def test_an_answer_comes_to_each_line(sessions, what, tmp_path):
    """As a curve and as a tip; that it comes is all that counts."""
    path = tmp_path / "long.csv"
    for rows in ("1, 2\n3, 4\n", f"{LONG[what]}\n" * 5):
        path.write_text(f"{LONG[what]}\n{rows}", encoding="utf-8")
        for job, *given in (("measurement.analysis.read", {}, 0), ("common.tip.read", "long.csv")):
            run = sessions.workers[0].run(job, str(path), *given)
            (answer,) = await asyncio.gather(run, return_exceptions=True)
            assert isinstance(answer, tuple) or len(answer.text) <= 2000


@pytest.mark.slow
@pytest.mark.skipif(not hasattr(signal, "SIGXCPU"), reason="the system has no bound of processor time")
@in_a_loop
async def test_a_job_that_computes_too_long_is_stopped_and_says_so(sessions, monkeypatch, tmp_path):
    """Two million rows take more than two seconds, and the bound here is between one and two."""
    worker, path = sessions.workers[0], tmp_path / "long.csv"
    path.write_text("h (nm), F (mN)\n" + "0.123456789, 0.987654321\n" * 2_000_000, encoding="utf-8")
    with monkeypatch.context() as patched:
        patched.setenv("MDR_EXPLORER_SECONDS", "1")
        assert await refused(read(worker, path)) == process.LATE
    # The next one is read by another process.
    assert await read(worker) == 1


@pytest.mark.slow
@in_a_loop
async def test_a_process_that_is_killed_ends_its_job_alone(sessions, pipe):
    """As by the system when there is too little memory, within a job and at rest."""
    worker, begun = sessions.workers[0], sessions.begun
    job = await begin(worker, pipe)
    while not begun:
        await asyncio.sleep(0.01)
    begun[0].kill()
    assert await refused(job) == process.ENDED
    # One process for the next two jobs, and another one once that is killed.
    assert await read(worker) == await read(worker) == 1
    begun[1].kill()
    await begun[1].wait()
    assert await read(worker) == 1
    assert len(begun) == 3


@pytest.mark.parametrize("created", [False, True], ids=["while it is created", "within its job"])
@in_a_loop
async def test_a_job_takes_the_place_of_another_and_no_process_is_left(sessions, created, pipe):
    worker, begun = sessions.workers[0], sessions.begun
    first = await begin(worker, pipe)
    while created and not begun:
        await asyncio.sleep(0.01)
    assert len(begun) == created
    second = await begin(worker)
    await replaced(first)
    assert await second == 1
    # Which of two processes is there first is open.
    one, other = sorted(begun, key=lambda each: each is worker._process)
    await one.wait()
    assert (other, other.returncode) == (worker._process, None)
    assert sessions.places.taken == [worker]


@in_a_loop
async def test_a_session_that_ends_while_its_process_is_created_leaves_none(sessions):
    job = await begin(sessions.workers[0])
    assert not sessions.begun
    sessions.workers[0].stop()
    await replaced(job)
    await sessions.begun[0].wait()
    assert sessions.places.taken == sessions.places.waiting == []


@in_a_loop
async def test_parts_of_an_answer_come_in_order_and_are_those_without_a_process(sessions, tmp_path):
    """Of each curve one sample is chosen, which is too few: that is quickly said."""
    path = tmp_path / "three.csv"
    rows = (f"{curve}, {depth}, {depth}\n" for curve in (1, 2, 3) for depth in range(1, 10))
    path.write_text("curve, h (nm), F (mN)\n" + "".join(rows), encoding="utf-8")
    asked = {"medium": "gel", "arguments": {}, "corrections": {}, "samples": (1, 1)}
    parts, others = [], []
    for worker, part in ((sessions.workers[0], parts.append), (SynchronousWorker(), others.append)):
        await worker.run("measurement.analysis.fit_all", str(path), {"by": "curve"}, asked, part=part)
    assert [row.name for row in parts] == ["1", "2", "3"]
    assert parts == others

    def broken(part):
        raise RuntimeError

    # The rest of a job whose parts the page cannot take is no answer to the next job.
    worker = sessions.workers[0]
    with pytest.raises(RuntimeError):
        await worker.run("measurement.analysis.fit_all", str(path), {"by": "curve"}, asked, part=broken)
    assert await read(worker) == 1


@in_a_loop
async def test_modules_are_not_those_of_the_folder_in_which_the_server_was_started(
    sessions, tmp_path, monkeypatch
):
    """Where it has an `app`, or a name that a module of the page has."""
    (tmp_path / "app").mkdir()
    for name in ("app/__init__.py", "numpy.py", "mdr_core.py"):
        (tmp_path / name).write_text("import pathlib\npathlib.Path(__file__).with_suffix('.ran').touch()\n")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "path", ["", *filter(None, sys.path)])
    assert await read(sessions.workers[0]) == 1
    assert not [*tmp_path.rglob("*.ran")]


def test_folders_of_a_killed_server_are_cleared_at_the_next_start_and_others_stay(tmp_path):
    """One process is killed, one goes on; a third one starts."""
    options = {"cwd": ROOT, "env": os.environ | {"TMPDIR": str(tmp_path)}}
    # As a process begins: the module of folders without the explorer, which its package loads.
    bare = process._PROGRAM.partition("from ")[0] + "from app.common import folders\n"
    keeps = bare + "folders.Files().keep(b'1'); print('kept', flush=True); input()"
    keep = {"args": [sys.executable, "-c", keeps, "app"], "stdin": PIPE, "stdout": PIPE} | options
    with Popen(**keep) as killed, Popen(**keep) as other:
        assert killed.stdout.readline() == other.stdout.readline() == b"kept\n"
        assert len([*tmp_path.iterdir()]) == 2
        killed.kill()
        killed.wait(20)
        run([sys.executable, "-c", bare + "folders.clear()", "app"], **options, check=True, timeout=120)
        (left,) = tmp_path.iterdir()
        assert [*left.rglob("file")]
        # At an orderly end nothing is left.
        other.communicate(b"\n", timeout=20)
        assert [*tmp_path.iterdir()] == []


def test_a_file_is_kept_once_under_a_new_name_each_time():
    files = Files()
    first = files.keep(b"1", "run.csv")
    second = files.keep(b"2", "run.csv")
    assert first != second
    assert not os.path.exists(first)
    files.clear()
    assert not os.path.exists(second)
