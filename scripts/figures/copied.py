# SPDX-License-Identifier: GPL-3.0-or-later
"""What other commands have made: figure 4, the interface, and table 1, from the last benchmark.

What they have not made stays as it is.
"""

import json
import shutil
from pathlib import Path

from headless.errors import InputError

__all__ = ("copy_screenshot", "write_table")

SCREENSHOT = "*/test_first_sculpture/first_3_live.png"


def copy_screenshot(screenshots: Path, output: Path) -> str:
    """Copy the last one from the folder of the window tests; return what has been done."""
    target = output / "figure_4_interface.png"
    shots = list(screenshots.glob(SCREENSHOT))
    if not shots:
        return f"figure 4: no window test has run here (make test-gui), {_kept(target)}"
    newest = max(shots, key=lambda path: path.stat().st_mtime)
    shutil.copyfile(newest, target)
    return f"figure 4: {target} is the screenshot {newest}"


def write_table(results: Path, output: Path) -> str:
    """Write the table from the results of ``make bench``; return what has been done.

    Raises
    ------
    InputError
        The file is no result of this benchmark.
    """
    target = output / "table_1.md"
    if not results.is_file():
        return f"table 1: no benchmark has run here (make bench), {_kept(target)}"
    try:
        target.write_text(_table(json.loads(results.read_text(encoding="utf-8"))), encoding="utf-8")
    except (KeyError, ValueError) as error:
        raise InputError(f"{results}: not of this benchmark ({error!r}); make bench") from error
    return f"table 1: wrote {target}"


def _kept(target: Path) -> str:
    return f"{target} stays as it is" if target.exists() else "there is none"


def _table(results: dict) -> str:
    # Here, because they bring the solver along, which nothing else of this needs.
    from benchmark import tables
    from benchmark.solver_alone import CUBENESS, ITERATIONS

    return f"""\
# Table 1: running time

{ITERATIONS} iterations at cubeness {CUBENESS:g}, set-up included, medians of {results["runs"]}:
{results["machine"]}
The columns of the paper are its Table 1, from another machine: an NVIDIA RTX 3050 Ti, and for the
CPU the program of Liu and Jacobson on an AMD R9 5900HS. Its sixth mesh, a dragon, is not at hand.

{tables.markdown(list(tables.ten_iterations(results["ten"])))}

Written by `make bench figures`.
"""
