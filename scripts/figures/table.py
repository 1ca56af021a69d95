# SPDX-License-Identifier: GPL-3.0-or-later
"""Table 1: ten our iterations beside the paper's, from the last benchmark."""

import json
from pathlib import Path

from headless.errors import InputError

__all__ = ("write",)

NAME = "table_1.md"


def write(results: Path, output: Path) -> str:
    """Write the table from the results of ``make bench``, or keep the one that is there.

    Parameters
    ----------
    results : file that the benchmark has written, if it has
    output : folder of the figures

    Returns
    -------
    str
        What has been done.

    Raises
    ------
    InputError
        The file is no result of this benchmark.
    """
    target = output / NAME
    if not results.is_file():
        kept = f"{target} stays as it is" if target.exists() else "there is none"
        return f"table 1: no benchmark has run here (make bench), {kept}"
    try:
        target.write_text(_page(json.loads(results.read_text(encoding="utf-8"))), encoding="utf-8")
    except (KeyError, ValueError) as error:
        raise InputError(f"{results}: not of this benchmark ({error!r}); make bench") from error
    return f"table 1: wrote {target}"


def _page(results: dict) -> str:
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
