# SPDX-License-Identifier: GPL-3.0-or-later
"""Table 1: ten iterations of ours beside the paper's, from the last benchmark."""

import json
from pathlib import Path

__all__ = ("write",)

RESULTS = Path("build", "bench", "results.json")
NAME = "table_1.md"


def write(root: Path, output: Path) -> str:
    """Write the table from the results of ``make bench``, or keep the one that is there.

    Parameters
    ----------
    root, output : the repository, and the folder of the figures

    Returns
    -------
    str
        What has been done.
    """
    target = output / NAME
    if not (root / RESULTS).is_file():
        kept = f"{target} stays as it is" if target.exists() else "there is none"
        return f"table 1: no benchmark has run here (make bench), {kept}"
    from benchmark import tables
    from benchmark.ten_iterations import CUBENESS, ITERATIONS

    results = json.loads((root / RESULTS).read_text(encoding="utf-8"))
    text = f"""\
# Table 1: running time

{ITERATIONS} iterations at cubeness {CUBENESS:g}, set-up included; {results["runs"]} runs on
{results["machine"]}
The columns of the paper are its Table 1, from another machine: an NVIDIA RTX 3050 Ti, and for the
CPU the program of Liu and Jacobson on an AMD R9 5900HS. Its sixth mesh, a dragon, is not at hand.

{tables.ten_iterations(results["ten"])}

Written by `make bench figures`.
"""
    target.write_text(text, encoding="utf-8")
    return f"table 1: wrote {target}"
