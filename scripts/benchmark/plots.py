# SPDX-License-Identifier: GPL-3.0-or-later
"""The two plots of the page."""

from matplotlib import ticker  # pyright: ignore[reportMissingImports]
from matplotlib.figure import Figure  # pyright: ignore[reportMissingImports]

from .summary import FIT_FROM, fit, gap_of, median_of, seconds_to_fitted_gap

PANELS = (("bunny", 0.2), ("horse", 0.4), ("armadillo", 0.2))
"""cases with a panel; where none of them has been measured, the first three are shown"""
LOWEST_GAP = 3e-4
OURS, STOP, PEER, LINE = "tab:blue", "tab:orange", "tab:red", "tab:gray"


def plot_gaps(cases, path):
    """Draw the gap over time of ours, and where PyMeshLab ends."""
    chosen = [case for case in cases if (case["mesh"], case["cubeness"]) in PANELS] or cases[:3]
    figure = Figure(figsize=(3.2 * len(chosen) + 0.6, 3.8), layout="constrained")
    panels = figure.subplots(1, len(chosen), sharey=True, squeeze=False)[0]
    for case, axes in zip(chosen, panels, strict=True):
        _plot_case(axes, case)
    panels[0].set_ylabel("gap to the lowest known energy, %")
    entries = {}  # {label: handle}, each once
    for axes in panels:
        handles, labels = axes.get_legend_handles_labels()
        entries |= dict(zip(labels, handles, strict=True))
    legend = {"loc": "outside lower center", "ncols": len(entries), "frameon": False}
    figure.legend(entries.values(), entries, **legend)
    figure.suptitle("How near the best shape, and when: as in the paper")
    figure.savefig(path, dpi=110)


def _plot_case(axes, case):
    def percent(energy):
        return 100 * max(gap_of(case, energy), LOWEST_GAP / 10)

    curve = [(s, percent(energy)) for s, energy in case["ours"][0]["curve"]]
    axes.loglog(*zip(*curve, strict=True), color=OURS, label="CubicCraft")
    if case["pymeshlab"]:
        seconds, energy = (median_of(case, "pymeshlab", name) for name in ("seconds", "energy"))
        axes.loglog([seconds], [percent(energy)], "o", color=PEER, label="PyMeshLab ends")
    axes.set_title(f"{case['mesh']}, cubeness {case['cubeness']}", fontsize=10)
    axes.set_xlabel("seconds, set-up included")
    axes.set_ylim(100 * LOWEST_GAP, 120)
    _dress(axes)


def _dress(axes):
    """Label both axes with plain numbers, not with powers of ten."""
    low, high = axes.get_xlim()
    for axis in (axes.xaxis, axes.yaxis):
        # Along x, one power of ten would be the only number of a short run.
        is_short = axis is axes.xaxis and high < 100 * low
        subs = (1.0, 2.0, 5.0) if is_short else (1.0,)
        axis.set_major_locator(ticker.LogLocator(subs=subs, numticks=12))
        axis.set_major_formatter(ticker.FuncFormatter(lambda value, _: f"{value:,g}"))
        axis.set_minor_formatter(ticker.NullFormatter())
    axes.grid(alpha=0.3)


def plot_scaling(cases, path):
    """Draw the time to gap 1 % and to our stop over the size, with the fitted line."""
    figure = Figure(figsize=(5.6, 3.8), layout="constrained")
    axes = figure.subplots()
    times = [(case["vertices"], seconds_to_fitted_gap(case)) for case in cases]
    times = [(size, seconds) for size, seconds in times if seconds is not None]
    if times:
        axes.loglog(*zip(*times, strict=True), "o", color=OURS, label="to gap 1 %")
    stops = [(case["vertices"], median_of(case, "ours", "seconds")) for case in cases]
    axes.loglog(*zip(*stops, strict=True), "^", color=STOP, label="to our stop", markersize=5)
    power, factor = fit(cases)
    if power is not None:
        ends = [FIT_FROM, times[-1][0]]
        line = [factor * size**power for size in ends]
        axes.loglog(ends, line, color=LINE, label=f"seconds ~ vertices^{power:.2f}")
    case = cases[0]
    axes.set_title(f"Time over size: {case['mesh']}, cubeness {case['cubeness']}, as in the paper")
    axes.set_xlabel("vertices")
    axes.set_ylabel("seconds, set-up included")
    _dress(axes)
    axes.legend(fontsize=8)
    figure.savefig(path, dpi=110)
