# SPDX-License-Identifier: GPL-3.0-or-later
"""Screenshots, one after another, as an animated picture; ImageMagick makes it."""

import os
import pathlib
import subprocess

import guidrive as gui
import live_scene as scene

FOLDER = pathlib.Path(os.environ["GUIDRIVE_SHARE"])
DELAY, LAST = 9, 120  # hundredths of a second of a frame, and of the last one
SHOWN, WIDTH, COLORS = "822x634+0+0", 800, 96  # the viewport and the panel, in pixels

_frames = []


def film(times=1):
    path = yield from gui.screenshot(f"frames/{len(_frames):03d}.png")
    _frames.extend([path] * times)


def drag(points):
    """Press at the first of some points, move over the others, filmed, and release."""
    first, *others = points
    yield from gui.move_mouse(first)
    gui.events().press("LEFTMOUSE")
    for point in others:
        yield from gui.move_mouse(point)
        yield from film()
    gui.events().release("LEFTMOUSE")
    yield


def become_cubic():
    """Filmed until there is nothing left to compute."""
    while not scene.is_idle():
        yield from film()
        for _ in range(2):
            yield


def cut(name):
    """Make the animated picture; neither a still nor more than a page should have to load."""
    path = FOLDER / name
    frames = ["-delay", str(DELAY), *_frames[:-1], "-delay", str(LAST), _frames[-1]]
    small = ["-crop", SHOWN, "+repage", "-resize", f"{WIDTH}x"]
    small += ["+dither", "-colors", str(COLORS), "-layers", "Optimize"]
    subprocess.run(["convert", "-loop", "0", *frames, *small, str(path)], check=True)
    size = path.stat().st_size
    gui.log(f"{len(_frames)} frames, {size:,} bytes")
    assert 100_000 < size < 6_000_000
