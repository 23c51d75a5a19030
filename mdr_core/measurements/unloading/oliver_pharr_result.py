"""Results of the method of Oliver and Pharr: for unloadings, and over depth with a measured stiffness."""

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, NoReturn

import numpy as np

from ...base.check import Array
from ...base.errors import MDRError
from ...base.remark import Remark
from ...base.results import Record, check_single
from ...show.measured import plot_unloading
from ...show.quantities import QUANTITIES, Quantity, described, engineering
from ...show.report import limit_rows, rows, with_error
from ...solver.profiles.profile import Profile
from ..common.sample import SampleModulus, sample_modulus
from .iso_14577 import is_pyramid
from .unloading import parts_of

if TYPE_CHECKING:
    import pandas
    import xarray

#: Descriptions of all quantities, including those of the results.
OLIVER_PHARR = QUANTITIES | {
    "contact_depth": Quantity("h_c", "m", "contact depth"),
    "hardness": Quantity("H", "Pa", "hardness"),
    "exponent": Quantity("m", "", "exponent"),
    "contact_point": Quantity("z₀", "m", "first contact"),
    "elastic_work_ratio": Quantity("n_IT", "", "elastic work ratio"),
    "indentation_creep": Quantity("C_IT", "", "indentation creep"),
    "martens_hardness": Quantity("HM", "Pa", "Martens hardness"),
}
#: Quantities of ISO 14577, which not every record has, and the quantities printed in per cent.
ISO_14577 = ("elastic_work_ratio", "indentation_creep", "martens_hardness")
_RATIOS = ISO_14577[:2]
#: Number of points in the plot of an unloading.
_DRAWN = 100
_NO_PYRAMID = "none: only for Berkovich and Vickers pyramids, cones of 70.2° to 70.4°"


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class OliverPharr(Record):
    """Results for one unloading, or for all unloadings of a curve, returned by `oliver_pharr`.

    The standard errors, by name, come from the scatter about the power law. They are at least half the
    range of the results for six parts of the unloading: from 99 or 95 % of the largest force down to 50, 40
    or 30 %. If m is above 1.5 and a fourth of the depth remains, they are at least the largest deviation of
    the results for these parts and for parts down to 20 %. The errors of first contact and of the rate of
    creep are included if these were determined.

    With ``cycles=True`` all values are arrays (U,), and `result[i]` is one unloading, with i starting at 0.
    `unloading` is its number in the record, starting at 1, as in remarks, print and tables.

    Examples
    --------
    >>> import numpy as np
    >>> from mdr_core import Cone, Medium, indent, oliver_pharr
    >>> depth = np.append(np.linspace(0, 60e-9, 100), np.linspace(60e-9, 0, 100))
    >>> force = indent(Cone(slope=0.3), Medium(E_star=10e9), depth).force
    >>> result = oliver_pharr(Cone(slope=0.3), depth, force, epsilon=2 - 4 / np.pi)
    >>> print(f"{result.E_star:.6g} Pa")
    1e+10 Pa
    """

    profile: Profile
    #: Stiffness S (N/m), contact depth h_c (m), modulus E* (Pa), hardness H (Pa) and exponent m.
    stiffness: Any
    contact_depth: Any
    E_star: Any
    hardness: Any
    exponent: Any
    #: First contact z₀ (m), subtracted from the depth; 0 for unchanged depths.
    contact_point: Any
    standard_errors: dict[str, Any]
    #: Remarks on first contact, creep, the choice of an unloading, and omitted unloadings.
    remarks: tuple[Remark, ...] = ()
    #: Results without the correction for creep, if times were given; NaN if they do not follow a power law.
    uncorrected: "OliverPharr | None" = None
    #: Number of the unloading in the record, starting at 1. Omitted unloadings also count.
    unloading: Any = None
    #: Quantities of ISO 14577, None if the record does not determine them. With several unloadings,
    #: missing values are NaN. n_IT is the work that the unloading returns over the work of the loading and
    #: the hold before it. C_IT is (h₂ − h₁)/h₁ with the depths at both ends of a hold. HM (Pa) is
    #: F/(26.43 h²) at the end of the loading, for the cone of a Berkovich or Vickers pyramid.
    elastic_work_ratio: Any = None
    indentation_creep: Any = None
    martens_hardness: Any = None
    #: Depth (m) from first contact and force (N) of the samples.
    samples: tuple[Array, Array] | None = None

    _dimensions = ("unloading",)
    _quantities = (
        *("stiffness", "contact_depth", "E_star", "hardness", "exponent", "contact_point"),
        *ISO_14577,
    )
    _shown = ("stiffness", "contact_depth", "E_star", "hardness", "exponent")

    def __getitem__(self, index: Any) -> "OliverPharr":
        if not self.shape:
            return super().__getitem__(index)
        errors = {name: error[index] for name, error in self.standard_errors.items()}
        values = {name: getattr(self, name) for name in self._quantities}
        values = {name: value if value is None else value[index] for name, value in values.items()}
        for name in set(ISO_14577) & set(values):
            value = values[name]
            if value is not None and np.all(np.isnan(value)):
                values[name] = None
        if self.unloading is not None:
            values["unloading"] = self.unloading[index]
        uncorrected = None if self.uncorrected is None else self.uncorrected[index]
        return replace(self, **values, standard_errors=errors, uncorrected=uncorrected)

    def sample_modulus(self, nu: float, tip: tuple[float, float] | None = None) -> SampleModulus:
        """Compute Young's modulus of the sample and its standard error (Pa) from E*.

        1/E* = (1 − ν²)/E + (1 − ν_t²)/E_t, Johnson (1985), Contact Mechanics, Eq. (4.5).

        Parameters
        ----------
        nu : float
            Poisson ratio of the sample, −1 < ν ≤ 1/2.
        tip : (float, float), optional
            Young's modulus (Pa) and Poisson ratio of the tip, such as ``(1141e9, 0.07)`` for diamond. By
            default the tip is rigid.

        Raises
        ------
        ValueError
            If the tip is softer than the contact.
        """
        return sample_modulus(self.E_star, self.standard_errors["E_star"], nu, tip)

    def plot(self) -> Any:
        """Plot the curve, a fitted unloading and its contact depth as HoloViews elements.

        Depths count from first contact. A correction for creep shifts the unloading.
        """
        check_single(self, "plot")
        depth, force = self.samples
        part = (parts_of(force) or [slice(None)])[int(self.unloading) - 1]
        top = depth[part].max()
        most = self.hardness * np.pi * self.profile.radius_at_height(self.contact_depth) ** 2
        # F = α (h − h_f)^m with the slope S at the largest depth.
        h = np.linspace(top - self.exponent * most / self.stiffness, top, _DRAWN)
        law = most * ((h - h[0]) / (top - h[0])) ** self.exponent
        E = with_error(self.E_star, self.standard_errors["E_star"], "Pa")
        heading = f"{type(self.profile).__name__}: E* {E}"
        return plot_unloading(heading, depth, force, (h, law), float(self.contact_depth))

    @property
    def evaluated(self):
        """Row of a `CurveTable`."""
        errors = self.standard_errors
        numbers = self.E_star, errors["E_star"], self.hardness, errors["hardness"]
        return (*map(float, numbers), "unloading", "by Oliver and Pharr", self.remarks)

    def to_dict(self) -> dict[str, Any]:
        """Return the values by name, in SI units, and the standard errors, whose names end in `_error`."""
        return super().to_dict() | {f"{name}_error": error for name, error in self.standard_errors.items()}

    def to_pandas(self) -> "pandas.DataFrame":
        """Return a table in SI units, with a row for each sample, or for each unloading by its number."""
        table = super().to_pandas()
        if self.shape and self.unloading is not None:
            table = table.set_index(np.asarray(self.unloading)).rename_axis("unloading")
        return table

    def to_xarray(self) -> "xarray.Dataset":
        """Return a dataset with the numbers of the unloadings in the record as a coordinate."""
        dataset = super().to_xarray()
        return dataset if self.unloading is None else dataset.assign_coords(unloading=self.unloading)

    def _rows(self):
        yield "indenter", described(self.profile)
        for i in range(len(self) if self.shape else 0):
            texts = texts_of(self[i])
            texts.pop("contact_point", None)
            standard = {name: texts.pop(name) for name in ISO_14577 if name in texts}
            for label, group in ((f"unloading {self.unloading[i]}", texts), ("", standard)):
                if group:
                    symbols = (f"{OLIVER_PHARR[name].symbol} {text}" for name, text in group.items())
                    yield label, ", ".join(symbols)
        if self.shape and "contact_point" in self.standard_errors and len(self):
            quantity = OLIVER_PHARR["contact_point"]
            yield f"{quantity.long_name} {quantity.symbol}", texts_of(self[0])["contact_point"]
        for name, text in () if self.shape else texts_of(self).items():
            yield f"{OLIVER_PHARR[name].long_name} {OLIVER_PHARR[name].symbol}", text
        if self.uncorrected is not None and not self.shape:
            texts = texts_of(self.uncorrected)
            text = f"E* {texts['E_star']}, H {texts['hardness']}"
            yield "uncorrected for creep", text
        if "martens_hardness" in self._quantities and not is_pyramid(self.profile):
            yield OLIVER_PHARR["martens_hardness"].long_name, _NO_PYRAMID


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class OverDepth(OliverPharr):
    """Results at each sample of a curve with a measured stiffness, arrays (N,), NaN without contact.

    Standard errors are the scatter of neighbouring samples. They include the error of first contact if it
    was determined.
    """

    exponent: Any = None
    #: Depth (m) from first contact.
    depth: Any = None

    _dimensions = ("sample",)
    _quantities = ("depth", "stiffness", "contact_depth", "E_star", "hardness", "contact_point")
    _shown = ("stiffness", "contact_depth", "E_star", "hardness")

    def plot(self) -> NoReturn:
        """Raise MDRError, because with a measured stiffness no unloading is fitted."""
        raise MDRError("plot shows a fitted unloading: leave out stiffness")

    def _rows(self):
        if not self.shape:
            yield from super()._rows()
            return
        yield "indenter", described(self.profile)
        for name in ("depth", *self._shown):
            quantity, values = OLIVER_PHARR[name], getattr(self, name)
            text = engineering(values[np.isfinite(values)], quantity.unit)
            yield f"{quantity.long_name} {quantity.symbol}", text


def texts_of(result: OliverPharr) -> dict[str, str]:
    """Return the quantities of one unloading by name, as text with their errors; ratios in per cent."""
    errors = result.standard_errors
    texts = {
        name: with_error(getattr(result, name), errors[name], OLIVER_PHARR[name].unit) for name in errors
    }
    for name in ISO_14577:
        value = getattr(result, name)
        if value is not None and not np.isnan(value):
            texts[name] = engineering(*((100 * value, "%") if name in _RATIOS else (value, "Pa")))
    return texts


@rows.register
def _rows_of_unloading(result: OliverPharr):
    return result._rows()  # noqa: SLF001


@limit_rows.register
def _limit_rows_of_unloading(result: OliverPharr, most):
    # Remarks are not cut, unlike other rows.
    yield from (("remark", remark) for remark in result.remarks)
