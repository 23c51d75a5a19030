"""Files that a browser sends in parts: whole and unchanged, or refused, within bounds of memory."""

import re
from types import SimpleNamespace

import pytest

from app.common.upload import CURVE_BYTES, PART_BYTES, SESSION_BYTES, TIP_BYTES, Uploads
from app.measurement.widgets import FileField

from ..conftest import ROOT, deployed


def part(name, number, count, data=b"1, 2\n"):
    return {"name": name, "chunk": number, "total_chunks": count, "data": data, "type": "text/csv"}


def added(uploads, *parts, most=CURVE_BYTES):
    """Names and data of the files that are whole after some parts."""
    found = [uploads.add(each, most) for each in parts]
    return [each[:2] for each in found if each is not None]


def test_files_that_come_at_once_are_whole_and_unchanged():
    """Also two of one name in two folders, and an empty one."""
    uploads = Uploads()
    # All bytes there are, in parts of different sizes.
    names = ("1.csv", "a/run.csv", "b/run.csv")
    files = {name: [bytes(range(k, 256)), b"\r\n\0", b"\xff" * k] for k, name in enumerate(names)}
    parts = [part(name, k + 1, 3, files[name][k]) for k in range(3) for name in files]
    assert added(uploads, *parts) == [(name, b"".join(data)) for name, data in files.items()]
    assert added(uploads, part("empty.csv", 1, 1, b"")) == [("empty.csv", b"")]
    assert uploads.size == 0


def test_a_file_begun_anew_has_nothing_of_its_first_parts():
    uploads = Uploads()
    assert added(uploads, part("a", 1, 3, b"1"), part("b", 1, 2, b"b"), part("a", 2, 3, b"2")) == []
    assert added(uploads, part("a", 1, 2, b"3"), part("a", 2, 2, b"4")) == [("a", b"34")]
    # Others go on.
    assert added(uploads, part("b", 2, 2, b"b")) == [("b", b"bb")]


def test_the_beginning_of_a_file_is_that_of_its_first_part():
    uploads = Uploads()
    added(uploads, part("a", 1, 2))
    _, _, second = uploads.add(part("b", 1, 1), CURVE_BYTES)
    _, _, first = uploads.add(part("a", 2, 2), CURVE_BYTES)
    assert first <= second


def test_a_curve_and_a_tip_of_one_name_are_two_files():
    uploads = Uploads()
    for k, most in ((1, CURVE_BYTES), (1, TIP_BYTES)):
        added(uploads, part("a.csv", k, 2, f"{most} ".encode()), most=most)
    for most in (CURVE_BYTES, TIP_BYTES):
        assert added(uploads, part("a.csv", 2, 2, b"end"), most=most) == [("a.csv", f"{most} end".encode())]


def test_names_and_parts_without_bytes_count():
    """200 names of a megabyte, and parts without end."""
    uploads = Uploads()
    refused = []
    for k in range(200):
        try:
            uploads.add(part(f"{k}" + "x" * 10**6, 1, 2, b""), CURVE_BYTES)
        except ValueError as error:
            refused.append(str(error))
    assert len(refused) > 100
    assert all(len(each) < 300 for each in refused)
    before = uploads.size
    added(uploads, part("empty", 1, 9, b""), part("empty", 2, 9, b""))
    assert uploads.size > before


#: A part of the size in which the page sends files.
FULL = bytes(PART_BYTES)


def test_a_file_of_just_the_bound_is_taken_and_one_byte_more_is_refused():
    uploads = Uploads()
    rest = TIP_BYTES - 2 * PART_BYTES
    parts = [part("tip.csv", k, 3, FULL) for k in (1, 2)]
    ((_, data),) = added(uploads, *parts, part("tip.csv", 3, 3, bytes(rest)), most=TIP_BYTES)
    assert len(data) == TIP_BYTES
    added(uploads, *parts, part("other.csv", 1, 2, b"1"), most=TIP_BYTES)
    with pytest.raises(ValueError, match=r"^tip\.csv has more than 5 MB"):
        uploads.add(part("tip.csv", 3, 4, bytes(rest + 1)), TIP_BYTES)
    # Nothing of it is kept, its rest is ignored, and the other goes on: a byte, its name and what lists it.
    assert 0 < uploads.size < 100
    rest = part("tip.csv", 4, 4), part("other.csv", 2, 2, b"2")
    assert added(uploads, *rest, most=TIP_BYTES) == [("other.csv", b"12")]


def test_files_that_never_end_keep_no_more_than_a_session_may():
    uploads, refused = Uploads(), []
    for name in "abcd":
        for k in range(1, 21):
            try:
                assert added(uploads, part(name, k, 10**6, FULL)) == []
            except ValueError as error:
                refused.append((name, k, str(error)))
            assert uploads.size <= SESSION_BYTES
    # The bound has 50 parts without what lists them: two files of 20, and 9 of the third.
    ((name, k, text),) = [each for each in refused if each[0] == "c"]
    assert k == 10
    assert text.startswith("all incoming files together have more than 100 MB: drop c again")
    # Without that one there is room for the next, and those before go on.
    assert not [each for each in refused if each[0] == "d" and each[1] < 10]
    assert [len(data) for _, data in added(uploads, part("a", 21, 21, FULL))] == [21 * PART_BYTES]


@pytest.mark.parametrize("number", [0, 1, 2, 4, 5, -1], ids="part {}".format)
def test_a_part_out_of_order_leaves_the_file_out(number):
    """Two of four are there. The first part begins the file anew, which is no fault."""
    uploads = Uploads()
    added(uploads, part("a", 1, 4), part("a", 2, 4))
    if number == 1:
        assert added(uploads, *(part("a", k, 4, b"%d" % k) for k in (1, 2, 3, 4))) == [("a", b"1234")]
        return
    with pytest.raises(ValueError, match="a part of a is missing: drop the file again"):
        uploads.add(part("a", number, 4), CURVE_BYTES)
    assert uploads.size == 0
    assert added(uploads, part("a", 3, 4), part("a", 4, 4)) == []


#: What is no part of a file: another value for a key, or another object.
NO_PARTS = {
    "data is a number, of which bytes would be so many": part("a", 1, 1, 10**12),
    "data is text": part("a", 1, 1, "1, 2"),
    "data is a list": part("a", 1, 1, [1, 2]),
    "data is nothing": part("a", 1, 1, None),
    "its number is text": part("a", "1", 1),
    "its number is a fraction": part("a", 1.0, 1),
    "the count is nothing": part("a", 1, None),
    "of no parts": part("a", 1, 0),
    "its name is a number": part(1, 1, 1),
    "its name is a list, which is no key": part([], 1, 1),
    **{f"no {key}": {k: each for k, each in part("a", 1, 1).items() if k != key}
       for key in ("name", "chunk", "total_chunks", "data")},
    "nothing": None, "a number": 1, "text": "part", "a list": [part("a", 1, 1)],
}  # fmt: skip


@pytest.mark.parametrize("what", NO_PARTS)
def test_what_is_no_part_of_a_file_is_refused_and_not_kept(what):
    uploads = Uploads()
    added(uploads, part("b", 1, 2, b"1"))
    with pytest.raises(ValueError, match="drop"):
        uploads.add(NO_PARTS[what], CURVE_BYTES)
    # A byte, its name and what lists it.
    assert 0 < uploads.size < 100
    assert added(uploads, part("b", 2, 2, b"2")) == [("b", b"12")]


def test_the_name_of_a_file_is_short_and_in_one_line_of_what_is_said():
    with pytest.raises(ValueError, match="is missing") as caught:
        Uploads().add(part("run\n" * 1000, 1, 0), CURVE_BYTES)
    assert "\n" not in str(caught.value)
    assert len(str(caught.value)) < 200


def test_a_field_takes_files_and_says_why_it_does_not():
    taken, refused = [], []
    uploads = Uploads()
    field = FileField(uploads, 10, lambda *file: taken.append(file[:2]), refused.append)

    def send(data, name="upload_event"):
        field._process_event(SimpleNamespace(event_name=name, data=data))

    send(part("run.csv", 1, 2, b"1"))
    # A file that is taken out of the field in the browser.
    send({"name": "run.csv"}, "delete_event")
    assert (taken, refused) == ([], [])
    send(part("run.csv", 2, 2, b"2"))
    assert taken == [("run.csv", b"12")]
    send(part("long.csv", 1, 2, bytes(11)))
    send(part("long.csv", 2, 2))
    send(part("run.csv", 1, 1, 10**12))
    assert len(taken) == 1
    assert [text.partition(" ")[0] for text in refused] == ["long.csv", "the"]
    # Panel keeps no copy.
    assert not field.value
    assert uploads.size == 0


def test_a_field_lets_the_browser_keep_the_same_bounds():
    field = FileField(Uploads(), CURVE_BYTES, print, print)
    assert (field.max_file_size, field.max_total_file_size) == ("50MB", "100MB")
    assert field.chunk_size == PART_BYTES


def test_bounds_of_files_are_those_of_the_documentation():
    """As text a part has a third more than its bytes; its names and numbers have less than 10 kB."""
    text = " ".join((ROOT / "assets/docs/explorer.md").read_text(encoding="utf-8").split())
    curve, part, tip = (f"{each / 1e6:g} MB" for each in (CURVE_BYTES, PART_BYTES, TIP_BYTES))
    assert re.search(f"{curve} .*parts of {part}", text)
    assert re.search(f"tips .*{tip}", text)
    options = deployed(5006)
    largest = int(options[options.index("--websocket-max-message-size") + 1])
    assert f"{largest / 1e6:g} MB" in text
    assert largest > PART_BYTES * 4 / 3 + 10_000
