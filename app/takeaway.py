"""What is taken away and brought: files, link and snippet, in a panel that opens below the buttons."""

from io import StringIO

import panel as pn

from . import export, link
from .parts import brought, button, decoded, field, html, panel, tools, upload
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
        files = [
            self._file("Report", "report.html", self._report),
            self._file("Curves (CSV)", "curves.csv", lambda: export.csv(page.way, page.explorer)),
            self._file(
                "Pressure (CSV)", "pressure.csv", lambda: export.pressure_csv(page.way, page.explorer)
            ),
            self._file("Sweep (CSV)", "sweep.csv", lambda: export.sweep_csv(page.way, page.explorer)),
            self._file("Scene (JSON)", "scene.json", lambda: link.scene_file(page.way)),
            self._file("Python", "scene.py", self._snippet),
        ]
        self.fit = self._file("Fit (CSV)", "fit.csv", lambda: export.fit_csv(page.way, page.explorer))
        scene = upload("scene", ".json,application/json", width=230, sizing_mode=None)
        brought(scene, self._bring)
        self.link = field(pn.widgets.TextInput, name="Link to this page")
        self.python = field(pn.widgets.TextAreaInput, name="This state with mdr_core", rows=9)
        rows = [tools(*files, self.fit), tools(html("Load a scene (JSON)", sizing_mode=None), scene)]
        for area in (self.link, self.python):
            copy = button("Copy", width=70)
            copy.js_on_click(args={"area": area}, code=_COPY)
            rows.append(tools(area, copy))
        self.panel = panel(page.take, *rows)
        page.take.param.watch(lambda event: self.show(), "value")

    @staticmethod
    def _file(label, name, write):
        options = {"callback": lambda: StringIO(write()), "filename": name, "label": label, "auto": True}
        return pn.widgets.FileDownload(css_classes=["button"], margin=0, **options)

    def show(self):
        """Link and snippet of what is seen, if it is looked at."""
        if not self.page.take.value:
            return
        query, curve = link.query(self.page.explorer), self.page.explorer.measured
        long = "This tip has too many samples for a link: save the scene as JSON."
        self.link.value = f"{self._here()}?{query}" if query else long
        self.python.value = self._snippet()
        self.fit.visible = curve is not None and curve.fit is not None
        alone = ", without the measured curve: that stays in its file"
        self.link.name = "Link to this page" + alone * (curve is not None)

    def _snippet(self):
        page, curve = self.page, self.page.explorer.measured
        text = export.python(page.way, page.held)
        if "sweep" in page.explorer.plots:
            text += export.sweep_python(page.explorer)
        if curve is not None and curve.fit is not None:
            text += export.fit_python(curve)
        return text

    def _report(self):
        page, held = self.page, [each.name for each in self.page.held]
        return report(page.explorer, page.drawn, page.grid.names, self._snippet(), self._here(), held)

    def _here(self):
        return pn.state.location.href.split("?")[0] if pn.state.location else ""

    def _bring(self, data):
        self.page.tell(lambda: link.load_scene(self.page.explorer, decoded(data)))
