# SPDX-License-Identifier: GPL-3.0-or-later
"""The options of what holds together reach the solver, each under its name."""

from dataclasses import fields, replace

import pytest
from scripts.cubic_craft.cubic_craft_addon.command_line.options.arguments import parse

from solver import PAPER, ProxyOptions
from solver.console.method_options import settings_from
from solver.method import Method
from solver.proxy.options import proxy_of

GIVEN = {
    "": ProxyOptions(),
    "--paper": PAPER,
    "--paper --keep-pose on --detail 0.1 --keep-apart on": replace(
        PAPER, keep_pose=True, detail=0.1, keep_apart=True
    ),
}
for option in fields(ProxyOptions):
    word, value = ("off", False) if option.default is True else ("0.2", 0.2)
    given = f"--{option.name.replace('_', '-')} {word}"
    GIVEN[given] = replace(ProxyOptions(), **{option.name: value})


@pytest.mark.parametrize("given", GIVEN)
def test_each_option_of_the_proxy_reaches_the_solver(given):
    options = parse(["--no-render", "--report", "r.json", *given.split()])
    method = Method(**settings_from({**vars(options), "cubeness": 0.4}, Method))
    assert proxy_of(method) == GIVEN[given]
