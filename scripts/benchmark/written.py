# SPDX-License-Identifier: GPL-3.0-or-later
"""The page of results as a file with its images.

Apart from the text, as the plots need Matplotlib, which only a benchmark installs.
"""

from .fit import FIT_FROM, fit_of
from .page import GAPS_IMAGE, SCALING_IMAGE, page
from .plots import plot_gaps, plot_scaling


def write_page(results, folder):
    """Write ``benchmarks.md`` and its images into a folder; return the path of the page."""
    images = folder / "images"
    power, factor = fit_of(results["scaling"])
    if results["race"]:
        plot_gaps(results["race"], images / GAPS_IMAGE)
    if results["scaling"]:
        plot_scaling(results["scaling"], power, factor, FIT_FROM, images / SCALING_IMAGE)
    path = folder / "benchmarks.md"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(page(results, power), encoding="utf-8")
    return path
