"""Take the pictures of the page that stand in assets/.

Run from the project root: python -m tests.app.take_screenshots
"""

from app.state import PRESETS

from .conftest import CHROMIUM, DROP, FLAGS, ROOT, Explorer, Server


def main():
    from playwright.sync_api import sync_playwright

    server = Server()
    try:
        with sync_playwright() as playwright:
            browser = playwright.chromium.launch(executable_path=CHROMIUM, args=FLAGS)
            page = browser.new_page(viewport={"width": 1440, "height": 900})
            explorer = Explorer(page, server.url)
            page.screenshot(path=ROOT / "assets/explorer.png")
            explorer.choose("Preset", PRESETS[DROP].label)
            explorer.press("More about the medium")
            explorer.pick("η")
            explorer.page.get_by_label("Fourth plot").select_option(label="Energy")
            explorer.press("Dark")
            explorer.wait("document.documentElement.classList.contains('dark')")
            explorer.field("v_0").wait_for()
            page.screenshot(path=ROOT / "assets/explorer-impact.png")
            page = browser.new_page(viewport={"width": 400, "height": 800})
            Explorer(page, server.url)
            page.screenshot(path=ROOT / "assets/explorer-narrow.png", full_page=True)
            browser.close()
    finally:
        server.stop()


if __name__ == "__main__":
    main()
