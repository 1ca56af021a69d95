# SPDX-License-Identifier: GPL-3.0-or-later
"""What the command lines offer is what there is."""

import inspect

import pytest

from solver import Run, run, stylize
from solver.console.options import FORMS
from solver.method import SETTINGS
from solver.styles import form_names, forms


def test_every_form_that_can_be_named_is_made():
    assert set(FORMS) == {"cube", "box", *forms.PLAIN, *forms.WITH_SIDES}
    assert {name.lower() for name in form_names.WITH_SIDES} == set(forms.WITH_SIDES)
    counts = {
        name: None if form is None else len(form.normals)
        for name in FORMS
        for form in [forms.named(name, 5, (1.0, 1.0, 2.0))]
    }
    assert counts["cube"] is None and counts["box"] == 6
    assert counts["prism"] == 7 and counts["pyramid"] == 6
    assert forms.named("box", 5, (1.0, 1.0, 1.0)) is None, "that is the cube"


@pytest.mark.parametrize("function", [Run, run, stylize])
def test_by_default_functions_do_what_the_options_say(function):
    given = inspect.signature(function).parameters
    for name in ("cubeness", "max_iterations", "tolerance"):
        assert name not in given or given[name].default == SETTINGS[name].default
