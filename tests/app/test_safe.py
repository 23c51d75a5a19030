"""The page on a server that is open to all: hostile requests, names and links."""

import ast
import re
from contextlib import closing
from http.client import HTTPConnection

import pytest
from bokeh.util.token import get_token_payload

from app import ui
from app.private import is_own

from .conftest import CHROMIUM, FLAGS, ROOT, Explorer, Server

PROGRAM = ("-c", "import mdr_explorer; mdr_explorer.main()")
SECRET = "of-a-single-sign-on"


@pytest.fixture(scope="module")
def command(browser):
    """`mdr-explorer` as it is started by hand."""
    server = Server(program=PROGRAM)
    yield server
    server.stop()


def get(server, path, headers=None, host=None):
    """Status, headers and body of an answer."""
    with closing(HTTPConnection("127.0.0.1", server.port, timeout=60)) as connection:
        connection.request(
            "GET", path, headers={"Host": host or f"localhost:{server.port}"} | (headers or {})
        )
        answer = connection.getresponse()
        # A websocket that is accepted stays open.
        body = b"" if answer.status == 101 else answer.read()
        return answer.status, answer.headers, body


#: What runs where it is taken for HTML, in an attribute, a script or a text.
HOSTILE = (
    "<img src=x onerror=\"window.run = 1\">", "\"><svg onload='window.run = 1'>",
    "</script><script>window.run = 1</script>", "<b onclick=window.run=1>d_c</b>",
    "' autofocus onfocus='window.run = 1",
)  # fmt: skip


def test_a_text_is_shown_as_it_is_and_never_taken_for_html():
    for text in HOSTILE:
        makers = (ui.as_html, ui.marked, ui.symbol, ui.linked, ui.notice, lambda text: ui.html(text).object)
        for make in makers:
            found = make(text)
            own = re.sub(r"</?(i|sub)>", "", found)
            assert "<" not in own
        # In an attribute, too.
        assert '"' not in ui.as_html(text)
        assert "'" not in ui.as_html(text)


def test_html_is_made_of_literals_of_the_page_alone():
    """A text of somebody can only be formatted into HTML, which escapes it; `ui` reads own files."""
    made = 0
    for path in sorted((ROOT / "app").rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            called = isinstance(node, ast.Call) and ast.unparse(node.func).split(".")[-1]
            if called in ("Markup", "HTML"):
                literal = all(isinstance(each, ast.Constant) for each in node.args)
                assert literal or path.name == "ui.py", (path.name, node.lineno)
                made += 1
            # What is shown goes through `show`, which escapes.
            if isinstance(node, ast.Attribute) and isinstance(node.ctx, ast.Store):
                assert node.attr != "object", (path.name, node.lineno)
    assert made > 30


def test_an_address_of_a_component_imports_nothing(command):
    """`this` prints at its import; `unittest.__main__` ends the process that imports it."""
    modules = ("this", "antigravity", "app.main", "mdr_core.reading", "unittest.__main__")
    for prefix in ("", "/app"):
        for module in modules:
            assert get(command, f"{prefix}/components/{module}/x/y/z")[0] == 404
    assert get(command, "/components/this")[0] == 404
    assert get(command, "/app")[0] == 200
    assert "Beautiful is better than ugly" not in command.log
    assert command.faults == ""


def test_a_prefix_moves_components_away_with_all_else():
    server = Server("--prefix", "lab", program=PROGRAM)
    try:
        assert get(server, "/lab/components/unittest.__main__/x/y/z")[0] == 404
        assert get(server, "/lab/components/this/x/y/z")[0] == 404
        assert get(server, "/lab/app")[0] == 200
        assert "Beautiful" not in server.log
    finally:
        server.stop()


def upgraded(server, origin, host, **headers):
    """Status of a websocket that is asked for by a page of an origin at a host."""
    asked = {
        "Connection": "Upgrade", "Upgrade": "websocket", "Sec-WebSocket-Version": "13",
        "Sec-WebSocket-Key": "AAAAAAAAAAAAAAAAAAAAAA==",
    }  # fmt: skip
    return get(server, "/app/ws", asked | headers | {"Origin": origin}, host)[0]


def test_a_websocket_is_for_pages_of_this_server_alone(command):
    """A name that is bound to 127.0.0.1 has the same host and origin, and is refused all the same."""
    port = command.port
    for host in ("localhost", "127.0.0.1", "[::1]"):
        assert upgraded(command, f"http://{host}:{port}", f"{host}:{port}") == 101
    for host in (
        "evil.example",
        f"evil.example:{port}",
        f"127.0.0.1.evil.example:{port}",
        f"192.0.2.1:{port}",
    ):
        assert upgraded(command, f"http://{host}", host) == 403
        same = {"Sec-Fetch-Site": "same-origin"}
        assert upgraded(command, f"http://{host}", host, **same) == 403
    # Another server of this machine, and a page of a sandbox.
    for origin in ("http://127.0.0.1:1", "null", "http://[", f"http://localhost:{port}@evil.example"):
        assert upgraded(command, origin, f"127.0.0.1:{port}") == 403


def test_own_addresses_are_those_at_the_port_that_is_served():
    assert is_own("http://127.0.0.1", "127.0.0.1", 80)
    assert not is_own("http://127.0.0.1:8000", "127.0.0.1:8000", 80)
    assert not is_own("http://0.0.0.0:80", "0.0.0.0:80", 80)


def test_a_page_at_a_name_that_is_not_allowed_says_so(command, browser):
    """The name is bound to this machine, as that of a neighbour, or of an attacker, can be."""
    rule = "--host-resolver-rules=MAP lab.example 127.0.0.1"
    other = browser.browser_type.launch(executable_path=CHROMIUM, args=[*FLAGS, rule])
    try:
        page = other.new_page()
        page.goto(f"http://lab.example:{command.port}/app")
        said = f"--allow-websocket-origin lab.example:{command.port}"
        page.get_by_role("alert").filter(has_text=said).wait_for()
    finally:
        other.close()


def test_the_page_has_neither_headers_nor_cookies_of_its_request(command):
    secrets = {"Cookie": f"session={SECRET}", "Authorization": f"Bearer {SECRET}", "X-Remote-User": SECRET}
    for path in ("/app", "/app?fit", "/app/autoload.js?bokeh-autoload-element=1"):
        _, _, body = get(command, path, secrets)
        (token,) = re.findall(r'"token":"([^"]+)"', body.decode())
        payload = get_token_payload(token)
        assert payload["cookies"] == {}
        assert list(payload["headers"]) == ["Host"]
        assert SECRET not in str(payload)


def test_each_answer_says_that_types_are_not_guessed(command):
    for path in (
        "/app",
        "/app?fit",
        "/app/static/parts.js",
        "/static/js/bokeh.min.js",
        "/nothing",
        "/app/metadata",
    ):
        _, headers, _ = get(command, path)
        assert headers["X-Content-Type-Options"] == "nosniff"
        assert headers["Referrer-Policy"] == "same-origin"
        # Lecturers embed the page.
        assert "X-Frame-Options" not in headers


def test_the_page_works_at_both_of_its_addresses(command, browser):
    for url in (command.url, command.url.replace("localhost", "127.0.0.1")):
        with browser.new_context() as context:
            explorer = Explorer(context.new_page(), url)
            explorer.change(explorer.type, "d_max", "5 nm")
            assert explorer.problems == []
