# SPDX-License-Identifier: GPL-3.0-or-later
"""The power of the size with which time grows."""

import numpy as np

from . import summary

FIT_FROM, FIT_TO = 10_000, 1_100_000
"""vertices of the meshes that are fitted to"""
FITTED_GAP = 0.01


def exponent(sizes, seconds):
    """Fit seconds = factor * sizes ** power by least squares of the logarithms.

    Parameters
    ----------
    sizes, seconds : sequence of float
        At least two different sizes.

    Returns
    -------
    power, factor : float

    Raises
    ------
    ValueError
        There are fewer than two sizes, or a number is not positive.
    """
    if len(set(sizes)) < 2:
        raise ValueError(f"the fit needs two different sizes, not {list(sizes)}")
    if min(sizes) <= 0 or min(seconds) <= 0:
        raise ValueError("sizes and seconds must be positive")
    power, logarithm = np.polyfit(np.log(sizes), np.log(seconds), 1)
    return float(power), float(np.exp(logarithm))


def seconds_to_fitted_gap(case):
    """Return the seconds of one size to gap 1 %, or None where that is not known."""
    return summary.seconds_to_gap(case, "ours", FITTED_GAP) if case["best"] is not None else None


def fit_of(cases, value=seconds_to_fitted_gap):
    """Return power and factor of a value of each size, or None twice if fewer than two are known.

    Parameters
    ----------
    cases : list of dict
        The sizes of the scaling run; those from `FIT_FROM` to `FIT_TO` vertices count.
    value : callable
        Maps one of them to a positive number, or to None where it is not known.
    """
    fitted = [case for case in cases if FIT_FROM <= case["vertices"] <= FIT_TO]
    points = [(case["vertices"], value(case)) for case in fitted]
    points = [point for point in points if point[1] is not None]
    return exponent(*zip(*points, strict=True)) if len(points) > 1 else (None, None)
