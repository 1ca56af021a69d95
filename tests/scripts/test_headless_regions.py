# SPDX-License-Identifier: GPL-3.0-or-later
"""Regions on the command line, and their effect on vertex groups of a file."""

import json

import numpy as np
from headless import headless_ok, read_files
from test_headless_handles import FAST


def positions(inputs, folder, name, *options):
    """Return the result for an object of a .blend with the vertex group "pinned"."""
    given = (inputs / "awkward.blend", "--object", "twin", "--cubeness", 0.5, "--refine", "off")
    files = ("--save-mesh", f"{name}.blend", "--report", f"{name}.json")
    headless_ok(*given, *FAST[2:], *files, *options, cwd=folder)
    [content] = read_files(folder / f"{name}.blend", folder=folder)
    return content["twin"][0]


def test_a_region_has_its_own_form(inputs, tmp_path):
    plain = positions(inputs, tmp_path, "plain")
    same = positions(inputs, tmp_path, "same", "--region", "pinned:cube:0.5")
    other = positions(inputs, tmp_path, "other", "--region", "pinned:prism3:2")
    np.testing.assert_array_equal(same, plain)
    assert np.abs(other - plain).max() > 1e-3 * np.ptp(plain, axis=0).max()
    six = positions(inputs, tmp_path, "six", "--region", "pinned:prism:2")
    assert np.abs(other - six).max() > 1e-3 * np.ptp(plain, axis=0).max()
    report = json.loads((tmp_path / "other.json").read_text(encoding="utf-8"))
    assert report["settings"]["region"] == ["pinned:prism3:2"]
