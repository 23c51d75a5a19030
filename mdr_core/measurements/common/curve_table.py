"""Table of E* and H of many curves, with the source of each modulus and the reason for this source."""

from collections import Counter
from dataclasses import dataclass, fields, replace
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any, BinaryIO, TextIO

import numpy as np

from ...base.check import Array, frozen
from ...base.remark import KINDS, Remark
from ...show.csv_text import csv_text, safe_cell
from ...show.measured import plot_measured
from ...show.progress import progress
from ...show.quantities import described, engineering
from ...show.report import imported, lines_of, with_error
from .sample import sample_modulus

if TYPE_CHECKING:
    import pandas

#: Kinds of remarks that do not question a number.
_NO_DOUBT = {"taken", "changed", "left out", "errors", "constant"}
#: Heads of columns in files, with their units.
_HEADS = {
    "E_star": "E* (Pa)", "E_star_error": "standard error of E* (Pa)", "hardness": "hardness H (Pa)",
    "hardness_error": "standard error of H (Pa)", "quoted": "source of E*", "E": "E of the sample (Pa)",
    "E_error": "standard error of E (Pa)",
}  # fmt: skip


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class CurveTable:
    """E* and H of many curves, one row for each, from `oliver_pharr` or from ``fit.table()``.

    Examples
    --------
    >>> import numpy as np
    >>> import mdr_core as mdr
    >>> d = np.append(np.linspace(0, 60e-9, 100), np.linspace(60e-9, 0, 100))
    >>> F = mdr.indent(mdr.Cone(slope=0.3), mdr.Medium(E_star=10e9), d).force
    >>> curves = [mdr.MeasuredCurve(d, k * F, name=f"{k}.txt") for k in (1, 2, 3)]
    >>> table = mdr.oliver_pharr(mdr.Cone(slope=0.3), curves, epsilon=2 - 4 / np.pi)
    >>> for line in str(table.sample_modulus(nu=0.3)).splitlines()[:8]:
    ...     print(line)
    CurveTable: 3 curves
      tip                      Cone, s 0.3
      method                   Oliver and Pharr, ε = 0.72676, β = 1
      sample                   Poisson ratio 0.3, rigid tip
      E*                       20 ± 10 GPa, mean ± standard deviation of 3 of 3 curves
      hardness                 3.0 ± 1.5 GPa, mean ± standard deviation of 3 of 3 curves
      E                        18.2 ± 9.1 GPa, mean ± standard deviation of 3 of 3 curves
      source of E*             unloading 3
    """

    #: Tip, method and constants as text.
    settings: dict[str, str]
    #: File or name of each curve, and number of the curve in the file, starting at 1.
    file: list[str]
    number: list[int]
    #: E*, H and their standard errors (Pa), NaN for a curve without a result.
    E_star: Array
    E_star_error: Array
    hardness: Array
    hardness_error: Array
    #: Source of E* ("unloading", "fit" or empty), and the reason. H is always by Oliver and Pharr.
    quoted: list[str]
    reason: list[str]
    remarks: list[str]
    #: Young's modulus of the sample and its standard error (Pa), None before `sample_modulus`.
    E: Array | None = None
    E_error: Array | None = None
    #: Result of each curve, or a `Remark` with the reason for a missing result.
    results: list[Any]

    def __len__(self) -> int:
        return len(self.file)

    def __repr__(self) -> str:
        rows = [*self.settings.items(), *self._means(), *self._doubts()]
        return lines_of(f"CurveTable: {len(self)} curves", [(name, f"{text:.200}") for name, text in rows])

    def _means(self):
        for name, row in self._summary().items():
            mean = with_error(row["mean"], row["standard deviation"], "Pa")
            yield name, f"{mean}, mean ± standard deviation of {row['n']} of {len(self)} curves"

    def _doubts(self):
        """Yield the sources of E*, and the first doubt of each kind, with their numbers of curves."""
        sources = Counter(self.quoted).most_common()
        yield "source of E*", ", ".join(f"{name or 'none'} {count}" for name, count in sources)
        found: dict[str, list[Remark]] = {kind: [] for kind in KINDS if kind not in _NO_DOUBT}
        for each in self.results:
            own = (each,) if isinstance(each, Remark) else each.remarks
            for kind in {remark.kind for remark in own} & found.keys():
                found[kind].append(next(remark for remark in own if remark.kind == kind))
        for kind, remarks in found.items():
            if remarks:
                yield f"remark {kind}", f"{len(remarks)} of {len(self)} curves: {remarks[0]}"

    def _summary(self):
        """Return the statistics of each quantity with a finite value."""
        rows = {}
        for name, column in {"E*": self.E_star, "hardness": self.hardness, "E": self.E}.items():
            values = np.array([]) if column is None else column[np.isfinite(column)]
            if values.size:
                low, middle, high = np.quantile(values, [0.25, 0.5, 0.75])
                deviation = np.std(values, ddof=1) if values.size > 1 else np.inf
                rows[name] = {"n": values.size, "mean": values.mean(), "standard deviation": deviation}
                rows[name] |= {"median": middle, "lower quartile": low, "upper quartile": high}
        return rows

    def sample_modulus(self, nu: float, tip: tuple[float, float] | None = None) -> "CurveTable":
        """Return the table with Young's modulus of the sample, see `OliverPharr.sample_modulus`.

        Young's modulus is NaN for curves stiffer than the tip. Raises ValueError if all curves are stiffer.
        """
        E, error = sample_modulus(self.E_star, self.E_star_error, nu, tip)
        text = "rigid tip" if tip is None else f"tip with {engineering(tip[0], 'Pa')} and {tip[1]:g}"
        if stiffer := np.count_nonzero(np.isnan(E) & np.isfinite(self.E_star)):
            text += f", which is softer than the contact of {stiffer} of {len(self)} curves"
        settings = self.settings | {"sample": f"Poisson ratio {nu:g}, {text}"}
        return replace(self, E=frozen(E), E_error=frozen(error), settings=settings)

    def to_pandas(self) -> "pandas.DataFrame":
        """Return the table in SI units; `attrs` has the settings."""
        pandas = imported("pandas", "to_pandas()")
        table = pandas.DataFrame(self._columns(), index=pandas.RangeIndex(len(self), name="curve"))
        table.attrs.update(self.settings)
        return table

    def _columns(self):
        names = [each.name for each in fields(self) if each.name not in ("settings", "results")]
        return {name: column for name in names if (column := getattr(self, name)) is not None}

    def summary(self) -> "pandas.DataFrame":
        """Return number of curves, mean, standard deviation, median and quartiles (Pa) of E*, H and E."""
        table = imported("pandas", "summary()").DataFrame.from_dict(self._summary(), orient="index")
        return table.rename_axis("in Pa")

    def to_csv(self, file: str | PathLike[str] | TextIO) -> None:
        """Write the table as CSV, after lines with settings and summary that begin with #.

        `pandas.read_csv(file, comment="#")` reads the table.
        """
        head = [" ".join(f"{name}: {text}".split()) for name, text in self._head().items()]
        summary = self._summary()
        head += [",".join(("in Pa", *row)) for row in [*summary.values()][:1]]
        head += [",".join((name, *map(str, row.values()))) for name, row in summary.items()]
        columns = self._columns()
        heads = [_HEADS.get(name, name) for name in columns]
        cells = (np.asarray(column).tolist() for column in columns.values())
        text = csv_text(head, [heads, *zip(*cells, strict=True)])
        if isinstance(file, str | PathLike):
            Path(file).write_text(text, encoding="utf-8", newline="\n")
        else:
            file.write(text)

    def to_excel(self, file: str | PathLike[str] | BinaryIO) -> None:
        """Write settings, summary and table, one below the other, to one sheet of an Excel file."""
        imported("openpyxl", "to_excel()")
        pandas = imported("pandas", "to_excel()")
        head = pandas.Series({name: safe_cell(text) for name, text in self._head().items()})
        summary, table = self.summary(), self.to_pandas().map(safe_cell).rename(columns=_HEADS)
        with pandas.ExcelWriter(file, engine="openpyxl") as book:
            head.to_excel(book, sheet_name="curves", header=False)
            summary.to_excel(book, sheet_name="curves", startrow=len(head) + 1)
            below = len(head) + len(summary) + 3
            table.to_excel(book, sheet_name="curves", startrow=below, index=False)
            for column in "ABCDEFGH":
                book.sheets["curves"].column_dimensions[column].width = 24

    def _head(self):
        """Return settings and doubts by name."""
        return self.settings | dict(self._doubts())

    def plot(self) -> Any:
        """Plot the force over depth of all curves as a HoloViews element."""
        samples = [each.samples for each in self.results if not isinstance(each, Remark)]
        return plot_measured(f"{len(self)} curves", samples)


def table_of(profile, places, results, settings):
    """Return the `CurveTable` of curves with files and numbers; a `Remark` replaces a missing result."""
    rows = []
    with progress(len(results), "curves") as done:
        for each in results:
            rows.append(_none(each) if isinstance(each, Remark) else each.evaluated)
            done(1)
    E, E_error, H, H_error, quoted, reasons, remarks = map(list, zip(*rows, strict=True))
    files, numbers = map(list, zip(*places, strict=True))
    return CurveTable(
        settings={"tip": described(profile)} | settings, file=files, number=numbers,
        E_star=frozen(E), E_star_error=frozen(E_error), hardness=frozen(H), hardness_error=frozen(H_error),
        quoted=quoted, reason=reasons, remarks=["; ".join(each) for each in remarks], results=results,
    )  # fmt: skip


def _none(remark):
    return (*[np.nan] * 4, "", remark.text, (remark,))
