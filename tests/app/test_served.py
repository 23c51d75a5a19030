"""The page as it is served to others: another's markup, a fault of the solver, a server that goes away."""

import os
import re
from pathlib import Path

import pytest

import mdr_core as mdr
from app.state import Explorer as State

from .conftest import CHROMIUM, Explorer, Server
from .deployed import Proxy, deployed
from .test_page import DROP, assert_draws, now

# Where the browser is required its absence is a failure.
pytestmark = pytest.mark.skipif(
    not Path(CHROMIUM).exists() and os.environ.get("MDR_BROWSER") != "required",
    reason="the page's tests need Chromium; set CHROMIUM to its path",
)

MARKUP = "<img src=x onerror=alert(1)>"


def serve(proxy, port=0):
    """A server as it is deployed, whose solver fails at one depth."""
    options = deployed(f"127.0.0.1:{proxy.port}")
    server = Server(*options, "--setup", "tests/app/fault.py", port=port)
    proxy.target = server.port
    return server


@pytest.fixture(scope="module")
def proxy():
    proxy = Proxy()
    yield proxy
    proxy.stop()


def test_page_comes_back_with_what_it_showed(proxy, context):
    """Once its connections have been reset, and once its server has died."""
    server = serve(proxy)
    page = context.new_page()
    try:
        explorer = Explorer(page, f"http://127.0.0.1:{proxy.port}/app")
        with explorer.change():
            explorer.type("d_max", "13.5 nm")
        assert_a_fault_is_told(explorer, server)
        explorer.link()
        proxy.cut()
        assert_comes_back(explorer)
        server.stop(kill=True)
        page.wait_for_selector("main[data-lost]")
        server = serve(proxy)
        assert_comes_back(explorer)
        assert explorer.off_host() == []
    finally:
        page.close()
        server.stop()


def assert_comes_back(explorer):
    explorer.page.wait_for_selector("main[data-lost]")
    assert "connection is lost" in explorer.page.locator(".notice").last.inner_text()
    explorer.page.wait_for_function(
        "!('lost' in (explorer.main()?.dataset ?? {lost: 0})) && explorer.idle()"
    )
    state = State()
    state.set("max_depth", 13.5e-9)
    assert_draws(explorer, state)


def assert_a_fault_is_told(explorer, server):
    kept = now(explorer)
    explorer.type("d_max", "13 nm")
    explorer.page.wait_for_function("explorer.notices() === 1 && explorer.idle()")
    assert "fault of the explorer" in explorer.page.locator(".notice").inner_text()
    assert now(explorer) == kept
    assert server.log.count("ArithmeticError: made to fail") == 1
    logged = re.search(r"scene (\{.*?\n\})", server.log, re.DOTALL)[1]
    assert mdr.Scene.from_json(logged).drive.depth == pytest.approx(13e-9)
    with explorer.change():
        explorer.type("d_max", "12 nm")
    with explorer.change():
        explorer.type("d_max", "13.5 nm")


def test_text_of_others_is_never_markup(explorer, tmp_path):
    scene = mdr.Scene(mdr.Cone(0.5), mdr.Medium(2e9, 5.0), mdr.DepthPath(5e-9)).to_json()
    files = [
        ("Load a tip", f"{MARKUP} (nm), z (nm)\n0, 0\n1, {MARKUP}\n"),
        ("Load a tip", f"r (nm), z ({MARKUP})\n0, 0\n1, 1\n"),
        ("Load a scene", scene.replace("Cone", MARKUP)),
        ("Load a scene", scene.replace('"slope"', f'"{MARKUP}"')),
        ("Load a scene", scene.replace("mdr-scene", MARKUP)),
        ("Load a scene", MARKUP),
    ]
    path = tmp_path / "brought"
    told = []
    for label, text in files:
        path.write_text(text, encoding="utf-8")
        explorer.hush()
        explorer.bring(label, path)
        explorer.page.wait_for_function("explorer.notices() === 1")
        assert explorer.page.locator("main img:not([alt])").count() == 0
        told += explorer.page.locator(".notice").all_inner_texts()
    assert any("<img" in text for text in told)
    assert_draws(explorer, State())
    explorer.page.wait_for_function("location.search.includes('preset=')")
    for name in ("preset=", "shape="):
        explorer.page.goto(explorer.page.url.replace(name, f"{name}{MARKUP}", 1))
        explorer.page.wait_for_function("explorer.idle()")
        assert "link was not opened" in explorer.page.locator(".notice").first.inner_text()
        assert explorer.page.locator("main img:not([alt])").count() == 0
        explorer.page.wait_for_function("!location.search.includes('img')")


def test_speed_against_error_is_measured_while_it_is_looked_at(explorer):
    page = explorer.page
    page.locator("h1").click()
    page.keyboard.press("s")
    page.wait_for_function("explorer.figure('speed') !== undefined && explorer.idle()")
    said = page.locator(".compared p").first
    # How far the chains come within the cap is the machine's business.
    page.wait_for_function(
        "/n elements|chains beyond/.test(explorer.main().querySelector('.compared').innerText)"
    )
    assert said.inner_text().startswith("Used on this page: closed form, the cheapest exact one: without")
    assert 3 <= len(explorer.column("speed", "chain", "x")) <= 8
    assert explorer.column("speed", "used on this page", "x") == explorer.column(
        "speed", "closed form", "x"
    )
    assert page.locator(".compared tr").count() == 4
    # The report's figure, without a request.
    page.locator(".compared summary").click()
    page.wait_for_function("explorer.main().querySelector('.compared img').naturalWidth > 0")
    explorer.choose("Preset", DROP)
    page.wait_for_function("explorer.column('speed', 'scalar ODE', 'y').length === 1")
    page.wait_for_function("!/measuring/.test(explorer.main().querySelector('.compared').innerText)")
    error = explorer.column("speed", "chain", "y")
    assert 0 < error[-1] <= error[0] < 1e-3
    traffic = explorer.listen()
    page.locator("h1").click()
    page.keyboard.press("s")
    page.wait_for_function("explorer.idle()")
    assert page.locator('[data-plot="speed"]').is_hidden()
    explorer.choose("Preset", next(iter(page.locator("select").first.locator("option").all_inner_texts())))
    page.wait_for_timeout(500)
    assert not any('"compare"' in text and '["on",true]' in text for text in traffic())
