# SPDX-License-Identifier: GPL-3.0-or-later
"""Handles on the command line: what is held, where it goes, and what is refused; and regions."""

import json
from pathlib import Path

import numpy as np
import pytest
from headless import headless_ok, headless_refused, read_files
from make_inputs import POSITIONS, TINY

REST = POSITIONS * TINY
FAST = (
    *("--cubeness", 0.0, "--device", "numpy", "--max-iterations", 30),
    *("--refine", "off", "--no-render"),
)
BOTTOM, TOP = [1, 2, 3, 4], [6, 7, 8, 9]
UP = [0.0, 0.0, float(TINY)]
TOP_BOX = [[-TINY / 2, -TINY / 2, TINY / 2], [TINY * 2, TINY * 1.4, TINY * 2]]


def write(folder, *handles):
    path = folder / "handles.json"
    path.write_text(json.dumps(handles, default=float), encoding="utf-8")
    return path


def posed_obj(inputs, folder, *handles, more=()):
    """Pose awkward.obj and return its vertices, in the order of the file."""
    headless_ok(
        *(inputs / "awkward.obj", "--handles", write(folder, *handles), *FAST, *more),
        *("--save-mesh", "posed.obj"),
        cwd=folder,
    )
    lines = (folder / "posed.obj").read_text(encoding="utf-8").splitlines()
    return np.array([line.split()[1:] for line in lines if line.startswith("v ")], np.float64)


@pytest.mark.parametrize("selection", [{"vertices": TOP}, {"box": TOP_BOX}])
def test_numbers_are_those_of_the_file_and_boxes_in_its_coordinates(inputs, tmp_path, selection):
    """The file has a loose vertex first, which Blender's importer drops."""
    found = posed_obj(inputs, tmp_path, {"vertices": BOTTOM}, {**selection, "translate": UP})
    np.testing.assert_allclose(found[BOTTOM], REST[BOTTOM], rtol=1e-6)
    np.testing.assert_allclose(found[TOP], REST[TOP] + np.array(UP), rtol=1e-6)
    assert np.abs(found[10] - REST[10]).max() > 0.1 * TINY  # the one between them follows


def test_turning_and_scaling_is_about_the_middle_or_a_pivot(inputs, tmp_path):
    turn = np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]])
    for pivot in (None, [1e-5, 2e-5, 3e-5]):
        handle = {"vertices": TOP, "rotate": [0, 0, 90], "scale": 2, "translate": UP}
        handle |= {} if pivot is None else {"pivot": pivot}
        found = posed_obj(inputs, tmp_path, {"vertices": BOTTOM}, handle)
        held = REST[TOP].astype(np.float64)
        centre = (held.min(axis=0) + held.max(axis=0)) / 2 if pivot is None else np.array(pivot)
        wanted = 2 * (held - centre) @ turn.T + centre + UP
        np.testing.assert_allclose(found[TOP], wanted, rtol=0, atol=1e-6 * TINY)


def test_where_handles_overlap_the_first_counts(inputs, tmp_path):
    found = posed_obj(
        inputs, tmp_path, {"vertices": [*BOTTOM, 6]}, {"vertices": TOP, "translate": UP}
    )
    np.testing.assert_allclose(found[6], REST[6], rtol=1e-6)
    np.testing.assert_allclose(found[TOP[1:]], REST[TOP[1:]] + np.array(UP), rtol=1e-6)


def test_at_rest_nothing_moves(inputs, tmp_path):
    found = posed_obj(inputs, tmp_path, {"vertices": TOP}, {"vertices": BOTTOM, "scale": [1, 1, 1]})
    np.testing.assert_allclose(found, REST, rtol=0, atol=1e-6 * TINY)


def test_vertices_below_the_threshold_are_not_held(inputs, tmp_path):
    handles = write(tmp_path, {"group": "light", "threshold": 0.5})
    common = (inputs / "awkward.blend", "--object", "twin", *FAST, "--save-mesh", "posed.abc")
    words = ['weighs 0.5 or more in the vertex group "light"']
    headless_refused(*common, "--handles", handles, words=words, cwd=tmp_path)


def test_groups_of_a_blend_and_pins_before_handles(inputs, tmp_path):
    """The object is placed anywhere; the handle is in its own coordinates."""
    path = write(
        tmp_path, {"group": "pinned", "threshold": 0.9, "translate": UP}, {"vertices": TOP}
    )
    common = (inputs / "awkward.blend", "--object", "twin", *FAST)
    headless_ok(*common, "--handles", path, "--save-mesh", "a.blend", cwd=tmp_path)
    headless_ok(
        *(*common, "--handles", path, "--pin", "pinned", "--save-mesh", "b.blend"), cwd=tmp_path
    )
    for name, way in (("a.blend", np.array(UP)), ("b.blend", np.zeros(3))):
        [content] = read_files(tmp_path / name, folder=tmp_path)
        found = content["twin"][0]
        np.testing.assert_allclose(found[BOTTOM], REST[BOTTOM] + way, rtol=1e-6)


# what stands in the file, and what the one line must name
REFUSED = {
    "no JSON": ("{", ["is not JSON", "line 1"]),
    "no list": ("{}", ["must be a list"]),
    "no object": ("[3]", ["handle 1", "must be an object"]),
    "unknown key": ('[{"group": "a", "move": [0, 0, 1]}]', ["handle 1", "'move'", "translate"]),
    "nothing chosen": ('[{"translate": [0, 0, 1]}]', ["handle 1", "group, vertices, box"]),
    "chosen twice": ('[{"group": "a", "vertices": [1]}]', ["handle 1", "one of"]),
    "no name": ('[{"group": 7}]', ["handle 1", "group", "name"]),
    "no numbers": ('[{"vertices": []}]', ["handle 1", "vertices", "whole numbers"]),
    "a fraction": ('[{"vertices": [1.5]}]', ["handle 1", "vertices", "whole numbers"]),
    "a truth": ('[{"vertices": [true]}]', ["handle 1", "vertices", "whole numbers"]),
    "below zero": ('[{"vertices": [-1]}]', ["handle 1", "vertices", "whole numbers"]),
    "two of three": (
        '[{"vertices": [1], "translate": [0, 1]}]',
        ["handle 1", "translate", "[0, 1]"],
    ),
    "a text": ('[{"vertices": [1], "rotate": [0, 1, "x"]}]', ["handle 1", "rotate", '"x"']),
    "not a number": ('[{"vertices": [1], "pivot": [0, 1, NaN]}]', ["pivot", "finite", "NaN"]),
    "infinite": ('[{"vertices": [1], "scale": 1e999}]', ["scale", "finite"]),
    "flat": ('[{"vertices": [1], "scale": [1, 1, 0]}]', ["scale", "zero"]),
    "box inside out": ('[{"box": [[1, 0, 0], [0, 1, 1]]}]', ["box", "lowest corner first"]),
    "one corner": ('[{"box": [[1, 0, 0]]}]', ["box", "two corners"]),
    "threshold": ('[{"group": "a", "threshold": 1.5}]', ["threshold", "0 and 1", "1.5"]),
    "threshold alone": ('[{"vertices": [1], "threshold": 0.5}]', ["threshold", "group"]),
    # These need Blender.
    "no such group": (
        '[{"vertices": [1]}, {"group": "hand"}]',
        ["handle 2", "hand", "no vertex group"],
    ),
    "out of range": ('[{"vertices": [1, 12]}]', ["handle 1", "vertex 12", "the last is 11"]),
    "empty box": ('[{"box": [[5, 5, 5], [6, 6, 6]]}]', ["handle 1", "no vertex", "extends from"]),
    "everything": ('[{"box": [[-1, -1, -1], [1, 1, 1]]}]', ["awkward", "all vertices are pinned"]),
}


OUTPUT = (*FAST, "--save-mesh", "a.obj")


@pytest.mark.parametrize("case", REFUSED)
def test_refusal(inputs, tmp_path, case):
    text, words = REFUSED[case]
    (tmp_path / "handles.json").write_text(text, encoding="utf-8")
    words = [*words, *(["handles.json"] if case != "everything" else [])]
    arguments = (inputs / "awkward.obj", "--handles", "handles.json", *OUTPUT)
    headless_refused(*arguments, words=words, cwd=tmp_path)


@pytest.mark.parametrize(
    ("name", "arguments", "words"),
    [
        ("awkward.obj", "--handles none.json", ["--handles none.json", "no such file"]),
        ("awkward.obj", "--handles .", ["--handles .", "cannot be read"]),
        (
            *("awkward.obj", "--handles handles.json --report handles.json"),
            ["--report", "is an input"],
        ),
        ("awkward.glb", "--handles handles.json", [".glb", "give a box"]),
        ("awkward.blend", "--handles handles.json", ["2 meshes", "--object"]),
    ],
)
def test_files_and_numbers_that_mean_nothing_are_refused(inputs, tmp_path, name, arguments, words):
    write(tmp_path, {"vertices": [1]})
    headless_refused(inputs / name, *arguments.split(), *OUTPUT, words=words, cwd=tmp_path)


def test_the_example_for_the_monkey_lifts_its_ears(tmp_path):
    example = Path(__file__).resolve().parents[2] / "examples" / "monkey_ears.json"
    shapes = []
    for handles in ((), ("--handles", example)):
        headless_ok(*handles, *FAST, "--save-mesh", "monkey.ply", cwd=tmp_path)
        [content] = read_files(tmp_path / "monkey.ply", folder=tmp_path)
        shapes.append(content["monkey"][0])
    rest, posed = shapes
    ears, chin = np.abs(rest[:, 0]) > 1.1, rest[:, 2] < -0.6
    assert (posed[ears, 2] - rest[ears, 2]).min() > 0.2
    np.testing.assert_allclose(posed[chin], rest[chin], atol=1e-6)


def with_regions(inputs, folder, name, *options):
    """Return the result for an object of a .blend with the vertex group "pinned"."""
    given = (inputs / "awkward.blend", "--object", "twin", "--cubeness", 0.5, "--refine", "off")
    files = ("--save-mesh", f"{name}.blend", "--report", f"{name}.json")
    headless_ok(*given, *FAST[2:], *files, *options, cwd=folder)
    [content] = read_files(folder / f"{name}.blend", folder=folder)
    return content["twin"][0]


def test_a_region_has_its_own_form(inputs, tmp_path):
    plain = with_regions(inputs, tmp_path, "plain")
    same = with_regions(inputs, tmp_path, "same", "--region", "pinned:cube:0.5")
    other = with_regions(inputs, tmp_path, "other", "--region", "pinned:prism3:2")
    np.testing.assert_array_equal(same, plain)
    assert np.abs(other - plain).max() > 1e-3 * np.ptp(plain, axis=0).max()
    six = with_regions(inputs, tmp_path, "six", "--region", "pinned:prism:2")
    assert np.abs(other - six).max() > 1e-3 * np.ptp(plain, axis=0).max()
    report = json.loads((tmp_path / "other.json").read_text(encoding="utf-8"))
    assert report["settings"]["region"] == ["pinned:prism3:2"]
