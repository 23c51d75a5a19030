"""E* and H from force, stiffness and contact depth: for unloadings, and over depth."""

import numpy as np

from ...base import check
from ...base.remark import MeasurementError, Remark
from ..common.doubts import doubts, of_ideal_tip
from ..common.errors import roughness
from .oliver_pharr_result import OverDepth


def moduli(profile, contact_depth, force, stiffness, beta):
    """Return E* and H (Pa) at contact depths (m); below the tip, the radius is that of its face, or 0."""
    a = profile.radius_at_height(np.maximum(contact_depth, 0.0))
    with np.errstate(divide="ignore", invalid="ignore"):
        return stiffness / (2 * beta * a), force / (np.pi * a**2)


def remaining(profile, contact_depth, stiffness, hardness, exponent, epsilon):
    """Return the share of the largest depth that remains after an unloading F = α (h − h_f)^m."""
    force = hardness * np.pi * profile.radius_at_height(contact_depth) ** 2
    return 1 - exponent * force / stiffness / (contact_depth + epsilon * force / stiffness)


def not_from_contact(text):
    """Return an error for depths and forces with a possibly wrong zero."""
    text = f"{text}: depths must count from first contact, and forces from the baseline"
    return MeasurementError(Remark(text, "no unloading"))


def over_depth(profile, depth, force, stiffness, constants, contact, found):
    """Return the `OverDepth` of samples with a measured stiffness; `found` are remarks on first contact."""
    values, errors, remarks = _values_and_errors(profile, depth, force, stiffness, constants, contact)
    # Near first contact, single samples may deviate strongly.
    middle = [np.nanmedian(values[name]) for name in ("E_star", "hardness")]
    remarks = (*remarks, *found, *doubts(*middle), *profile.remarks)
    remarks = (*remarks, *of_ideal_tip(profile, values["contact_depth"]))
    return OverDepth(profile=profile, **values, standard_errors=errors, remarks=remarks)


def _values_and_errors(profile, depth, force, stiffness, constants, contact):
    """Return values and errors by name at each sample with a measured stiffness, and remarks."""
    epsilon, beta = constants
    with np.errstate(divide="ignore", invalid="ignore"):
        contact_depth = depth - epsilon * force / stiffness
    used = (stiffness > 0) & (force > 0) & (contact_depth > 0)
    used &= contact_depth < profile.known_depth
    if not used.any():
        raise not_from_contact(
            "no sample has a positive stiffness (N/m), force and contact depth h − ε F/S"
        )

    def at(shift):
        h = np.where(used, np.maximum(contact_depth + shift, 0.0), np.nan)
        E, H = np.full((2, depth.size), np.nan)
        E[used], H[used] = moduli(profile, h[used], force[used], stiffness[used], beta)
        return {"contact_depth": h, "E_star": E, "hardness": H}

    values, shifted = at(0.0), at(-contact.depth_error)
    errors = {
        name: np.hypot(roughness(value[used][None])[0, 0], shifted[name] - value)
        for name, value in values.items()
    }
    noise = np.where(used, roughness(stiffness[used][None])[0, 0], np.nan)
    values = {"depth": depth, "stiffness": np.where(used, stiffness, np.nan), **values}
    values["contact_point"] = np.full(depth.size, contact.depth)
    without = np.count_nonzero(~used)
    text = f"{without} of {used.size} samples without contact or stiffness have no results"
    remarks = [Remark(text, "left out")] if without else []
    frozen = {name: check.frozen(value) for name, value in values.items()}
    errors = {"stiffness": noise} | errors
    if contact.depth_error:
        errors["contact_point"] = np.full(depth.size, contact.depth_error)
    return frozen, {name: check.frozen(error) for name, error in errors.items()}, remarks
