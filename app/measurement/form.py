"""The left column: file, tip, sample and parameters. Its widgets are part of the state of the page."""

from functools import partial
from math import inf
from pathlib import Path
from typing import Any

import panel as pn
from markupsafe import Markup

from mdr_core.measurements.reading import SIZES
from mdr_core.show.units import format_quantity

from ..common.errors import Refused
from ..common.folders import Files
from ..common.process import SynchronousWorker, Worker
from ..common.ui import WIDE, button, html, show
from ..common.upload import CURVE_BYTES, TIP_BYTES, Uploads, in_line
from . import texts
from .choices import CANTILEVER, CORRECTIONS, EXAMPLES, FITTED, IN_TIME, MEDIA, MODULI, NUMBERS, TIPS
from .widgets import ERROR, FileField, UnitInput, fold, select, show_errors

_PART, _GROUP = Markup("<h2>{}</h2>"), Markup('<h3 class="group">{}</h3>')
_FILE = Markup("<b>{}</b>{}: {} samples")
_UNREAD = Markup('<p class="refused">Not read: {}</p>')
_LINKED = Markup("This link was made with <b>{}</b>: drop that file here.")
#: Hints in empty fields of corrections.
_NO_CORRECTION = {"drift": "0 nm/s", "frame": "0 nm/mN", "depth_noise": "0 nm"}
#: Ways to part the curves of a table, other than by the values of a column.
_BY = {
    "one curve": "whole",
    "curves parted by empty lines or words": "gaps",
    "curves where the depth starts anew": "restart",
}
_CHOOSE = {"choose": ""}
#: Beginnings of the suffixes of AFM files, which are not tables.
_AFM = ".jpk", ".h5", ".hdf5", ".ibw", ".nid", ".zip"


class Form:
    """Left column of a page."""

    def __init__(self, page: Any):
        uploads, self._page = Uploads(), page
        self._tip_files, self._tip_worker = (
            Files(),
            Worker() if page.host.processes else SynchronousWorker(),
        )
        self.drop = FileField(
            uploads, CURVE_BYTES, partial(page.do, page.take_file), page.refuse,
            label=f"Drop files of depth and force, or a zip (up to {CURVE_BYTES / 1e6:g} MB)",
        )  # fmt: skip
        self.tip_file = FileField(
            uploads, TIP_BYTES, partial(page.do, self.take_tip), self.refuse_tip,
            label="Drop the file of the tip, radii and heights, here", visible=False,
        )  # fmt: skip
        self.about, self.errors, self.tip_about = html("", "note"), pn.Column(**WIDE), html("", "note")
        self.columns = Columns(page)
        self.numbers = {
            name: UnitInput(known, css_classes=["choice", "typed", f"to-{name}"])
            for name, known in (NUMBERS | FITTED).items()
        }
        tips = {"choose the tip": ""} | {each.label: name for name, each in TIPS.items()}
        media = {"choose the kind of sample": ""} | {each.label: name for name, each in MEDIA.items()}
        #: Radii and heights (m) of a measured tip.
        self.tip_samples: Any = None
        self.tip = select("Tip", tips, "to-profile", "named-above")
        self.medium = select("Sample", media, "named-above")
        acts = dict.fromkeys(CANTILEVER, page.read) | dict.fromkeys(MODULI, page.modulus_chosen)
        for name, widget in self.numbers.items():
            widget.param.watch(page.when_changed(acts.get(name, page.fit)), "si")
        self.tip.param.watch(page.when_changed(page.fit), "value")
        self.medium.param.watch(page.when_changed(page.medium_chosen), "value")
        self.view = self._column(page)

    def _column(self, page: Any) -> Any:
        """Return the widgets in a column."""
        number = self.numbers
        samples = pn.Row(css_classes=["tools"], **WIDE)
        for name, each in EXAMPLES.items():
            samples.append(button(each.button, partial(page.do, page.take_example, name)))
        self.cantilever = pn.Column(*(number[name] for name in CANTILEVER), **WIDE)
        reader = self.columns.view, show_errors(self.cantilever)
        self.reader = fold("How the file is read", *reader, visible=False)
        rows = (number[name] for name in (*FITTED, *CORRECTIONS))
        group = html(_GROUP.format("Model: an empty parameter is fitted"), "title")
        self.model = pn.Column(group, *rows, css_classes=["parameters"], visible=False, **WIDE)
        moduli = show_errors(pn.Column(*(number[name] for name in MODULI), **WIDE))
        parts = [
            html(_PART.format("1 · Curve"), "title"), self.drop, samples, self.about, self.errors,
            self.reader,
            html(_PART.format("2 · Tip"), "title"), self.tip, self.tip_file, self.tip_about,
            number["radius"], number["half_angle"],
            html(_PART.format("3 · Sample"), "title"), self.medium,
            fold("Young’s modulus of the sample", moduli), show_errors(self.model),
            fold("What the number assumes", html(texts.HELP)),
        ]  # fmt: skip
        return show_errors(pn.Column(*parts, css_classes=["asked"], width=360, margin=0))

    async def take_tip(self, name: str, data: bytes, began: float) -> None:
        """Read a measured tip, while a job on the curve may run."""
        name = in_line(name)
        show(self.tip_about, object=f"Reading {name} …")
        try:
            path = self._tip_files.keep(data)
            self.tip_samples, note = await self._tip_worker.run("common.tip.read", path, name)
        except Refused as error:
            self.refuse_tip(error.text)
        else:
            show(self.tip_about, object=note)
            await self._page.fit()

    def refuse_tip(self, text: str) -> None:
        """Show the reason why the file of a tip was rejected; keep the last tip."""
        stays = "" if self.tip_samples is None else "; the last tip stays"
        show(self.tip_about, object=ERROR.format(texts.sentence(f"{text.rstrip('.')}{stays}")))

    @property
    def is_afm(self) -> bool:
        """Whether the file of the page is an AFM file, not a table."""
        page = self._page
        if page.curve is not None:
            return page.curve.source.startswith("as afmformats")
        first = page.path if isinstance(page.path, str) else page.path[0]
        return page.question is None and Path(first).suffix.lower().startswith(_AFM)

    def close(self) -> None:
        """End the process that reads a tip, and remove its file."""
        self._tip_worker.stop()
        self._tip_files.clear()

    # Chosen values.

    def value(self, name: str) -> float | None:
        """Return a number (SI), or None if its field is empty."""
        return self.numbers[name].si

    def given(self, *names: str) -> dict[str, float]:
        """Return the typed numbers among `names`."""
        return {name: value for name in names if (value := self.value(name)) is not None}

    def request(self, timed: bool, samples: tuple[int, ...]) -> dict[str, Any]:
        """Return the argument `asked` of `analysis.fit`. Raises ValueError for an invalid tip."""
        medium, corrections = self.medium.value, self.corrections()
        request = {"profile": self.profile(), "medium": medium, "arguments": self.arguments(timed)}
        return request | {"corrections": corrections, "samples": samples}

    def modulus(self, quoted: Any) -> tuple[float, float] | None:
        """Return Young's modulus of the sample and its error (Pa), or None without Poisson's ratio."""
        materials = self.materials()
        return None if materials is None or quoted.value is None else quoted.sample_modulus(*materials)

    def materials(self) -> tuple[float, tuple[float, float] | None] | None:
        """Return Poisson's ratio of the sample, and modulus (Pa) and Poisson's ratio of the tip."""
        poisson, tip_modulus, tip_poisson = map(self.value, MODULI)
        tip = None if tip_modulus is None else (tip_modulus, tip_poisson or 0.0)
        return None if poisson is None else (poisson, tip)

    def settings(self) -> dict[str, str]:
        """Return tip, sample and typed numbers in words."""
        shown = {"tip": TIPS[self.tip.value].label, "kind of sample": MEDIA[self.medium.value].label}
        for name, value in self.unusual_numbers().items():
            known = (NUMBERS | FITTED)[name]
            shown[known.label] = "fitted" if value is None else format_quantity(value, known.kind)
        return shown

    def unusual_numbers(self) -> dict[str, float | None]:
        """Return numbers that differ from the defaults of the kind of sample; None for an empty field."""
        medium = self.medium.value
        first = dict.fromkeys(MEDIA[medium].at_zero if medium else (), 0.0)
        return {name: each.si for name, each in self.numbers.items() if each.si != first.get(name)}

    def corrections(self) -> dict[str, float]:
        """Return the corrections of the depth for `analysis.samples`."""
        return {name: value for name, value in self.given("drift", "frame").items() if value}

    def missing(self) -> str:
        """Return the name of a missing input of the fit, or an empty text."""
        if not self.tip.value:
            return "the tip"
        if self.tip.value == "measured" and self.tip_samples is None:
            return "the file of the tip"
        for name in TIPS[self.tip.value].numbers:
            if self.value(name) is None:
                return f"the {NUMBERS[name].label} {NUMBERS[name].symbol}"
        return "" if self.medium.value else "the sample"

    def profile(self) -> Any:
        """Return the indenter. Raises ValueError for an invalid tip."""
        known = TIPS[self.tip.value]
        sizes = [self.value(name) for name in known.numbers]
        return known.profile(*(self.tip_samples if self.tip.value == "measured" else sizes))

    def parameters(self, timed: bool) -> list[str]:
        """Return the names of the parameters of the kind of sample, with or without times."""
        if not self.medium.value:
            return []
        medium = MEDIA[self.medium.value]
        names = dict.fromkeys([*medium.fitted, *medium.at_zero])
        return [name for name in names if timed or name not in IN_TIME]

    def arguments(self, timed: bool) -> dict[str, Any]:
        """Return arguments of `mdr_core.fit_indentation`; None for a fitted parameter."""
        arguments: dict[str, Any] = {name: self.value(name) for name in self.parameters(timed)}
        if not MEDIA[self.medium.value].letter:
            return arguments | {"q_c": inf}
        return arguments | self.given("depth_noise")

    def set_medium(self, name: str) -> None:
        """Choose a kind of sample: clear the fields of its fitted parameters, and set the others to 0."""
        self.medium.value = name
        for each in FITTED if name else ():
            self.numbers[each].set(0.0 if each in MEDIA[name].at_zero else None)

    # Display.

    def show(self, page: Any) -> None:
        """Show the fields for the curve, the tip and the kind of sample."""
        tip, medium, curve = self.tip.value, self.medium.value, page.curve
        timed = curve is None or curve.time is not None
        names = self.parameters(timed)
        seen = dict.fromkeys(names, True) | {name: False for name in FITTED if name not in names}
        seen |= {name: bool(tip) and name in TIPS[tip].numbers for name in ("radius", "half_angle")}
        seen |= {"drift": timed, "depth_noise": bool(medium) and bool(MEDIA[medium].letter)}
        for name, visible in seen.items():
            show(self.numbers[name], visible=visible)
            if not visible:
                self.numbers[name].error = ""
        for name in names:
            text = (
                texts.value_of(page.found.fit, name)
                if page.found and self.value(name) is None
                else "fitted"
            )
            self.numbers[name].hint(text)
        noise = page.found.fit.depth_noise if page.found else 0.0
        found = {"depth_noise": format_quantity(float(noise), "length", 2)} if noise else {}
        for name, text in (_NO_CORRECTION | found).items():
            self.numbers[name].hint(text)
        show(self.model, visible=bool(medium))
        show(self.tip_file, visible=tip == "measured")
        show(self.tip_about, visible=tip == "measured")
        self._show_reader(page)

    def _show_reader(self, page: Any) -> None:
        """Show the options of the reader, unfolded if something is missing."""
        is_table, wanted, is_afm = page.table is not None, page.wanted, self.is_afm
        show(self.reader, visible=is_table or bool(wanted) or is_afm)
        if wanted:
            show(self.reader, collapsed=False)
        show(self.columns.view, visible=is_table and not is_afm)
        show(self.columns.confirm, visible=page.question is not None)

    def show_about(self, page: Any) -> None:
        """Show the name of the file, its number of samples, and unread files."""
        about = Markup("")
        if page.curve is not None:
            of = f", curve {page.results.number.value} of {page.count}" if page.count > 1 else ""
            about = _FILE.format(page.file, of, len(page.curve))
            about += Markup("").join(map(_UNREAD.format, page.unread))
        elif page.file and not page.path and not page.busy:
            about = _LINKED.format(page.file)
        show(self.about, object=about)


class Columns:
    """Choosers for the columns of a table."""

    def __init__(self, page: Any):
        roles = {role: f"to-{role}" for role in SIZES}
        self.columns = {role: select(f"Column of {role}", _CHOOSE, each) for role, each in roles.items()}
        self.units = {
            role: select(
                f"Unit of {role}", _CHOOSE | {unit: unit for unit in SIZES[role]}, f"to-unit-{role}"
            )
            for role in SIZES
        }
        meanings = {"the depth of the tip": "depth", "the position of a piezo": "piezo"}
        self.meaning, self.by = select("The depth is", meanings), select("The table has", {}, "to-by")
        self.confirm = button("Read", partial(page.do, page.read_as_chosen))
        for each in (*self.columns.values(), *self.units.values(), self.meaning, self.by):
            each.param.watch(page.when_changed(page.columns_changed), "value")
        depth, *others = [
            pn.Row(self.columns[role], self.units[role], css_classes=["pair"], **WIDE) for role in SIZES
        ]
        parts = depth, self.meaning, *others, self.by, self.confirm
        self.view = pn.Column(*parts, css_classes=["reader"], visible=False, **WIDE)
        # Shown columns of each part of a table, and shown option `by`.
        self._parts: list[dict[str, Any]] = []
        self._by: Any = None

    def show(self, table: Any, columns: Any, by: Any) -> None:
        """Show the suggested columns of a table, or the columns of the last reading."""
        self._parts, self._by = columns if isinstance(columns, list) else [], by
        # Show the first of several parts; the others have the same units.
        first = dict(columns[0] if self._parts else columns)
        self.meaning.value = "piezo" if "piezo" in first else "depth"
        first["depth"] = first.pop("piezo", first.get("depth"))
        heads = column_labels(table)
        for role in SIZES:
            number, unit = first.get(role) or ("", "")
            nothing = {"none, rows in order": ""} if role == "time" else _CHOOSE if number == "" else {}
            self.columns[role].param.update(options=nothing | heads, value=number)
            self.units[role].value = unit if unit in SIZES[role] else ""
        options, value = self._ways_to_part(table, by)
        self.by.param.update(options=options, value=value)

    def _ways_to_part(self, table: Any, by: Any) -> tuple[dict[str, Any], Any]:
        """Return the options that may part the curves, and the shown option."""
        if self._parts:
            options = {f"{len(self._parts)} pairs of columns": ""}
            if len(self._parts) > 1:
                options["loading and unloading side by side"] = "segments"
            return options, by or ""
        names = column_labels(table, table.words)
        options = _BY | {f"a curve for each value of {name}": k for name, k in names.items()}
        if by == "segments":
            options["loading and unloading below each other"] = by
        if isinstance(by, list):
            several = " and ".join(name for name, k in names.items() if k in by)
            options[f"a curve for each value of {several}"] = by
        return options, "whole" if by is None else by

    def options(self) -> dict[str, Any]:
        """Return the chosen options of `mdr_core.read_curves`. Raises ValueError if some are missing."""
        chosen: dict[str, Any] = {}
        for role in SIZES:
            column, unit = self.columns[role].value, self.units[role].value
            if column != "" and unit:
                chosen[self.meaning.value if role == "depth" else role] = (column, unit)
            elif role == "time" and column == "":
                chosen[role] = None
        if not ({"depth", "piezo"} & chosen.keys() and "force" in chosen):
            raise ValueError("Choose the columns of depth and force, and their units")
        by = self.by.value
        is_suggested = by == "" or (by == "whole" and self._by is None)
        columns = self._all_parts(chosen) if self._parts else chosen
        return {"columns": columns} | ({} if is_suggested else {"by": by})

    def _all_parts(self, chosen: dict[str, Any]) -> list[dict[str, Any]]:
        """Return the columns of all parts: the chosen first part, and the others with its units."""
        place, parts = "piezo" if "piezo" in chosen else "depth", [chosen]
        for part in self._parts[1:]:
            own = part | {place: part.get("piezo") or part["depth"]}
            parts.append(
                {role: (own[role][0], chosen[role][1]) for role in chosen if chosen[role] and own.get(role)}
            )
        return parts


def column_labels(table: Any, words: Any = ()) -> dict[str, int]:
    """Return column numbers by label: the name or the first values; `words` are columns of words."""
    firsts = {k: ", ".join(f"{x:.3g}" for x in values[:3]) for k, values in table.values.items()}
    found = {f"{k + 1}: {head or firsts[k] + ' …'}": k for k, head in table.heads.items()}
    for key in words:
        number, _, head = key.partition(" ")
        found[f"{number}: {head or 'words'}"] = int(number) - 1
    return found
