"""The panel in which a measured curve is loaded, its columns corrected, and a medium fitted to it."""

from html import escape

import panel as pn

from . import measured
from .parts import WIDE, brought, button, field, fill, html, indexed, marked, plain, tools, upload
from .quantities import QUANTITIES, USED


class Measuring:
    """The panel *Fit a measurement* of a page, which opens below the buttons."""

    def __init__(self, page):
        self.page, self.explorer, self.controls = page, page.explorer, page.controls
        select, named = pn.widgets.Select, {QUANTITIES[n].label: n for n in measured.PARAMETERS}
        self.file = upload("curve", ".csv,.txt,.dat,text/csv")
        self.made, self.remove, self.fit = map(button, ("Example", "Remove", "Fit"))
        self.columns = {
            role: field(select, name=f"Column of {role}") for role in ("depth", "force", "time")
        }
        self.units = {
            role: field(select, name=f"Unit of {role}", options=list(sizes))
            for role, sizes in measured.SIZES.items()
        }
        self.holds = field(pn.widgets.CheckBoxGroup, name="Held", options=named, inline=True)
        self.about, self.said = html(), html("", "note", "said")
        self.controls.rows["noise"].param.update(sizing_mode=None, width=400)
        # Without widths of their own parts give way where a page is narrow.
        self.place, self.noise = tools(), tools()
        choices = [
            part[role] for role in self.columns for part in (self.columns, self.units) if role in part
        ]
        held = html("Held in the fit:", width=90, sizing_mode=None)
        self.rest = pn.Column(tools(*choices), self.place, tools(held, self.holds), self.noise, **WIDE)
        file = tools(html("Depth and force as CSV, drop or choose:"), self.file, self.made, self.remove)
        left = pn.Column(file, self.about, self.rest, css_classes=["measuring"], margin=0)
        look = {"css_classes": ["away", "fitting"], "visible": page.measure}
        self.panel = pn.Row(left, self.said, **look, **WIDE)
        self._watch()

    def _watch(self):
        brought(self.file, self._bring)
        self.made.on_click(lambda event: self._take(lambda: measured.example(self.explorer)))
        self.remove.on_click(lambda event: self._take(lambda: None))
        self.fit.on_click(lambda event: self._do(lambda: measured.fit(self.explorer), self.said))
        for part in (self.columns, self.units):
            for role, widget in part.items():
                widget.param.watch(lambda event, role=role: self._correct(role, event.new), "value")
        self.holds.param.watch(lambda event: self.explorer.param.update(holds=event.new), "value")

    def _do(self, act, where):
        """Make a change; a refusal stands where it was made."""
        try:
            self.page.attempt(act)
        except ValueError as error:
            self.show()
            where.object = f'<span class="refused">{escape(str(error))}</span>'

    def _take(self, make):
        self._do(lambda: self.explorer.take_curve(make()), self.about)

    def _bring(self, data):
        self._take(lambda: measured.read_curve(data, self.file.filename))

    def _correct(self, role, chosen):
        curve = self.explorer.measured
        if curve and chosen not in (curve.columns[role], curve.units.get(role)):
            self._do(lambda: self.explorer.param.update(measured=curve.corrected(role, chosen)), self.about)

    def show(self):
        """Show the curve as it is taken, and what was fitted."""
        explorer, curve = self.explorer, self.explorer.measured
        self.rest.visible, self.remove.disabled = curve is not None, curve is None
        self.holds.value = list(explorer.holds)
        self.said.object = self._result()
        if curve is None:
            self.about.object = "It lies over the model then, and the medium can be fitted to it."
            return
        made = f" {marked(measured.MADE)}" if curve.made else ""
        self.about.object = f"<b>{escape(curve.name)}</b>: {escape(curve.note)}.{made}"
        number = self.controls.number
        fill(self.place, [number(name) for name in measured.PLACE])
        noise = [number(name) for name in USED["noise"][explorer.noise]]
        fill(self.noise, [self.controls.rows["noise"], *noise, self.fit])
        heads = {f"{k + 1}: {head}".rstrip(": "): k for k, head in enumerate(curve.heads)}
        for role, widget in self.columns.items():
            options = heads | ({"none, rows in order": -1} if role == "time" else {})
            widget.param.update(options=options, value=curve.columns[role])
        for role, widget in self.units.items():
            widget.value = curve.units[role]

    def _result(self):
        curve = self.explorer.measured
        if curve is None or curve.fit is None:
            return ""
        said = "What is set on the page is not this fit any more."
        if measured.agrees(self.explorer):
            said = "Its values are those set on the page; Undo takes it back."
        said += " Save it as CSV or Python under Take with you."
        return said + indexed(plain(curve.fit._repr_html_()))
