# SPDX-License-Identifier: GPL-3.0-or-later
"""Which of many cases of the same kind are run: a few of each, unless all are asked for."""

import itertools
import sys
from pathlib import Path

import pytest

# pytest has put it first; `scripts` in it would hide files of the `scripts` in the root.
sys.path.remove(str(Path(__file__).parent))


def pytest_addoption(parser):
    """Add the options that ask for all of them, or for fewer still."""
    parser.addoption("--thorough", action="store_true", help="also run what is marked as thorough")
    parser.addoption(
        "--few",
        type=int,
        help="of each test, run at most so many cases: where only the environment is another",
    )


@pytest.hookimpl(trylast=True)
def pytest_collection_modifyitems(config, items):
    """Leave out what is marked as thorough; a test that is named by itself has all its cases."""
    if config.getoption("thorough") or any("::" in each for each in config.args):
        return
    kept, left_out = [], []
    most = config.getoption("few")
    for _, group in itertools.groupby(items, lambda item: item.nodeid.partition("[")[0]):
        cases = list(group)
        marker = cases[0].get_closest_marker("thorough")
        count = sum(marker.args) if marker else len(cases)
        few = spread(len(cases), count if most is None else min(count, most))
        for number, case in enumerate(cases):
            (kept if number in few else left_out).append(case)
    if left_out:
        config.hook.pytest_deselected(items=left_out)
        items[:] = kept


def spread(count, few=0):
    """Return the numbers of a few of so many cases: the first, the last and some between them."""
    few = min(few, count)
    return {round(i * (count - 1) / max(few - 1, 1)) for i in range(few)}
