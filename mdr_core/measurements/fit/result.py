"""Results of `fit_indentation`: parameters, states and residuals of all curves."""

from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from ...base import check
from ...base.check import Array, ArrayLike
from ...base.remark import Remark
from ...base.results import check_single
from ...show.quantities import engineering
from ...show.report import with_error
from ...solver.contact.indentation import Indentation
from ...solver.contact.live_interval import LiveInterval
from ...solver.impacts.scaling import HardnessClass
from ...solver.medium.medium import Medium
from ..common.curve_table import CurveTable, table_of
from ..unloading.oliver_pharr_result import OLIVER_PHARR, OliverPharr
from .classes import ClassFit, class_of_hardness, fit_again, fits_of_classes, rows_on_class
from .dataset import SAMPLES, dataset_of
from .figures import plot_fit
from .measurement import Measurement
from .parameters import BACKGROUND, CLASSES, MEDIUM, PARAMETERS
from .quoted import Quoted, quoted, unloading
from .remarks import by_importance, missing, remarks_of
from .report import Fit

if TYPE_CHECKING:
    import xarray

#: Fields with one entry per curve; those with one per sample are `SAMPLES`.
_OF_CURVES = ("contact_point", *BACKGROUND, "covariance", "reduced_chi_square", "block_length")


@dataclass(frozen=True, eq=False, repr=False)
class IndentationFit(Fit):
    """Media fitted to one or many curves, a `Fit` returned by `fit_indentation`.

    `fit[i]` is the fit of one curve. For many curves, parameters and errors are arrays (R,), and
    `covariance` is (R, P, P). q_c is infinite if nothing has yielded. Residuals are residuals of the force
    (N) at the measured depth. Shorter curves are padded with NaN; `fit[i]` is not padded. Fitted values of
    `invalid` curves are NaN.

    Examples
    --------
    >>> import numpy as np
    >>> from mdr_core import Cone, Medium, fit_indentation, indent
    >>> depth = np.linspace(-5e-9, 60e-9, 100)
    >>> force = indent(Cone(slope=0.3), Medium(E_star=10e9), depth).force
    >>> fit = fit_indentation(Cone(slope=0.3), depth, force, q_c=np.inf)
    >>> print(f"{fit.medium.E_star:.6g}", list(fit.standard_errors))
    1e+10 ['E_star', 'contact_point']
    """

    #: Measured depth (m), force (N), and time (s), None if it was not given.
    depth: Array
    force: Array
    time: Array | None
    #: Fitted or held values (m, N, N/m, N·s/m).
    contact_point: Array
    baseline: Array
    tilt: Array
    drag: Array
    #: Sum of squares in units of the noise over the degrees of freedom, NaN for noise from the residuals.
    reduced_chi_square: Array
    #: Number of samples in a block of the standard errors, 1 for uncorrelated residuals.
    block_length: Array
    #: Standard deviation of the force (N), given or estimated; for each sample if an array was given.
    force_noise: Array
    #: Given standard deviation of the measured depth (m).
    depth_noise: float
    #: States of the fitted model, with depth noise at the most probable depths. An omitted sample has the
    #: state of the sample before.
    path: Indentation
    #: Remarks on each curve from its file and from the fit, and numbers of given samples.
    _read: tuple[tuple[Remark, ...], ...]
    _remarks: tuple[tuple[Remark, ...], ...]
    _lengths: np.ndarray
    #: File of each curve, and its number in the file, starting at 1.
    _places: tuple[tuple[str, int], ...]
    #: Line of a table about files that were not read.
    _about: dict[str, str]

    _names = tuple(PARAMETERS)
    _zero_unless_asked = (*CLASSES.values(), "eta", "tilt", "drag", "work_of_adhesion")
    _dimensions = ("curve",)

    @property
    def residual_noise(self) -> Array:
        """Standard deviation (N) of the residuals due to noise of force and depth, √(σ_F² + (S σ_d)²)."""
        stiffness = np.asarray(self.path.stiffness)
        return np.hypot(self._noise_of_samples(), stiffness * self.depth_noise)

    @property
    def _yields(self):
        return not np.all(np.isinf(self.medium.q_c))

    def _noise_of_samples(self):
        """Return the standard deviation (N) of the force as an array that broadcasts with the samples."""
        noise = np.asarray(self.force_noise)
        return noise if noise.ndim > len(self.shape) else noise[..., None]

    def __getitem__(self, index: Any) -> "IndentationFit":
        if not self.shape:
            return super().__getitem__(index)
        curves = np.arange(len(self))[index]
        if curves.ndim > 1:
            raise IndexError("a fit has one axis, the curves: its index is a number, a slice or a list")
        index = index if isinstance(index, slice) else curves
        longest = np.max(self._lengths[index], initial=0)
        noise = self.force_noise[index]
        samples = {name: getattr(self, name) for name in SAMPLES}
        return replace(
            self,
            medium=_medium(self.medium.entries(index)),
            standard_errors={name: error[index] for name, error in self.standard_errors.items()},
            path=self.path[index][..., :longest],
            force_noise=noise[..., :longest] if self.force_noise.ndim > 1 else noise,
            _read=tuple(self._read[i] for i in curves.ravel()),
            _remarks=tuple(self._remarks[i] for i in curves.ravel()),
            _lengths=self._lengths[index],
            _places=tuple(self._places[i] for i in curves.ravel()),
            **{name: getattr(self, name)[index] for name in _OF_CURVES},
            **{name: v if v is None else v[index][..., :longest] for name, v in samples.items()},
        )

    @property
    def remarks(self) -> tuple[Remark, ...]:
        """Remarks of the file, then remarks of the fit, the most important first.

        For many curves, one remark of each kind, with the number of the first affected curve and the number
        of affected curves. ``fit[i].remarks`` are the remarks on a single curve.
        """
        if not self.shape:
            return (*self._read[0], *self._remarks[0])
        return (*_of_many(self._read), *by_importance(_of_many(self._remarks)))

    @property
    def invalid(self) -> dict[int, Remark]:
        """Reasons for missing fits by curve number; see `fit_indentation`."""
        return {
            i: remark
            for i, remarks in enumerate(self._remarks)
            for remark in remarks
            if remark.kind == "invalid"
        }

    def _refuse_invalid(self, what):
        for i, reason in self.invalid.items():
            raise check.MDRError(
                f"{what}: curve {i} was {reason}; select the fitted curves, as in fit[numbers]"
            )

    @cached_property
    def classes(self) -> dict[str, ClassFit]:
        """Fits with the hardness of each class alone by letter, "a", "b", "c"; computed on first access.

        All other parameters are held or free as in this fit. Empty for an elastic medium, and with
        viscosity. `class_of_hardness` shows which classes the misfits distinguish.
        """
        self._refuse_invalid("classes")
        if not self._yields or "eta" in self.standard_errors or np.any(self.medium.eta):
            return {}
        # If the noise comes from the residuals, χ² is NaN.
        known = not np.isnan(self.reduced_chi_square).any()
        noise = np.broadcast_to(self._noise_of_samples(), self.depth.shape) if known else None
        samples = (self.depth, self.force, self.time, noise)
        measured = Measurement(
            *(None if values is None else np.atleast_2d(values) for values in samples),
            np.atleast_1d(self._lengths),
            not self.shape,
        )
        values = {name: v for name, v in self._values().items() if name not in self.standard_errors}
        held = {name: np.atleast_1d(value) for name, value in values.items()}
        return fits_of_classes(self.profile, measured, held, self.depth_noise)

    @property
    def class_of_hardness(self) -> HardnessClass | None:
        """Class of hardness of one curve, or None without `classes`."""
        check_single(self, "class_of_hardness")
        if not self.classes:
            return None
        samples = np.count_nonzero(np.isfinite(self.residuals))
        return class_of_hardness(self.classes, samples, self.standard_errors)

    @cached_property
    def unloading(self) -> tuple[OliverPharr | None, Remark]:
        """Oliver–Pharr results of one curve and the source of first contact; or None and a reason."""
        check_single(self, "unloading")
        return unloading(self)

    @cached_property
    def quoted(self) -> Quoted:
        """Modulus of one curve to quote, with its source; computed on first access."""
        check_single(self, "quoted")
        return quoted(self)

    def plot(self) -> Any:
        """Plot measured and fitted force over depth, and the residuals, of one curve as HoloViews elements.

        The band of the residuals is one standard deviation of their noise, √(σ_F² + (S σ_d)²) with the
        stiffness S. Depths and forces include offset and background.
        """
        check_single(self, "plot")
        self._refuse_invalid("plot")
        return plot_fit(self)

    def table(self) -> CurveTable:
        """Return a table of the curves to save: the `quoted` modulus of each, and H of its unloading."""
        held = {n: v for n, v in self._values().items() if n not in self.standard_errors and np.any(v)}
        quantities = {n: PARAMETERS[n].quantity for n in held}
        texts = [f"{q.symbol} = {engineering(held[n], q.unit)}" for n, q in quantities.items()]
        settings = {"method": f"{self.model}; hardness, and E* where it is quoted, by Oliver and Pharr"}
        settings |= ({"held": ", ".join(texts)} if texts else {}) | self._about
        results = [self.invalid.get(i) or self[i] for i in range(len(self))] if self.shape else [self]
        return table_of(self.profile, self._places, results, settings)

    @property
    def samples(self) -> tuple[Array, Array]:
        """Measured depth (m) and force (N)."""
        return self.depth, self.force

    @property
    def evaluated(self):
        """Row of a `CurveTable`."""
        E = self.quoted.value, self.quoted.standard_error
        E, H = (np.nan, np.nan) if E[0] is None else E, (np.nan, np.nan)
        result, _ = self.unloading
        if result is not None and self._yields and self.quoted.source:
            H = float(result.hardness), float(result.standard_errors["hardness"])
        return (*E, *H, self.quoted.source or "", self.quoted.reason, self.remarks)

    def to_xarray(self, position: ArrayLike | None = None) -> "xarray.Dataset":
        """Return everything as a dataset: parameters, errors and covariance, and the samples.

        For each sample, the dataset has the measured values, the model and the residual. `attrs` has the
        remarks, the number of `invalid` curves, and their reasons.

        Parameters
        ----------
        position : array_like, optional
            Positions (m) of the curves of a map on the surface, (R, 2): the coordinates x and y.
        """
        return dataset_of(self, position)

    def _text(self, name, value, unit):
        # For any fitted constant, an elastic medium has q_c = ∞ and the other constants 0.
        fitted = set(self.standard_errors) & set(CLASSES.values())
        if fitted and name in CLASSES.values() and not self.shape and self.medium.q_c == np.inf:
            return "∞"
        return super()._text(name, value, unit)

    def _hardness(self):
        """Yield rows on the hardness of one curve with yield: its class, and the pressures."""
        if self.classes:
            used = np.isfinite(self.residuals)
            samples = self.depth[used], self.force[used], self.depth_noise
            yield from rows_on_class(self.class_of_hardness, *samples)
        top = int(np.argmax(self.path.force))
        if self._yields and self.path.force[top] > 0:
            a, mean = self.path.contact_radius[top], self.path.mean_pressure[top]
            yielded = engineering(self.medium.hardness_at(a), "Pa")
            text = f"{engineering(mean, 'Pa')} over the model's a = {engineering(a, 'm')}"
            yield "mean pressure F/(π a²)", f"{text}, {yielded} where all of it yields"

    def _comparable(self):
        """Yield rows on the modulus to quote, another law to fit, and a different E* of the model."""
        if self.shape or self.invalid:
            return
        quote = self.quoted
        if quote.source is None:
            yield "to quote", f"no E*: {quote.reason}"
        else:
            value = with_error(quote.value, quote.standard_error, "Pa")
            yield "to quote", f"E* {value} of the {quote.source}: {quote.reason}"
        if classes := self.classes:
            yield from fit_again(classes, self.class_of_hardness, self.standard_errors)
        if quote.source == "unloading":
            value = self._text("E_star", self.medium.E_star, "Pa")
            yield "E* of the model", f"{value}: its contact sinks in elastically, and is smaller"

    def _unloading(self):
        """Yield a row with the results of Oliver and Pharr for one curve, if the model fits."""
        result, _ = self.unloading
        if result is None or {"misfit", "noise"} & {remark.kind for remark in self.remarks}:
            return
        errors = result.standard_errors
        texts = [
            f"{OLIVER_PHARR[name].symbol} {with_error(getattr(result, name), errors[name], 'Pa')}"
            for name in ("E_star", "hardness")
        ]
        force = self.path.force + self.residuals
        a = engineering(np.sqrt(np.nanmax(force) / (np.pi * result.hardness)), "m")
        yield "Oliver and Pharr", f"{', '.join(texts)} over a = {a}"

    def _limits(self):
        return self.path.limits

    def _quality(self):
        for label, values, unit in (
            ("force noise σ_F", self.force_noise, "N"),
            ("reduced χ²", self.reduced_chi_square, ""),
        ):
            if np.isfinite(values).any():
                yield label, engineering(np.asarray(values)[np.isfinite(values)], unit)
        if not self.shape and not self.invalid:
            yield from self._hardness()
            yield from self._unloading()
        if np.any(self.block_length > 1):
            lengths = engineering(self.block_length[~np.isnan(self.block_length)], "")
            yield "standard errors", f"block-wise (Newey–West), blocks of {lengths} samples"


def _of_many(remarks):
    """Yield one remark of each kind, from the first affected curve, with the number of affected curves."""
    same = {}
    for i, own in enumerate(remarks):
        for remark in own:
            # Two parameters at their bounds need two remarks.
            named = tuple((each.action, each.what) for each in remark.remedy if remark.kind != "invalid")
            same.setdefault((remark.kind, named), {}).setdefault(i, remark)
    for found in same.values():
        i, first = next(iter(found.items()))
        yield first.after(f"curve {i} ({len(found)} of {len(remarks)} curves): ")


class _MediumOrNone(Medium):
    """Medium whose parameters may be NaN, for curves without a fit."""

    def __post_init__(self):
        """Accept any numbers."""


def _medium(medium):
    """Return a medium without NaN as an ordinary `Medium`."""
    return medium if np.isnan(medium.E_star).any() else Medium(**medium.__getstate__())


def collected(profile, measured, depth_noise, solutions, reasons, read, places, about):
    """Return one result from the solutions, in the order of the curves.

    `reasons` has the errors of invalid curves. `read` has the remarks of curves from files, and `places`
    the files and the numbers in the files.
    """
    count, free = len(measured.depth), solutions[0].curves.free
    rows = np.concatenate([solution.rows for solution in solutions])
    order = np.argsort(rows)
    groups = [_arrays(solution, measured.used[solution.rows]) for solution in solutions]
    joined = {name: np.concatenate([group[name] for group in groups])[order] for name in groups[0]}
    if reasons:
        joined = {name: _among(values, rows[order], count, name in free) for name, values in joined.items()}
    of_fits = [each for solution in solutions for each in remarks_of(solution)]
    remarks = [(reasons[i].after("not fitted: "),) if i in reasons else () for i in range(count)]
    for i, own in zip(rows.tolist(), of_fits, strict=True):
        omitted = missing(np.count_nonzero(measured.used[i]), measured.lengths[i])
        remarks[i] = by_importance((*own, *omitted))
    medium = _medium(_MediumOrNone(**{name: joined.pop(name) for name in MEDIUM}))
    ends = (joined.pop(name) for name in ("lower", "upper", "live_depth"))
    states = joined.pop("path_depth"), LiveInterval(*ends), joined.pop("uniform_load")
    path = Indentation(profile, medium.entries(np.s_[:, None]), *states, bool(np.any(medium.eta)))
    joined |= {name: getattr(measured, name) for name in ("depth", "force", "time")}
    if measured.force_noise is not None:
        joined["force_noise"] = measured.force_noise
    errors = np.sqrt(np.einsum("rpp->rp", joined["covariance"]))
    fit = IndentationFit(
        profile=profile,
        medium=medium,
        path=path,
        depth_noise=depth_noise,
        standard_errors={name: check.frozen(errors[:, i]) for i, name in enumerate(free)},
        **{name: value if value is None else check.frozen(value) for name, value in joined.items()},
        _read=tuple(map(tuple, read)) or ((),) * count,
        _remarks=tuple(remarks),
        _lengths=measured.lengths,
        _about=about,
        _places=tuple(places) or tuple(("", i) for i in range(1, count + 1)),
    )
    return fit[0] if measured.single else fit


def _among(values, fitted, count, free):
    """Return values for all curves; a curve without a fit gets the common held value, or NaN."""
    same = not free and values.ndim == 1 and np.all(values == values[0])
    among = np.full((count, *values.shape[1:]), values[0] if same else np.nan)
    among[fitted] = values
    return among


def _arrays(solution, used):
    """Return the arrays of a `Solution` by name, one row per curve, one column per given sample."""
    curves, (values, state) = solution.curves, solution.values_and_states
    units = curves.units(values)[:, : len(curves.free)]
    # The path follows the model also at samples without weight. With adhesion the search has contact where
    # the data have contact.
    residuals = np.where(
        curves.left_out | curves.adhesive,
        curves.force - curves.background(values) - state.force,
        solution.deviation,
    )
    samples = {
        "residuals": residuals,
        "path_depth": state.depth,
        "lower": state.live_interval.lower,
        "upper": state.live_interval.upper,
        "live_depth": state.live_interval.length,
        "uniform_load": state.uniform_load,
    }
    # An omitted sample has the state of the sample before.
    before = np.maximum(np.cumsum(used, axis=1) - 1, 0)
    samples = {name: np.take_along_axis(array, before, axis=1) for name, array in samples.items()}
    samples["residuals"][~used] = np.nan
    chi, sigma = solution.reduced_chi_square, np.median(curves.sigma, axis=1)
    parameters = {name: np.broadcast_to(values[name], (len(chi), 1))[:, 0] for name in PARAMETERS}
    of_curves = {
        "covariance": solution.covariance * (units[:, :, None] * units[:, None, :]),
        "reduced_chi_square": chi if solution.noise_known else np.full_like(chi, np.nan),
        "force_noise": sigma if solution.noise_known else sigma * np.sqrt(chi),
        "block_length": solution.block_length,
    }
    return parameters | samples | of_curves
