"""The left column: the file and how it is read, the tip, the sample, and the parameters of the fit."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import panel as pn

from mdr_core.reading import SIZES

from ..tip import MAX_BYTES as TIP_BYTES
from ..ui import WIDE, html, own_html, show
from .dropper import MAX_BYTES, Dropper
from .preview import drawing
from .refusals import NOTHING, Message
from .said import Said
from .setting import CORRECTIONS, IN_TIME, MEDIA, NUMBERS, TIPS, Setting, parameter
from .told import heads_of, of_parts
from .typed import GROUP, Typed, field, heading

_FOCUS = Path(__file__).with_name("focus.js").read_text(encoding="utf-8")
#: What holds for every number, which no remark repeats.
_HELP = own_html(Path(__file__).with_name("help.html"))
#: The option for no column, and for one that is still to be chosen.
_NONE, _ASK = "none", "choose"
#: The options for one curve of a table, and for curves or parts of one side by side.
_ONE, _PAIRS, _SEGMENTS = "whole", "pairs", "segments"


class Form:
    """The left column of a page, shown for a setting; what is set goes to `change(make)` of the page."""

    def __init__(self, page: Any):
        self._page = page
        self._quiet = False
        # Columns of several parts, and what their options mean to the reader.
        self._layouts: list[dict[str, Any]] = []
        self._several: dict[str, Any] = {}
        self._file()
        self._reader()
        self._tip()
        self._medium()
        self._moduli()
        parts = [
            heading("1 · Curve"), self.drop, self.samples, self.about, self.refused.view, self.reader,
            heading("2 · Tip"), self.tip, self.tip_file, self.of_tip, self.tip_refused.view,
            self.numbers["radius"].view, self.numbers["half_angle"].view,
            heading("3 · Sample"), self.medium, self.more, self.parameters, self.help, self._to,
        ]  # fmt: skip
        self.view = pn.Column(*parts, css_classes=["asked"], width=360, margin=0)

    # The parts.

    def _file(self) -> None:
        label = f"Drop a file of depth and force here (up to {MAX_BYTES / 1e6:g} MB)"
        self.drop = Dropper(self._page.take_file, self._page.worker.start, MAX_BYTES, label=label)
        self.samples = pn.Row(css_classes=["tools"], **WIDE)
        for label, name in (("Sample: fused silica", "silica"), ("Sample: gel by AFM", "gel")):
            button = pn.widgets.Button(label=label, css_classes=["button"], margin=0)
            button.on_click(lambda event, name=name: self._page.take_sample(name))
            self.samples.append(button)
        self.about, self.refused = html("", "note"), Said(self._page, alert=True)
        # The name of the field to be led to, and how often one was.
        self._to = pn.widgets.TextInput(visible=False)
        self._to.jscallback(value=_FOCUS)
        self._led = 0

    def _reader(self) -> None:
        """What a file lacks: spring constant, sensitivity, columns and their units."""
        self.numbers = {
            name: Typed(name, known, lambda value, name=name: self._put(name, value))
            for name, known in NUMBERS.items()
        }
        select = pn.widgets.Select
        self.columns = {role: field(select, f"to-{role}", label=f"Column of {role}") for role in SIZES}
        self.units = {
            role: field(select, f"to-unit-{role}", label=f"Unit of {role}", options=[_ASK, *sizes])
            for role, sizes in SIZES.items()
        }
        for role in SIZES:
            for widget in (self.columns[role], self.units[role]):
                widget.param.watch(self._told, "value")
        meanings = {"the depth of the tip": "depth", "the position of a piezo": "piezo"}
        self.meaning = field(select, label="The depth is", options=meanings)
        self.parts = field(select, "to-by", label="The table has", options={"one curve": _ONE})
        for widget in (self.meaning, self.parts):
            widget.param.watch(self._told, "value")
        self.preview = html("", "note", visible=False)
        self.confirm = pn.widgets.Button(label="Read", css_classes=["button"], margin=0, visible=False)
        self.confirm.on_click(lambda event: self._confirmed())
        depth, *others = [
            pn.Row(self.columns[role], self.units[role], css_classes=["pair"], **WIDE) for role in SIZES
        ]
        parts = [self.preview, depth, self.meaning, *others, self.parts, self.confirm]
        self._of_table = pn.Column(*parts, **WIDE)
        self._of_cantilever = pn.Column(
            self.numbers["spring_constant"].view, self.numbers["sensitivity"].view, **WIDE
        )
        self.reader = pn.Card(
            self._of_table, self._of_cantilever, title="How the file is read", collapsed=True,
            css_classes=["fold"], visible=False, **WIDE,
        )  # fmt: skip

    def _tip(self) -> None:
        options = {"choose the tip": ""} | {tip.label: name for name, tip in TIPS.items()}
        self.tip = field(pn.widgets.Select, "to-profile", label="Tip", options=options)
        self.tip.param.watch(lambda event: self._change(lambda s: s.replace(tip=event.new)), "value")
        label = "Drop the file of the tip, radii and heights, here"
        self.tip_file = Dropper(self._page.take_tip, lambda: None, TIP_BYTES, label=label, visible=False)
        self.of_tip, self.tip_refused = html("", "note"), Said(self._page, alert=True)

    def _medium(self) -> None:
        options = {"choose the kind of sample": ""} | {kind.label: name for name, kind in MEDIA.items()}
        self.medium = field(pn.widgets.Select, label="Sample", options=options)
        self.medium.param.watch(lambda event: self._page.choose_medium(event.new), "value")
        self.free: dict[str, Any] = {}
        self.held: dict[str, Typed] = {}
        names = dict.fromkeys(name for kind in MEDIA.values() for name in kind.free)
        self._rows: dict[str, Any] = {}
        for name in (*names, "tilt", *CORRECTIONS):
            typed = Typed(name, parameter(name), lambda value, name=name: self._page.hold(name, value))
            self.held[name] = typed
            free = pn.widgets.Checkbox(label="free", css_classes=["free"], margin=0, width=48)
            free.param.watch(lambda event, name=name: self._page.free(name, event.new), "value")
            if name not in CORRECTIONS:
                self.free[name] = free
                typed.row.insert(1, free)
            self._rows[name] = typed.view
        rows = heading("Model", GROUP), *self._rows.values()
        self.parameters = pn.Column(*rows, css_classes=["parameters"], visible=False, **WIDE)

    def _moduli(self) -> None:
        names = ("poisson", "tip_modulus", "tip_poisson")
        note = html(
            "With ν the page gives Young’s modulus E of the sample; a tip without a modulus is rigid."
        )
        look = {"collapsed": True, "css_classes": ["fold"], **WIDE}
        self.more = pn.Card(
            note,
            *(self.numbers[name].view for name in names),
            title="Young’s modulus of the sample",
            **look,
        )
        self.help = pn.Card(html(_HELP), title="What the number assumes", **look)

    # What is set.

    def _change(self, make: Callable[[Setting], Setting]) -> None:
        if not self._quiet:
            self._page.change(make)

    def _put(self, name: str, value: float) -> None:
        if name in ("spring_constant", "sensitivity"):
            self._page.reread(**{name: value})
        else:
            self._change(lambda setting: setting.replace(**{name: value}))

    def _told(self, event: Any) -> None:
        """Read a file that was read again, once its columns and units are told; a question is confirmed."""
        if self._quiet:
            return
        if self._page.question is None:
            self._confirmed()
        else:
            # What is drawn is what was suggested.
            show(self.preview, visible=False)

    def _confirmed(self) -> None:
        """Read the file as the choosers say."""
        given: dict[str, Any] = {}
        for role in SIZES:
            column, unit = self.columns[role].value, self.units[role].value
            key = self.meaning.value if role == "depth" else role
            if column == _NONE and role == "time":
                given[key] = None
            elif column not in (_NONE, _ASK) and unit != _ASK:
                given[key] = (column, unit)
        if not ({"depth", "piezo"} & given.keys() and "force" in given):
            self.refused.show(Message("Choose the columns of depth and force, and their units"))
            return
        by = self._several.get(self.parts.value, self.parts.value)
        layouts = self._layouts
        if layouts and self.parts.value in (_PAIRS, _SEGMENTS):
            self._page.reread(columns=of_parts(layouts, given), by=by)
        else:
            self._page.reread(columns=given, by=by)

    def focus(self, name: str) -> None:
        """Lead to a field by its name, as "drag", or "unit-depth" for the unit of depth."""
        show(self.reader, collapsed=False)
        self._led += 1
        show(self._to, value=f"to-{name} {self._led}")

    # What is shown.

    def show(self, setting: Setting) -> None:
        """Show a setting, and what the page knows of the file."""
        self._quiet = True
        try:
            self._show(setting)
        finally:
            self._quiet = False

    def _show(self, setting: Setting) -> None:
        page = self._page
        show(self.about, object=page.about)
        self.refused.show(page.refused)
        show(self.tip, value=setting.tip)
        show(self.tip_file, visible=setting.tip == "measured")
        show(self.of_tip, object=page.of_tip, visible=setting.tip == "measured")
        self.tip_refused.show(page.tip_refused if setting.tip == "measured" else NOTHING)
        show(self.medium, value=setting.medium)
        asked = TIPS[setting.tip].numbers if setting.tip else ()
        for name, typed in self.numbers.items():
            typed.show(getattr(setting, name))
            show(typed.view, visible=name in asked or name not in ("radius", "half_angle"))
        self._show_reader(setting)
        self._show_parameters(setting)

    def _show_reader(self, setting: Setting) -> None:
        page = self._page
        table = page.table
        show(self.reader, visible=table is not None or bool(page.wants))
        if page.wants:
            show(self.reader, collapsed=False)
        show(self._of_table, visible=table is not None and not page.is_afm)
        show(
            self._of_cantilever,
            visible=page.is_afm
            or bool(page.wants & {"spring_constant", "sensitivity"})
            or table is not None,
        )
        if table is None:
            return
        question = page.question
        known, by = self._suggested(setting)
        self._layouts = known if isinstance(known, list) else []
        known = dict(known[0] if isinstance(known, list) else known)
        if "piezo" in known:
            known["depth"] = known.pop("piezo")
            show(self.meaning, value="piezo")
        else:
            show(self.meaning, value="depth")
        heads = heads_of(table)
        for role in SIZES:
            column = known.get(role)
            nothing = (
                {"none, rows in order": _NONE} if role == "time" else {"choose": _ASK} if not column else {}
            )
            number, unit = column or (_NONE if role == "time" else _ASK, _ASK)
            number = number if number in heads.values() else _ASK
            show(self.columns[role], options=nothing | heads, value=number)
            show(self.units[role], value=unit if unit in SIZES[role] else _ASK)
        self._show_parts(table, by)
        drawn = drawing(question.preview) if question is not None else ""
        show(self.preview, object=drawn, visible=bool(drawn))
        show(self.confirm, visible=question is not None)

    def _suggested(self, setting: Setting) -> tuple[Any, Any]:
        """Columns and what parts the curves, as they are suggested, told or read."""
        question, curve = self._page.question, self._page.curve
        if question is not None:
            return question.suggestion.get("columns") or {}, question.suggestion.get("by")
        if isinstance(setting.columns, list) or curve is None:
            return setting.columns, setting.by
        return curve.columns, setting.by

    def _show_parts(self, table: Any, by: Any) -> None:
        """What may part the curves of a table, with what is suggested or told."""
        options: dict[str, Any] = {"one curve": _ONE}
        self._several = {_ONE: None if by is None else "whole", _PAIRS: None}
        if self._layouts:
            options = {f"{len(self._layouts)} pairs of columns": _PAIRS}
            if len(self._layouts) > 1:
                options["loading and unloading side by side"] = _SEGMENTS
            value = _SEGMENTS if by == "segments" else _PAIRS
        else:
            names = heads_of(table, table.words)
            options |= {f"a curve for each value of {name}": str(k) for name, k in names.items()}
            self._several |= {str(k): k for k in names.values()}
            options["curves parted by empty lines or words"] = "gaps"
            options["curves where the depth starts anew"] = "restart"
            if by == "segments":
                options["loading and unloading below each other"] = "segments"
            if isinstance(by, list):
                of = " and ".join(name for name, k in names.items() if k in by)
                options[f"a curve for each value of {of}"] = value = ",".join(map(str, by))
                self._several[value] = by
            value = _ONE if by in (None, "whole") else value if isinstance(by, list) else str(by)
        show(self.parts, options=options, value=value)

    def _show_parameters(self, setting: Setting) -> None:
        page = self._page
        show(self.parameters, visible=bool(setting.medium))
        if not setting.medium:
            return
        timed = page.curve is None or page.curve.time is not None
        names = setting.parameters(timed)
        corrections = [name for name in CORRECTIONS if timed or name not in IN_TIME]
        if not setting.kind.letter:
            corrections.remove("depth_noise")
        for name, row in self._rows.items():
            show(row, visible=name in names or name in corrections)
        for name in names:
            free = name not in setting.held
            show(self.free[name], value=free)
            found = page.value_of(name) if free else ""
            # A free parameter shows what was found.
            self.held[name].show(
                None if free else setting.held[name], disabled=free, placeholder=found or "free"
            )
        for name in corrections:
            self.held[name].show(page.correction(name), placeholder=self.held[name].zero)
