"""The panel in which a measured curve is loaded, its columns corrected, and a medium fitted to it."""

from html import escape

import panel as pn

from . import measured
from .controls import WIDE, html, indexed, marked
from .quantities import QUANTITIES, USED


class Measuring:
    """The panel *Fit a measurement* of a page, which opens below the buttons."""

    def __init__(self, page):
        self.page, self.explorer = page, page.explorer
        plain, look = {"css_classes": ["button"], "margin": 0}, {"css_classes": ["choice"], **WIDE}
        # Without widths of their own parts give way where a page is narrow.
        row = {"css_classes": ["tools"], **WIDE}
        self.file = pn.widgets.FileInput(
            accept=".csv,.txt,.dat,text/csv", css_classes=["file", "curve"], **WIDE
        )
        self.made, self.remove, self.fit = (
            pn.widgets.Button(name=name, **plain) for name in ("Example", "Remove", "Fit")
        )
        self.columns = {
            role: pn.widgets.Select(name=f"Column of {role}", **look) for role in ("depth", "force", "time")
        }
        self.units = {
            role: pn.widgets.Select(name=f"Unit of {role}", options=list(sizes), **look)
            for role, sizes in measured.SIZES.items()
        }
        named = {QUANTITIES[n].label: n for n in measured.PARAMETERS}
        self.holds = pn.widgets.CheckBoxGroup(name="Held", options=named, inline=True, **look)
        self.about, self.said = html(""), html("", css_classes=["note", "said"])
        self.place, self.noise = pn.Row(**row), pn.Row(**row)
        head = html("Depth and force as CSV, drop or choose:")
        choices = [x for role in self.columns for x in (self.columns[role], self.units.get(role)) if x]
        held = html("Held in the fit:", width=90, sizing_mode="fixed")
        page.controls.rows["noise"].param.update(sizing_mode="fixed", width=400)
        choices, holds = pn.Row(*choices, **row), pn.Row(held, self.holds, **row)
        self.rest = pn.Column(choices, self.place, holds, self.noise, **WIDE)
        file = pn.Row(head, self.file, self.made, self.remove, **row)
        left = pn.Column(file, self.about, self.rest, css_classes=["measuring"], margin=0)
        self.panel = pn.Row(left, self.said, css_classes=["away", "fitting"], visible=False, **WIDE)
        self._watch()

    def _watch(self):
        self.page.measure.param.watch(lambda event: self.panel.param.update(visible=event.new), "value")
        self.file.param.watch(self._bring, "value")
        self.made.on_click(lambda event: self._take(lambda: measured.example(self.explorer), self.about))
        self.remove.on_click(lambda event: self._take(lambda: None, self.about))
        self.fit.on_click(lambda event: self._do(lambda: measured.fit(self.explorer), self.said))
        for part in (self.columns, self.units):
            for role, widget in part.items():
                widget.param.watch(lambda event, role=role: self._correct(role, event.new), "value")
        self.holds.param.watch(lambda event: self.explorer.param.update(holds=event.new), "value")

    def _do(self, act, field):
        """Make a change; a refusal stands at its field."""
        try:
            self.page.attempt(act)
        except ValueError as error:
            self.show()
            field.object = f'<span class="refused">{escape(str(error))}</span>'

    def _take(self, make, field):
        self._do(lambda: self.explorer.take_curve(make()), field)

    def _bring(self, event):
        if event.new:
            self._take(lambda: measured.read_curve(event.new, self.file.filename or "the file"), self.about)

    def _correct(self, role, chosen):
        curve = self.explorer.measured
        known = curve and (curve.columns[role], curve.units.get(role))
        if curve and chosen not in known:
            self._do(
                lambda: self.explorer.param.update(measured=curve.corrected(**{role: chosen})), self.about
            )

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
        controls = self.page.controls
        used = [*measured.PLACE, *USED["noise"][explorer.noise]]
        numbers = [controls.number(name) for name in used]
        for row, parts in (
            (self.place, numbers[:3]),
            (self.noise, [controls.rows["noise"], *numbers[3:], self.fit]),
        ):
            if parts != list(row):
                row[:] = parts
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
        stale = (
            "" if measured.agrees(self.explorer) else "What is set on the page is not this fit any more. "
        )
        back = "Its values are those set on the page; Undo takes it back. " if not stale else ""
        return (
            f"{stale}{back}Save it as CSV or Python under Take with you.{indexed(curve.fit._repr_html_())}"
        )
