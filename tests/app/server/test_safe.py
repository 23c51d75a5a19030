"""A server that is open to all: hostile requests, names, links and origins."""

import re
from functools import cache
from pathlib import Path
from urllib.parse import quote

import pytest
from bokeh.util.token import get_token_payload

from app.security import same_loopback_origin

from ..conftest import CHROMIUM, FLAGS, PROGRAM, READY, Explorer, Server, get
from ..states import HOSTILE


def test_an_address_of_a_component_imports_nothing(command):
    """`this` prints at its import; `unittest.__main__` ends the process that imports it."""
    modules = ("this", "antigravity", "app.main", "mdr_core.measurements.reading", "unittest.__main__")
    for prefix in ("", "/app"):
        for module in modules:
            assert get(command, f"{prefix}/components/{module}/x/y/z")[0] == 404
    assert get(command, "/components/this")[0] == 404
    assert get(command, "/app")[0] == 200
    assert "Beautiful" not in command.log
    assert command.faults == ""


def test_a_prefix_moves_components_away_with_all_else():
    server = Server("--prefix", "lab", program=PROGRAM)
    try:
        assert get(server, "/lab/components/unittest.__main__/x/y/z")[0] == 404
        assert get(server, "/lab/components/this/x/y/z")[0] == 404
        assert get(server, "/lab/app")[0] == 200
        assert get(server, "/lab/app/theory.html")[0] == 200
        assert "Beautiful" not in server.log
    finally:
        server.stop()


#: Places that earlier links to the theory name, with those to which they lead.
PLACES = {
    "": "", "eq-11": "eq-11", "section-13": "section-13", "%ff%00": "", "/../evil.example": "evilexample",
    "%0d%0aSet-Cookie:%20dark=1": "Set-Cookiedark1", "eq-4&theory=eq-5": "eq-5",
}  # fmt: skip


def test_an_earlier_link_to_the_theory_leads_to_no_other_site_and_needs_no_session(command):
    """The page for measurements goes first, as before."""
    for folder, start in {"/app": "app/theory.html", "/app/": "theory.html"}.items():
        for place, found in PLACES.items():
            status, headers, body = get(command, f"{folder}?theory={place}")
            assert (status, body) == (302, b"")
            assert headers["Location"] == f"{start}#{found}"
            assert "Set-Cookie" not in headers
    assert b'"token"' not in get(command, "/app/theory.html")[2]
    assert b'"token"' in get(command, "/app?fit&theory=eq-11")[2]


@cache
def token(server):
    """The token of a page."""
    return re.search(r'"token":"([^"]+)"', get(server, "/app")[2].decode())[1]


def upgraded(server, origin, host, **headers):
    """Status of a websocket that is asked for by a page of an origin at a host."""
    asked = {
        "Connection": "Upgrade", "Upgrade": "websocket", "Sec-WebSocket-Version": "13",
        "Sec-WebSocket-Key": "AAAAAAAAAAAAAAAAAAAAAA==",
        "Sec-WebSocket-Protocol": f"bokeh, {token(server)}",
    }  # fmt: skip
    return get(server, "/app/ws", asked | headers | {"Origin": origin}, host)[0]


def test_a_websocket_is_for_pages_of_this_server_alone(command):
    """A name that is bound to 127.0.0.1 has the same host and origin, and is refused all the same."""
    port = command.port
    for host in ("localhost", "127.0.0.1", "[::1]"):
        assert upgraded(command, f"http://{host}:{port}", f"{host}:{port}") == 101
    for host in (
        "evil.example",
        *(f"{each}:{port}" for each in ("evil.example", "127.0.0.1.evil.example", "192.0.2.1")),
    ):
        assert upgraded(command, f"http://{host}", host) == 403
        same = {"Sec-Fetch-Site": "same-origin"}
        assert upgraded(command, f"http://{host}", host, **same) == 403
    # Another server of this machine, and a page of a sandbox.
    for origin in ("http://127.0.0.1:1", "null", "http://[", f"http://localhost:{port}@evil.example"):
        assert upgraded(command, origin, f"127.0.0.1:{port}") == 403


def test_own_addresses_are_those_at_the_port_that_is_served():
    assert same_loopback_origin("http://127.0.0.1", "127.0.0.1", 80)
    assert not same_loopback_origin("http://127.0.0.1:8000", "127.0.0.1:8000", 80)
    assert not same_loopback_origin("http://0.0.0.0:80", "0.0.0.0:80", 80)


def test_a_page_at_a_name_that_is_not_allowed_says_so(command, browser):
    """The name is bound to this machine, as that of a neighbour, or of an attacker, can be."""
    rule = "--host-resolver-rules=MAP lab.example 127.0.0.1"
    other = browser.browser_type.launch(executable_path=CHROMIUM, args=[*FLAGS, rule])
    try:
        page = other.new_page()
        page.goto(f"http://lab.example:{command.port}/app")
        page.get_by_role("alert").filter(has_text=f"lab.example:{command.port}").wait_for()
    finally:
        other.close()


def test_of_the_headers_and_cookies_of_a_request_the_page_has_the_host_and_the_theme(command):
    secret = "of-a-single-sign-on"
    secrets = {"Authorization": f"Bearer {secret}", "X-Remote-User": secret}
    for path in ("/app", "/app?fit"):
        _, _, body = get(command, path, secrets | {"Cookie": f"session={secret}; dark=1"})
        payload = get_token_payload(re.search(r'"token":"([^"]+)"', body.decode())[1])
        assert payload["cookies"] == {"dark": "1"}
        assert list(payload["headers"]) == ["Host"]
        assert secret not in str(payload)


def test_each_answer_says_that_types_are_not_guessed(command):
    for path in (
        "app?fit", "app?theory", "app/theory.html", "app/static/parts.js", "static/js/bokeh.min.js",
        "nothing", "app/metadata",
    ):  # fmt: skip
        _, headers, _ = get(command, f"/{path}")
        assert headers["X-Content-Type-Options"] == "nosniff"
        assert headers["Referrer-Policy"] == "same-origin"
        # Lecturers embed the page.
        assert "X-Frame-Options" not in headers


@pytest.fixture(scope="module")
def fresh(browser, tmp_path_factory):
    """A server whose temporary folder has nothing else, where the log says what is logged."""
    folder = tmp_path_factory.mktemp("temporary")
    server = Server(program=PROGRAM, environment={"TMPDIR": str(folder)})
    server.folder = folder
    yield server
    server.stop()
    # Nothing of a file is left.
    assert [*folder.iterdir()] == []


#: A link to a sample with its tip.
GEL = "fit&file=Gel,+AFM,+colloid+of+10+µm.csv&tip=paraboloid&radius=1e-05&medium=gel"


def children(server):
    """Processes that a server has started."""
    listed = Path(f"/proc/{server.process.pid}/task").glob("*/children")
    return [int(child) for each in listed for child in each.read_text().split()]


def test_a_request_alone_starts_no_process_and_keeps_no_file(fresh, context):
    """Also of a link to a sample; a page that has connected gets it."""
    for query in ("fit", GEL, ""):
        for _ in range(2):
            assert get(fresh, "/app?" + quote(query, safe="&=,+"))[0] == 200
    assert children(fresh) == []
    assert [*fresh.folder.iterdir()] == []
    # Warnings of the page's own parts are no news for those who read the log.
    assert "WARNING" not in fresh.log
    opened = Explorer(context.new_page(), f"{fresh.url}?{GEL}", READY)
    opened.page.locator(".big output", has_text="kPa").wait_for()
    assert len(children(fresh)) == 1
    assert opened.problems == []
    opened.page.close()


def drop(page, name, data):
    field = page.locator('.filepond--browser, input[type="file"]').first
    field.set_input_files({"name": name, "mimeType": "text/csv", "buffer": data})


def test_hostile_names_run_nothing(fresh, context):
    """Of files and their columns, of tips, and of all that a link names; names of sheets are not shown."""
    opened = Explorer(context.new_page(), f"{fresh.url}?fit", READY)
    page = opened.page

    def quiet():
        assert page.evaluate("window.run") is None
        assert page.locator("img[src=x], svg[onload]").count() == 0

    # In an element, and in an attribute.
    for k, text in enumerate(HOSTILE[:2]):
        # A browser sends the name without its folders.
        name = text.replace("/", "_") + ".csv"
        column = text.replace('"', "'")
        drop(page, name, f'"{column} h (nm)","{column} F"\n0,0\n1,1\n2,3\n'.encode())
        shown = " ".join(name.split())[:60]
        page.locator("p.refused", has_text=shown).first.wait_for()
        quiet()
        page.get_by_label("Column of depth").locator("option").nth(1).wait_for(state="attached")
        drop(page, name, b"h (nm), F (mN)\n0, 0\n1, 1\n2, 3\n")
        page.get_by_text("3 samples").wait_for()
        quiet()
        if k:
            continue
        page.get_by_label("Tip", exact=True).select_option(label="Measured tip, from a file")
        page.locator('.filepond--browser, input[type="file"]').nth(1).set_input_files(
            {"name": name, "mimeType": "text/csv", "buffer": f"{text}\n".encode()}
        )
        page.get_by_text(re.compile("no samples|expected|header")).first.wait_for()
        quiet()
        page.get_by_label("Tip", exact=True).select_option(index=0)
    names = "file", "tip", "depth_column", "radius", "curve"
    query = "&".join(f"{name}={quote(HOSTILE[0])}" for name in names)
    page.goto(f"{fresh.url}?fit&{query}")
    page.get_by_text(HOSTILE[0][:20]).first.wait_for()
    quiet()
    assert opened.problems == []
    page.close()
