# SPDX-License-Identifier: GPL-3.0-or-later
"""The Python examples of the documentation that need no Blender run as they are written.

So do those in the docstrings of the solver's public functions and classes.
"""

import doctest
from inspect import getdoc

import pytest
from documents import examples, run_example

import solver

PUBLIC = [
    name
    for name in solver.__all__
    if callable(value := getattr(solver, name))
    and not value.__module__.startswith("solver.backends")  # depends on the machine
]


@pytest.mark.parametrize(
    ("page", "title"), examples("solver"), ids=lambda value: getattr(value, "name", value)
)
def test_example_runs(page, title):
    assert run_example(page, title)


@pytest.mark.parametrize("name", PUBLIC)
def test_example_of_docstring_runs(name):
    text = getdoc(getattr(solver, name))
    runner = doctest.DocTestRunner()
    runner.run(doctest.DocTestParser().get_doctest(text, {}, name, None, None))
    failed, tried = runner.summarize()
    assert tried and not failed
