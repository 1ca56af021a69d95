# SPDX-License-Identifier: GPL-3.0-or-later
"""``--bake``: the frames of a rigged mesh in one file, read back; ended and continued."""

import json
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from headless import PATIENCE, headless_ok, headless_refused, start_headless
from rigged import FRAMES, make_rigged, read_pc2

ROUGH = ("--device", "numpy", "--refine", "off")
"""for tests of which frames are solved, and not how"""
READ_IN_BLENDER = """
import json, sys, bpy
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.wm.alembic_import(filepath=sys.argv[1], as_background_job=False)
scene, found = bpy.context.scene, {}
for frame in range(scene.frame_start, scene.frame_end + 1):
    scene.frame_set(frame)
    depsgraph = bpy.context.evaluated_depsgraph_get()
    for obj in scene.objects:
        if obj.type == "MESH":
            points = [list(v.co) for v in obj.evaluated_get(depsgraph).data.vertices]
            found.setdefault(obj.name, []).append(points)
frames = [scene.frame_start, scene.frame_end]
sys.stderr.write(json.dumps({"frames": frames, "points": found}))
"""


@pytest.fixture(scope="module")
def rigged(tmp_path_factory):
    """Return a file with two balls that bend."""
    return make_rigged(tmp_path_factory.mktemp("rigged") / "rigged.blend")


@pytest.fixture(scope="module")
def cached(rigged, tmp_path_factory):
    """Return the positions (FRAMES,162,3) of the first ball, from a point cache."""
    folder = tmp_path_factory.mktemp("cached")
    headless_ok(rigged, "--object", "Ball", *ROUGH, "--bake", "out.pc2", cwd=folder)
    assert [path.name for path in folder.iterdir()] == ["out.pc2"]
    return read_pc2(folder / "out.pc2")


def read_usd(path):
    script = Path(__file__).with_name("read_usd.py")
    found = subprocess.run([sys.executable, script, path], check=True, capture_output=True)
    return json.loads(found.stdout)


def read_alembic(path):
    command = [sys.executable, "-c", READ_IN_BLENDER, path]
    found = subprocess.run(command, check=True, capture_output=True, text=True)
    return json.loads(found.stderr.splitlines()[-1])


def test_frames_are_cubic(cached):
    assert cached.shape == (FRAMES, 162, 3)
    radii = np.linalg.norm(cached[0], axis=1)
    assert radii.max() / radii.min() > 1.3, "it is still a ball"
    assert np.abs(cached[-1] - cached[0]).max() > 0.1, "it does not bend"


@pytest.mark.parametrize(
    ("suffix", "read"), [("usdc", read_usd), ("usda", read_usd), ("abc", read_alembic)]
)
def test_other_programs_read_the_frames(rigged, cached, tmp_path, suffix, read):
    options = ("--object", "Ball", *ROUGH, "--bake", f"out.{suffix}", "--report", "out.json")
    headless_ok(rigged, *options, cwd=tmp_path)
    found = read(tmp_path / f"out.{suffix}")
    assert found["frames"] == [1, FRAMES]
    (points,) = found["points"].values()
    np.testing.assert_allclose(points, cached, atol=1e-6)
    report = json.loads((tmp_path / "out.json").read_text(encoding="utf-8"))
    assert report["frames"] == [1, FRAMES]
    (numbers,) = report["objects"]
    assert numbers["name"] == "Ball" and numbers["frames"] == FRAMES
    assert numbers["largest_jump"] <= 3.0 and report["seconds"]["bake"] > 0.0
    assert len(list(tmp_path.iterdir())) == 2


def test_all_objects_of_a_file_and_some_frames(rigged, tmp_path):
    headless_ok(rigged, *ROUGH, "--bake", "out.usdc", "--frames", "2", "4", cwd=tmp_path)
    found = read_usd(tmp_path / "out.usdc")
    assert found["frames"] == [2, 4]
    assert sorted(found["points"]) == ["Ball_Cubic", "Other_Cubic"]
    assert {len(frames) for frames in found["points"].values()} == {3}


def test_ended_in_the_middle_it_continues_bit_for_bit(rigged, tmp_path):
    options = ("--object", "Ball", "--frames", "1", "60", *ROUGH)
    whole, parts = tmp_path / "whole.pc2", tmp_path / "parts.pc2"
    headless_ok(rigged, *options, "--bake", whole, cwd=tmp_path)
    process = start_headless(str(rigged), *options, "--bake", str(parts), cwd=tmp_path)
    unfinished = tmp_path / "parts.pc2.unfinished" / "Ball.unfinished"
    end = time.monotonic() + PATIENCE
    while not ((unfinished / "state.npz").exists() and len(frames_in(unfinished)) > 5):
        assert process.poll() is None and time.monotonic() < end
        time.sleep(0.01)
    process.send_signal(signal.SIGTERM)
    process.communicate(timeout=PATIENCE)
    assert process.returncode == 128 + signal.SIGTERM
    assert not parts.exists() and len(frames_in(unfinished)) < 60
    headless_ok(rigged, *options, "--bake", parts, cwd=tmp_path)
    assert parts.read_bytes() == whole.read_bytes()
    assert sorted(tmp_path.iterdir()) == [parts, whole]


@pytest.mark.thorough
def test_a_batch_bakes_each_file_once(rigged, tmp_path):
    (tmp_path / "in").mkdir()
    for name in ("one", "two"):
        (tmp_path / "in" / f"{name}.blend").write_bytes(rigged.read_bytes())
    frames = ("--bake", "_cubic.usdc", "--frames", "1", "2")
    options = ("in", "--output-folder", "out", *frames, *ROUGH)
    headless_ok(*options, cwd=tmp_path)
    names = ["one_cubic.usdc", "two_cubic.usdc"]
    assert sorted(path.name for path in (tmp_path / "out").iterdir() if path.is_file()) == names
    paths = [tmp_path / "out" / name for name in names]
    assert all(read_usd(path)["frames"] == [1, 2] for path in paths)


def frames_in(folder):
    size = (folder / "frames.f32").stat().st_size if (folder / "frames.f32").exists() else 0
    return range(size // (162 * 40))


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (("--frames", "1", "2"), ["--frames", "--bake"]),
        (("--bake", "a.abc", "--frames", "3", "2"), ["--frames", "before"]),
        (("--bake", "a.obj"), ["--bake", ".abc", ".pc2"]),
        (("--bake", "a.abc", "--cubeness", "0.2", "0.4"), ["--cubeness", "each"]),
        (("--bake", "a.abc", "--save-mesh", "a.obj"), ["--save-mesh", "--bake"]),
        (("--bake", "a.pc2"), ["a.pc2", "one object", "--object"]),
        (("--bake", "no/a.abc"), ["--bake", "does not exist"]),
        (("--bake", "a.abc", "--pin", "Nose"), ["--pin Nose", "no such vertex group"]),
    ],
)
def test_refusals(rigged, tmp_path, options, words):
    headless_refused(rigged, *options, words=words, cwd=tmp_path)
