# SPDX-License-Identifier: GPL-3.0-or-later
"""A run tells how far it has come: by a bar if one asks for it, and in the log."""

import logging

import pytest
import shapes

from solver import PAPER, CubicCraftError, stylize

V, F = shapes.blob(1)


def test_a_bar_is_shown_on_request(capsys):
    plain = stylize(V, F, 0.4, device="numpy", proxy=PAPER)
    assert capsys.readouterr() == ("", "")
    result = stylize(V, F, 0.4, device="numpy", progress=True, proxy=PAPER)
    out, shown = capsys.readouterr()
    assert result == plain and not out
    lines = shown.removesuffix("\n").split("\r")[1:]
    shares = [int(line.partition("%")[0]) for line in lines]
    assert shares == sorted(shares) and len(lines) <= result.iterations
    assert lines[-1].endswith(f"iteration {result.iterations}") and len(set(map(len, lines))) < 4


def test_one_that_is_cancelled_ends_its_line(capsys):
    result = stylize(
        V, F, 0.4, device="numpy", progress=True, on_iteration=lambda _: True, proxy=PAPER
    )
    assert result.reason == "cancelled"
    assert capsys.readouterr().err.endswith("iteration 1\n")
    with pytest.raises(CubicCraftError, match="progress must be True or False, not 'bar'"):
        stylize(V, F, progress="bar", proxy=PAPER)


def test_the_end_of_a_run_is_logged(caplog):
    with caplog.at_level(logging.INFO, logger="solver"):
        result = stylize(V, F, 0.4, device="numpy", proxy=PAPER)
    (line,) = caplog.messages
    assert line.startswith(f"converged after {result.iterations} iterations, energy ")
    assert "numpy" in line and caplog.records[0].name == "solver.one_call"
