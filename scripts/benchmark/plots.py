# SPDX-License-Identifier: GPL-3.0-or-later
"""The two plots of the page."""

from matplotlib import ticker  # pyright: ignore[reportMissingImports]
from matplotlib.figure import Figure  # pyright: ignore[reportMissingImports]

from . import summary
from .gap import gap

PANELS = (("bunny", 0.2), ("horse", 0.4), ("armadillo", 0.2))
"""cases with a panel; where none of them has been measured, the first three are shown"""
LOWEST_GAP = 3e-4
OURS, PLAIN, PEER, LINE = "tab:blue", "tab:orange", "tab:red", "tab:gray"
DOTS_PER_INCH = 110


def plot_gaps(cases, path):
    """Draw the gap over time of ours and the plain iteration, and where PyMeshLab ends."""
    chosen = [case for case in cases if (case["mesh"], case["cubeness"]) in PANELS] or cases[:3]
    figure = Figure(figsize=(3.2 * len(chosen) + 0.6, 3.8))
    panels = figure.subplots(1, len(chosen), sharey=True, squeeze=False)[0]
    for case, axes in zip(chosen, panels, strict=True):
        _plot_case(axes, case)
    panels[0].set_ylabel("gap to the lowest known energy, %")
    entries = {}  # {label: handle}, each once
    for axes in panels:
        handles, labels = axes.get_legend_handles_labels()
        entries |= dict(zip(labels, handles, strict=True))
    figure.legend(entries.values(), entries, loc="lower center", ncols=len(entries), frameon=False)
    figure.suptitle("How near the best shape, and when: as in the paper")
    _save(figure, path, bottom=0.07)


def _plot_case(axes, case):
    rest, best = case["rest"], summary.lowest(case)

    def gaps(energies):
        return [100 * max(gap(energy, rest, best), LOWEST_GAP / 10) for energy in energies]

    for program, label, colour in (("ours", "CubicCraft", OURS), ("plain", "plain", PLAIN)):
        if case[program]:
            seconds, energies = zip(*case[program][0]["curve"], strict=True)
            axes.loglog(seconds, gaps(energies), color=colour, label=label)
    if case["pymeshlab"]:
        end = [summary.median_of(case, "pymeshlab", name) for name in ("seconds", "energy")]
        axes.loglog(end[:1], gaps(end[1:]), "o", color=PEER, label="PyMeshLab ends")
    axes.set_title(f"{case['mesh']}, cubeness {case['cubeness']}", fontsize=10)
    axes.set_xlabel("seconds, set-up included")
    axes.set_ylim(100 * LOWEST_GAP, 120)
    _write_numbers(axes)
    axes.grid(alpha=0.3)


def _write_numbers(axes):
    """Label both axes with plain numbers, not with powers of ten."""
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_locator(ticker.LogLocator(subs=(1.0,), numticks=12))
        axis.set_major_formatter(ticker.FuncFormatter(lambda value, _: f"{value:,g}"))
        axis.set_minor_formatter(ticker.NullFormatter())
    low, high = axes.get_xlim()
    if high < 100 * low:  # one power of ten would be the only number
        axes.xaxis.set_major_locator(ticker.LogLocator(subs=(1.0, 2.0, 5.0), numticks=12))


def plot_scaling(cases, power, factor, fit_from, path):
    """Draw the time to gap 1 % and to our stop over the size, with the fitted line.

    Parameters
    ----------
    cases : list of dict
    power, factor : float or None
        Of the fit, see `scaling.exponent`.
    fit_from : int
        Smallest size that was fitted.
    path : Path
    """
    figure = Figure(figsize=(5.6, 3.8))
    axes = figure.subplots()
    known = [case for case in cases if case["best"]]
    times = [(case["vertices"], summary.seconds_to_gap(case, "ours", 0.01)) for case in known]
    times = [(size, seconds) for size, seconds in times if seconds is not None]
    if times:
        axes.loglog(*zip(*times, strict=True), "o", color=OURS, label="to gap 1 %")
    sizes = [case["vertices"] for case in cases]
    stops = [summary.median_of(case, "ours", "seconds") for case in cases]
    axes.loglog(sizes, stops, "^", color=PLAIN, label="to our stop", markersize=5)
    if power is not None:
        ends = [fit_from, max(size for size, _ in times)]
        line = [factor * size**power for size in ends]
        axes.loglog(ends, line, color=LINE, label=f"seconds ~ vertices^{power:.2f}")
    case = cases[0]
    axes.set_title(f"Time over size: {case['mesh']}, cubeness {case['cubeness']}, as in the paper")
    axes.set_xlabel("vertices")
    axes.set_ylabel("seconds, set-up included")
    _write_numbers(axes)
    axes.grid(alpha=0.3)
    axes.legend(fontsize=8)
    _save(figure, path)


def _save(figure, path, bottom=0.0):
    """Save it, with a strip left free at the bottom, as a share of the height."""
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.tight_layout(rect=(0.0, bottom, 1.0, 1.0))
    figure.savefig(path, dpi=DOTS_PER_INCH)
