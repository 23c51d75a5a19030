"""Take the pictures of the page in assets/, and the film in the README.

Run from the project root: python -m tests.app.take_screenshots
"""

from io import BytesIO

import numpy as np

from app.explorer.state import PRESETS

from .conftest import CHROMIUM, DROP, FLAGS, ROOT, Explorer, Server

#: Positions of the slider of the depth in the film, from that of the preset to below yield and back.
POSITIONS = np.append(np.linspace(200, 80, 11), np.linspace(80, 200, 21)[1:])
#: Duration (ms) of a picture of the film, and of the first one, at the depth of the preset.
MOVING, RESTING = 140, 1500


def film(explorer, path):
    """Drag the slider of the depth with the mouse, and save what is seen as an animated picture."""
    from PIL import Image

    page, slider = explorer.page, explorer.slider("d_max")
    box, steps = slider.bounding_box(), float(slider.get_attribute("max"))
    height, pictures = box["y"] + box["height"] / 2, []
    for position in POSITIONS:
        page.mouse.move(box["x"] + box["width"] * position / steps, height)
        if not pictures:
            page.mouse.down()
        # An answer of the server takes some 30 ms.
        page.wait_for_timeout(300)
        pictures.append(Image.open(BytesIO(page.screenshot())).convert("RGB"))
    page.mouse.up()
    small = [picture.resize((960, 540), Image.Resampling.LANCZOS) for picture in pictures]
    times = [RESTING] + [MOVING] * (len(small) - 1)
    small[0].save(
        path, save_all=True, append_images=small[1:], duration=times, loop=0, quality=55, method=6
    )


def main():
    from playwright.sync_api import sync_playwright

    server = Server()
    try:
        with sync_playwright() as playwright:
            browser = playwright.chromium.launch(executable_path=CHROMIUM, args=FLAGS)
            page = browser.new_page(viewport={"width": 1440, "height": 900})
            explorer = Explorer(page, server.url)
            explorer.choose("Preset", PRESETS[DROP].label)
            explorer.press("More about the medium")
            explorer.pick("η")
            explorer.page.get_by_label("Fourth plot").select_option(label="Energy")
            explorer.press("Dark")
            explorer.wait("document.documentElement.classList.contains('dark')")
            explorer.field("v_0").wait_for()
            page.screenshot(path=ROOT / "assets/explorer-impact.png")
            page = browser.new_page(viewport={"width": 1280, "height": 720})
            film(Explorer(page, server.url), ROOT / "assets/explorer.webp")
            page = browser.new_page(viewport={"width": 400, "height": 800})
            Explorer(page, server.url)
            page.screenshot(path=ROOT / "assets/explorer-narrow.png", full_page=True)
            browser.close()
    finally:
        server.stop()


if __name__ == "__main__":
    main()
