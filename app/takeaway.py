"""What is taken away and brought: files, link and snippet, in a panel that opens below the buttons."""

from io import StringIO

import panel as pn

from . import export, link
from .controls import WIDE
from .report import report

_COPY = """
navigator.clipboard?.writeText(area.value).catch(() => {})
cb_obj.label = "Copied"
setTimeout(() => { cb_obj.label = "Copy" }, 1500)
"""


class TakeAway:
    """The panel *Take with you* of a page."""

    def __init__(self, page):
        self.page = page
        files = {
            ("Report", "report.html"): self._report,
            ("Curves (CSV)", "curves.csv"): lambda: export.csv(page.way, page.explorer),
            ("Pressure (CSV)", "pressure.csv"): lambda: export.pressure_csv(page.way, page.explorer),
            ("Sweep (CSV)", "sweep.csv"): lambda: export.sweep_csv(page.way, page.explorer),
            ("Scene (JSON)", "scene.json"): lambda: link.scene_file(page.way),
            ("Python", "scene.py"): self._snippet,
            ("Fit (CSV)", "fit.csv"): lambda: export.fit_csv(page.way, page.explorer),
        }
        look, plain = {"css_classes": ["choice"], **WIDE}, {"css_classes": ["button"], "margin": 0}
        row = {"css_classes": ["tools"], **WIDE}
        downloads = [
            pn.widgets.FileDownload(
                callback=lambda write=write: StringIO(write()),
                filename=name,
                label=label,
                auto=True,
                **plain,
            )
            for (label, name), write in files.items()
        ]
        self.fit = downloads[-1]
        self.scene = pn.widgets.FileInput(
            accept=".json,application/json", css_classes=["file", "scene"], width=230, margin=0
        )
        self.scene.param.watch(self._bring, "value")
        self.link = pn.widgets.TextInput(name="Link to this page", **look)
        self.python = pn.widgets.TextAreaInput(name="This state with mdr_core", rows=9, **look)
        title = pn.pane.HTML("Load a scene (JSON)", margin=0, css_classes=["note"])
        rows = [pn.Row(*downloads, **row), pn.Row(title, self.scene, **row)]
        for area in (self.link, self.python):
            copy = pn.widgets.Button(name="Copy", width=70, **plain)
            copy.js_on_click(args={"area": area}, code=_COPY)
            rows.append(pn.Row(area, copy, **row))
        self.panel = pn.Column(*rows, css_classes=["away"], visible=False, stylesheets=[], **WIDE)
        page.take.param.watch(self._open, "value")

    def _open(self, event):
        self.panel.visible = event.new
        self.show()

    def show(self):
        """Link and snippet of what is seen, if it is looked at."""
        if self.panel.visible:
            query, here = link.query(self.page.explorer), self._here()
            long = "This tip has too many samples for a link: save the scene as JSON."
            self.link.value = f"{here}?{query}" if query else long
            self.python.value = self._snippet()
            curve = self.page.explorer.measured
            self.fit.visible = curve is not None and curve.fit is not None
            alone = "Link to this page, without the measured curve: that stays in its file"
            self.link.name = "Link to this page" if curve is None else alone

    def _snippet(self):
        page = self.page
        sweep = export.sweep_python(page.explorer) if "sweep" in page.explorer.plots else ""
        curve = page.explorer.measured
        fit = export.fit_python(curve) if curve is not None and curve.fit is not None else ""
        return export.python(page.way, page.held) + sweep + fit

    def _report(self):
        page, held = self.page, [each.name for each in self.page.held]
        return report(page.explorer, page.drawn, page.grid.names, self._snippet(), self._here(), held)

    def _here(self):
        return pn.state.location.href.split("?")[0] if pn.state.location else ""

    def _bring(self, event):
        if event.new:
            text = event.new.decode("utf-8", "replace")
            self.page.tell(lambda: link.load_scene(self.page.explorer, text))
