# SPDX-License-Identifier: GPL-3.0-or-later
"""The Python examples of the documentation that need no Blender run as they are written."""

import pytest
from documents import examples, run_example


@pytest.mark.parametrize(
    ("page", "title"), examples(in_blender=False), ids=lambda value: getattr(value, "name", value)
)
def test_example_runs(page, title):
    assert run_example(page, title)
