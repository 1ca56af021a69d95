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


def fit_of(cases):
    """Return power and factor of the time to gap 1 %, or None twice if fewer than two are known."""
    points = []
    for case in cases:
        if case["best"] is not None and FIT_FROM <= case["vertices"] <= FIT_TO:
            seconds = summary.seconds_to_gap(case, "ours", FITTED_GAP)
            if seconds is not None:
                points.append((case["vertices"], seconds))
    return exponent(*zip(*points, strict=True)) if len(points) > 1 else (None, None)
