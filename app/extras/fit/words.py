"""What is said of a fit: its result, remarks and refusals in words of the page."""

import re
from contextlib import suppress
from html import escape

import mdr_core as mdr

from ...plot import View
from ...state import State, profile
from ...ui import indexed, marked
from .changes import in_page_words
from .measured import agrees


def result(state: State) -> str:
    """Result of the fit as HTML."""
    curve = state["fit.curve"]
    if curve is None or curve.fit is None:
        note = state["fit.note"] if curve is None else ""
        return f"This link was made with a {marked(note)}." if note else ""
    text = "The page has other values than this fit."
    if agrees(state):
        text = "The fitted values have been put into the form; Undo restores yours."
    table = re.sub(r"(?<![\w/])-(?=\d)", "−", indexed(in_page_words(curve.report)))
    # The verdict stands between the numbers and the remarks.
    parts = re.split(r"(?:<tr><th[^>]*>(?:class of hardness|the class presumes)<.*?</tr>)+", table)
    row = f"<tr><td colspan='2' style='text-align:left'>{escape(curve.verdict)}</td></tr>"
    return text + row.join(parts)


def unloading(state: State) -> str:
    """Numbers of Oliver and Pharr for the curve where it lies, as HTML; empty without an unloading.

    They need first contact: found by a fit, or held by who knows it. Empty beside a fit that tells them.
    """
    if state["fit.curve"].fit is not None and "Oliver and Pharr" in state["fit.curve"].report:
        return ""
    known = state["fit.curve"].fit is not None or "contact_point" in state["fit.fixed"]
    curve = state["fit.curve"].placed(state)
    depth, force = curve.depth[curve.used], curve.force[curve.used]
    with suppress(ValueError):
        text = mdr.oliver_pharr(profile(state), depth, force)._repr_html_()
        if not known:
            return "Oliver and Pharr's numbers need first contact: fit it, or hold it where it is known."
        return indexed(text.replace("OliverPharr: one unloading", "Unloading: Oliver and Pharr"))
    return ""


def told(view: View) -> list[tuple[str, str]]:
    curve = view.state["fit.curve"]
    if curve is None:
        return []
    text = f"<p>{escape(curve.name)}: {escape(curve.note)}. A link does not contain the curve.</p>"
    if curve.fit is None:
        return [("The measured curve", text)]
    remarks = "".join(f"<p>{marked(in_page_words(remark))}</p>" for remark in curve.fit.remarks)
    return [(f"Fit to {escape(curve.name)}", text + indexed(in_page_words(curve.report)) + remarks)]
