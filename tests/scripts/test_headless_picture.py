# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures."""

import numpy as np
import pytest
from headless import headless_ok, read_files

WIDTH, HEIGHT = 240, 80


@pytest.fixture(scope="module")
def pictures(inputs, tmp_path_factory):
    """Folder and pixels of one picture and of a turntable of two frames."""
    folder = tmp_path_factory.mktemp("pictures")
    common = ("--device", "numpy", "--max-iterations", 20, "--samples", 2)
    size = ("--resolution", WIDTH, HEIGHT)
    headless_ok(inputs / "awkward.obj", "--cubeness", 0.3, 1.0, *common, *size, cwd=folder)
    headless_ok(
        *(inputs / "awkward.usdc", *common, *size, "--turntable", 2, "--output", "turn.png"),
        cwd=folder,
    )
    names = ["cubic_craft.png", "turn_0001.png", "turn_0002.png"]
    return folder, read_files(*(folder / name for name in names), folder=folder)


def columns(pixels, more, less):
    """Numbers of the picture's columns that have much of one channel more than of another."""
    is_colourful = pixels[..., more] > pixels[..., less] + 0.1
    return np.flatnonzero(is_colourful.mean(axis=0) > 0.2)


def test_picture_shows_the_original_and_each_result(pictures):
    """A mesh of 1e-5 units fills its place as any other: clay, then teal, then teal."""
    _, (picture, *_) = pictures
    assert picture.shape == (HEIGHT, WIDTH, 4)
    red, blue = 0, 2
    clay, teal = columns(picture, red, blue), columns(picture, blue, red)
    assert len(clay) > WIDTH / 20
    assert clay.max() < teal.min()
    assert (np.diff(clay) > 1).sum() == 0
    assert (np.diff(teal) > 1).sum() == 1


def test_turntable_turns(pictures):
    folder, (_, first, second) = pictures
    assert not (folder / "turn.png").exists()
    assert np.abs(first - second).max() > 0.2
