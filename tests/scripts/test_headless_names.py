# SPDX-License-Identifier: GPL-3.0-or-later
"""Names that programs trip over, of files and in them: quotes, newlines, spaces, all encodings."""

import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from headless import headless, headless_ok, headless_shared
from scripts.cubic_craft.cubic_craft_addon.command_line.reading.obj_copy import readable_copy

NAMES = [
    "two words",
    'it\'s "quoted" `twice` $HOME;#',
    "line\nbreak",
    "Größe 立方体 🧊",
    "-leading",
    "percent%20 {brace} %d",
    "a" * 180,
]
ALONE = {("line\nbreak", "obj"), ("Größe 立方体 🧊", "blend")}
"""what goes to a process of its own, through the operating system's command line"""
TRIANGLE = "o part\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n"
QUICK = ("--device", "numpy", "--max-iterations", "2", "--samples", "1", "--resolution", "32", "32")

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="it forbids such names")


IN_FILES = {
    "GBK": "身体".encode("gbk"),
    "Windows-1251": "Тело".encode("cp1251"),
    "Latin-1": "Körper".encode("latin-1"),
    "a backslash in Shift-JIS": "表".encode("shift_jis"),
    "a backslash": b"parts\\",
    "UTF-8": "Körper # 立方体".encode(),
    "longer than in Blender": b"x" * 300,
}


@pytest.mark.thorough(5)
@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("suffix", ["obj", "blend"])
def test_every_file_may_have_any_name(tmp_path, name, suffix):
    folder = tmp_path / name
    folder.mkdir()
    (folder / f"{name}.obj").write_text(TRIANGLE)
    outputs = [f"{name} cubic.{suffix}", f"{name}.png", f"{name}.json"]
    before, after = ("--save-mesh", "--output", "--report"), outputs
    pairs = [f"{option}={value}" for option, value in zip(before, after, strict=True)]
    run = headless if (name, suffix) in ALONE else headless_shared
    headless_ok(f"./{name}.obj", *QUICK, *pairs, cwd=folder, run=run)
    assert sorted(p.name for p in folder.iterdir()) == sorted([f"{name}.obj", *outputs])
    assert list(tmp_path.iterdir()) == [folder], "something was written elsewhere"


@pytest.mark.parametrize("name", IN_FILES.values(), ids=IN_FILES)
def test_names_in_an_obj_may_have_any_encoding(tmp_path, name):
    """They come back as they were, as far as Blender holds them, and no line is lost."""
    lines = [b"o " + name, b"g " + name, b"# C:\\models\\", b"usemtl " + name]
    body = b"v 0 0 0\nv 1 0 \\\n 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n"
    (tmp_path / "a.obj").write_bytes(b"\n".join([*lines, body]))
    outputs = ("--no-render", "--cubeness", "0", "--save-mesh", "b.obj")
    headless_ok("a.obj", *QUICK, *outputs, cwd=tmp_path)
    written = (tmp_path / "b.obj").read_bytes().splitlines()
    positions = [line.split()[1:] for line in written if line.startswith(b"v ")]
    np.testing.assert_allclose(np.array(positions, float), [[0, 0, 0], *np.eye(3)], atol=1e-6)
    for keyword in (b"o ", b"usemtl "):
        (found,) = (line.removeprefix(keyword) for line in written if line.startswith(keyword))
        assert found == name[: len(found)] and len(found) >= min(len(name), 60)


def test_materials_in_another_encoding_are_found(tmp_path):
    """The copy that Blender reads lies elsewhere than what the files name."""
    library = "newmtl Größe\nmap_Kd -s 2 2 2 a picture.png\nmap_Ks none.png\n"
    (tmp_path / "Größe.mtl").write_bytes(library.encode("latin-1"))
    (tmp_path / "a picture.png").write_bytes(b"a picture")
    text = f"mtllib Größe.mtl\nusemtl Größe\n{TRIANGLE}"
    (tmp_path / "a.obj").write_bytes(text.encode("latin-1"))
    with readable_copy(tmp_path / "a.obj", "latin-1", np.zeros(3)) as copy:
        names = [line for line in copy.read_text("utf-8").splitlines() if "mtl" in line]
        found = copy.with_name("1.mtl").read_text("utf-8")
    assert names == ["mtllib 1.mtl", "usemtl Größe"]
    assert found == library.replace("a picture.png", str(tmp_path / "a picture.png"))
    assert not copy.parent.exists()
    outputs = ("--no-render", "--save-mesh", "b.obj")
    headless_ok("a.obj", *QUICK, *outputs, cwd=tmp_path)
    written = (tmp_path / "b.obj").read_bytes()
    assert written.startswith("mtllib Größe.mtl\n".encode())
    assert "\nusemtl Größe\n".encode("latin-1") in written


def test_colors_of_vertices_stay_beside_the_positions_that_are_moved(tmp_path):
    (tmp_path / "a.obj").write_text("v 1 2 3 0.5 0.25 1\nv 4 5 6\n")
    with readable_copy(tmp_path / "a.obj", "utf-8", np.array([1.0, 0.0, 3.0])) as copy:
        assert copy.read_text().splitlines() == ["v 0.0 2.0 0.0 0.5 0.25 1", "v 3.0 5.0 3.0"]


def test_the_build_takes_any_name(tmp_path):
    build = Path(__file__).resolve().parents[2] / "scripts" / "build_extension.py"
    folder = tmp_path / NAMES[1]
    subprocess.run([sys.executable, build, folder / "-a 立.zip"], check=True, capture_output=True)
    assert [path.name for path in folder.iterdir()] == ["-a 立.zip"]
    shutil.rmtree(folder)
