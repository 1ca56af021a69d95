# SPDX-License-Identifier: GPL-3.0-or-later
"""The figures of the paper, of Blender's own shapes, tiny and rough."""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from headless import PATIENCE, read_files

pytestmark = pytest.mark.thorough  # all are rendered for it

ROOT = Path(__file__).resolve().parents[2]
WIDTH = 120
HEIGHTS = {
    "figure_1_teaser": 860,
    "figure_character": 620,
    "figure_2_uv_texture": 560,
    "figure_3_handles": 560,
    "figure_5_cubeness": 460,
    "figure_6_orientations": 520,
    "figure_forms": 700,
}
"""of a picture of 1600 pixels"""
RED, GREEN, BLUE = range(3)


def figures(*arguments):
    environment = {name: value for name, value in os.environ.items() if "CUBIC_CRAFT" not in name}
    return subprocess.run(
        [sys.executable, str(ROOT / "scripts" / "figures"), *map(str, arguments)],
        capture_output=True,
        text=True,
        env=environment,
        timeout=PATIENCE,
        check=False,
    )


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Folder with all rendered figures."""
    folder = tmp_path_factory.mktemp("figures")
    size = ("--rough", "--width", WIDTH, "--samples", 1)
    process = figures(*size, "--output", folder)
    assert process.returncode == 0, process.stderr
    return folder


@pytest.fixture(scope="module")
def pictures(folder):
    found = read_files(*(folder / f"{name}.png" for name in HEIGHTS), folder=folder)
    return dict(zip(HEIGHTS, found, strict=True))


@pytest.mark.parametrize("name", HEIGHTS)
def test_each_picture_has_its_size_and_shows_something(pictures, name):
    picture = pictures[name]
    assert picture.shape == (round(WIDTH * HEIGHTS[name] / 1600), WIDTH, 4)
    assert picture[..., :3].std() > 0.05
    assert (picture[..., :3].min(axis=-1) > 0.98).mean() < 0.001, "white is lost"


@pytest.mark.parametrize(
    "name",
    ["figure_1_teaser", "figure_5_cubeness", "figure_6_orientations", "figure_forms"],
)
def test_cubic_meshes_are_green_and_touch_no_border(pictures, name):
    picture = pictures[name]
    is_green = picture[..., GREEN] > np.maximum(picture[..., RED], picture[..., BLUE]) + 0.1
    assert is_green.mean() > 0.04
    assert not (is_green[[0, -1]].any() or is_green[:, [0, -1]].any())


def test_the_teaser_has_its_greens_before_its_greys(pictures):
    picture = pictures["figure_1_teaser"]
    is_green = picture[..., GREEN] > np.maximum(picture[..., RED], picture[..., BLUE]) + 0.1
    half = len(picture) // 2
    assert is_green[half:].mean() > 5 * is_green[:half].mean()


def test_handles_are_painted(pictures):
    picture = pictures["figure_3_handles"]
    assert (picture[..., RED] > picture[..., GREEN] + 0.2).sum() > 10, "moved handles are orange"
    assert (picture[..., BLUE] > picture[..., RED] + 0.1).sum() > 10, "pinned handles are blue"
