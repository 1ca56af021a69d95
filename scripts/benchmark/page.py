# SPDX-License-Identifier: GPL-3.0-or-later
"""The page of results: its prose is in ``page.md.jinja``, the figures and tables come from here."""

from pathlib import Path

import jinja2

from . import fit, race, suite, summary, tables, ten_iterations
from .targets import FIFTY_THOUSAND, targets

__all__ = ("GAPS_IMAGE", "SCALING_IMAGE", "page")

GAPS_IMAGE, SCALING_IMAGE = "benchmark_gaps.png", "benchmark_scaling.png"
_TEMPLATE = Path(__file__).with_name("page.md.jinja")


def page(results, power):
    """Return the text of the page; `power` is that of the fit, or None."""
    environment = jinja2.Environment(trim_blocks=True, undefined=jinja2.StrictUndefined)
    constants = {}
    for module in (fit, race, suite, ten_iterations):
        constants |= {name: value for name, value in vars(module).items() if name.isupper()}
    text = environment.from_string(_TEMPLATE.read_text(encoding="utf-8")).render(
        constants | results,
        comma="{:,}".format,
        tables=tables,
        power=power,
        setup_power=_power_of(results, lambda case: summary.median_of(case, "ours", "setup")),
        iteration_power=_power_of(results, summary.milliseconds_per_iteration),
        measured=[case for case in results["defaults"] if "peak" in case["defaults"][0]],
        reached=targets(results),
        FIFTY_THOUSAND=FIFTY_THOUSAND,
        GAPS_IMAGE=GAPS_IMAGE,
        SCALING_IMAGE=SCALING_IMAGE,
    )
    paragraphs = (paragraph.strip("\n") for paragraph in text.split("\n\n"))
    return "\n\n".join(paragraph for paragraph in paragraphs if paragraph) + "\n"


def _power_of(results, value_of):
    return fit.fit_of(results["scaling"], value_of)[0]
