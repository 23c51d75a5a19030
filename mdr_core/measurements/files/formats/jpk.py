"""Text export of JPK: each segment has a header with names in `columns` and units in `units`."""

import numpy as np

from ..curve import curve_factory
from ..table import Table, read_table
from ..units import unit_named

#: Channels of the depth of the tip and of the position of the piezo, and channels of times, the best first.
_PLACES = [
    ("depth", "tipSampleSeparation"), ("depth", "smoothedTipSampleSeparation"),
    ("depth", "verticalTipPosition"), ("piezo", "smoothedMeasuredHeight"), ("piezo", "measuredHeight"),
    ("piezo", "smoothedStrainGaugeHeight"), ("piezo", "strainGaugeHeight"),
    ("piezo", "smoothedCapacitiveSensorHeight"), ("piezo", "capacitiveSensorHeight"), ("piezo", "height"),
]  # fmt: skip
_TIMES = "seriesTime", "time", "segmentTime"
_SEGMENTS = {"extend": "approach", "retract": "retract", "pause": "hold"}


def matches(head):
    return head.lstrip().startswith("#") and "# units: " in head and "vDeflection" in head


def curves(text, file, given):
    """Return one curve for each `segmentIndex: 0`."""
    found, last = [], None
    for block in _blocks(text):
        table = read_table(block, file)
        index = int(_said(table.header, "segmentIndex") or 0)
        if last is None or index <= last:
            found.append([])
        found[-1].append(table)
        last = index
    names = [f"{file}, curve {i}" if len(found) > 1 else file for i in range(len(found))]
    return [_maker(tables, name, given) for tables, name in zip(found, names, strict=True)]


def _blocks(text):
    """Return the parts of a text that begin with a segment and have samples."""
    parts = text.split("# segmentIndex:")
    blocks = [f"# segmentIndex:{part}" for part in parts[1:]] or parts
    rows = [any(line and not line.startswith("#") for line in block.splitlines()) for block in blocks]
    if not any(rows):
        raise LookupError("no samples")
    return [block for block, has_rows in zip(blocks, rows, strict=True) if has_rows]


def _said(header, key):
    return next((line.partition(":")[2].strip() for line in header if line.startswith(f"# {key}:")), "")


def _maker(tables, name, given):
    """Return a function that makes the curve from tables of segments."""
    header = tables[0].header
    names, units = _said(header, "columns").split(), _said(header, "units").split()
    if any(len(names) <= max(table.values) or len(units) < len(names) for table in tables):
        raise LookupError("not as many names and units as columns")
    where = {head: k for k, head in enumerate(names) if k in tables[0].values}
    places = [(key, where[head]) for key, head in _PLACES if head in where]
    if not places or "vDeflection" not in where:
        raise LookupError("no position and deflection")
    key, place = places[0]
    layout = {
        key: (place, f"−{units[place]}"),
        "force": (where["vDeflection"], units[where["vDeflection"]]),
    }
    values = {k: np.concatenate([table.values[k] for table in tables]) for k in where.values()}
    time = next((where[each] for each in _TIMES if each in where), None)
    if time is not None and np.all(np.diff(values[time]) >= 0):
        layout["time"] = time, units[time]
    if None in (unit_named(column[1].lstrip("−")) for column in layout.values()):
        raise LookupError("units that are not lengths, forces or times")
    lines = np.concatenate([table.lines for table in tables])
    segments = [_said(table.header, "segment") for table in tables]
    segment = np.repeat([_SEGMENTS.get(each, each) for each in segments], [len(t.lines) for t in tables])
    heads = {k: names[k] for k in values}
    table = Table(heads, values, lines, {}, {}, {}, header)
    options = {"turn": False, "segment": segment}
    return curve_factory(table, name, layout, given, "as JPK's text has them", **options)
