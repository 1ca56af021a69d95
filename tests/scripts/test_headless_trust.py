# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of strangers, as docs/trust.md has them: each attack, and what comes of it."""

import json
import os
import shutil
import struct
import subprocess
import sys
import zipfile
from importlib.metadata import version
from pathlib import Path

import pytest
from batch_kit import CUBE, QUICK, batch, statuses
from headless import SCRIPT, headless_ok, headless_refused, headless_shared, make_blend

BEGIN = """
import sys
import bpy
from pathlib import Path
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.mesh.primitive_cube_add()
cube, scene, outside = bpy.context.object, bpy.context.scene, Path(sys.argv[1]).parents[1]
bpy.context.preferences.filepaths.save_version = 0
bpy.ops.wm.save_as_mainfile(filepath=sys.argv[1])  # without a place there is no cache on disk
"""
END = """
bpy.ops.wm.save_as_mainfile(filepath=sys.argv[1], relative_remap=False)
"""
PICTURE = ("--samples", "1", "--resolution", "32", "32")
MESH = ("--no-render", *QUICK)
PIXELS = """
image = bpy.data.images.new("secret", 4, 4)
image.filepath_raw, image.file_format = str(outside / "secret.png"), "PNG"
image.save()
image.source = "FILE"
"""
MATERIAL = """
material = bpy.data.materials.new("m")
if material.node_tree is None:
    material.use_nodes = True
nodes, links = material.node_tree.nodes, material.node_tree.links
texture = nodes.new("ShaderNodeTexImage")
texture.image = image
links.new(texture.outputs[0], nodes["Principled BSDF"].inputs[0])
cube.data.materials.append(material)
"""
RUNS = """
def touch(name):
    return f"__import__('pathlib').Path({str(outside / name)!r}).touch()"
driver = cube.driver_add("location", 0).driver
driver.type, driver.expression = "SCRIPTED", touch("driver") + " or 0"
text = bpy.data.texts.new("start.py")
text.write(touch("text"))
text.use_module = True
scene.render.use_freestyle = scene.view_layers[0].use_freestyle = True
style = scene.view_layers[0].freestyle_settings
style.mode = "SCRIPT"
style.modules.new().script = text
scene.render.filepath = str(outside / "render.png")
"""
PACKS = """
import contextlib
Path(image.filepath).rename(outside / "hidden")  # or it were packed at once
bpy.data.use_autopack = True
with contextlib.suppress(RuntimeError):  # says so, and saves
    bpy.ops.wm.save_as_mainfile(filepath=sys.argv[1])
"""
READ_IMAGE = """
import json, sys
import bpy
from pathlib import Path
bpy.ops.wm.open_mainfile(filepath=sys.argv[1])
image = bpy.data.images["secret"]
about = [image.filepath_from_user(), bool(image.packed_file)]
Path(sys.argv[1]).with_name("image.json").write_text(json.dumps(about))
"""
READ_COLOR = """
import json, sys
import bpy
from pathlib import Path
bpy.ops.wm.open_mainfile(filepath=sys.argv[1])
color = list(bpy.data.materials["red"].diffuse_color)
Path(sys.argv[1]).with_name("color.json").write_text(json.dumps(color))
"""
PLANT = f"""
import os, platform, sys
from pathlib import Path
sys.path.insert(0, {str(SCRIPT.parent)!r})
from cubic_craft.solver.console.temporary import replacing
path = Path(sys.argv[1])
secret = path.parents[1] / "secret.txt"
planted = path.with_name(f".result.cubic_craft-{{platform.node()}}-{{os.getpid()}}.obj")
planted.symlink_to(secret)
with replacing(path) as temporary:
    assert temporary == planted
    temporary.write_text("new")
"""
CRASH = f"""
import sys
from pathlib import Path
sys.path.insert(0, {str(SCRIPT.parent)!r})
from cubic_craft.cubic_craft_addon.command_line.trust.trial import try_to_read
try_to_read(Path(sys.argv[1]), "wm.not_there")
"""
USDA = '#usda 1.0\ndef Mesh "mesh"\n{\n'

# what makes a .blend that is refused, and words of the refusal
REFUSED = {
    "fluid": (
        """
cube.modifiers.new("Fluid", "FLUID").fluid_type = "DOMAIN"
cube.modifiers[0].domain_settings.cache_directory = str(outside / "fluid")
""",
        ["fluid", '"Cube"', "modifier"],
    ),
    "cloth on disk": (
        'cube.modifiers.new("Cloth", "CLOTH").point_cache.use_disk_cache = True',
        ["Cloth", '"Cube"', "Disk Cache"],
    ),
    "particles elsewhere": (
        """
cube.modifiers.new("Dust", "PARTICLE_SYSTEM")
cube.particle_systems[0].point_cache.use_external = True
""",
        ['"Cube"', "External"],
    ),
    "cache on disk later": (
        """
cube.modifiers.new("Cloth", "CLOTH")
cube.keyframe_insert('modifiers["Cloth"].point_cache.use_disk_cache', frame=1)
""",
        ["use_disk_cache", "animated"],
    ),
    "rigid bodies": (
        """
bpy.ops.rigidbody.world_add()
bpy.ops.rigidbody.object_add()
scene.rigidbody_world.point_cache.use_external = True
""",
        ["rigid bodies", '"Scene"', "Disk Cache"],
    ),
    "baked nodes": (
        """
group = bpy.data.node_groups.new("Nodes", "GeometryNodeTree")
modifier = cube.modifiers.new("Nodes", "NODES")
modifier.node_group, modifier.bake_directory = group, str(outside / "bake")
""",
        ['"Nodes"', "baked to another place"],
    ),
    "mesh cache": (
        'cube.modifiers.new("Cache", "MESH_CACHE").filepath = str(outside / "a.pc2")',
        ["Cache", "a.pc2", "folder"],
    ),
    "library": (
        """
bpy.data.libraries.write(str(outside / "library.blend"), {cube.data})
with bpy.data.libraries.load(str(outside / "library.blend"), link=True) as (_, loaded):
    loaded.meshes = ["Cube"]
cube.data = loaded.meshes[0]
""",
        ["library.blend", "folder"],
    ),
}


@pytest.fixture
def folder(tmp_path):
    """Folder of a stranger, in one where nothing may change and that has a secret."""
    (tmp_path / "secret.txt").write_text("secret")
    inner = tmp_path / "inner"
    inner.mkdir()
    return inner


def blend(folder, *lines):
    return make_blend("".join((BEGIN, *lines, END)), folder / "file.blend")


@pytest.mark.parametrize("case", REFUSED)
def test_a_blend_that_would_write_or_read_elsewhere_is_refused(folder, case):
    lines, words = REFUSED[case]
    source = blend(folder, lines)
    before = sorted(folder.parent.rglob("*"))
    headless_refused(source.name, *MESH, "--save-mesh", "a.obj", words=words, cwd=folder)
    assert sorted(folder.parent.rglob("*")) == before


def test_a_name_cannot_speak_to_the_terminal(folder):
    fluid, _ = REFUSED["fluid"]
    source = blend(folder, 'cube.name = "a\\x1b[2J\\nb"\n', fluid)
    headless_refused(source.name, *MESH, "--save-mesh", "a.obj", words=["\\x1b[2J"], cwd=folder)


def test_nodes_that_read_files_are_refused(folder):
    lines = """
group = bpy.data.node_groups.new("Nodes", "GeometryNodeTree")
cube.modifiers.new("Nodes", "NODES").node_group = group
if hasattr(bpy.types, "GeometryNodeImportSTL"):  # Blender 4.5
    group.nodes.new("GeometryNodeImportSTL")
    (outside / "has nodes").touch()
"""
    source = blend(folder, lines)
    process = headless_shared(source, *MESH, "--save-mesh", "a.obj", cwd=folder)
    is_refused = process.returncode == 2 and '"Nodes" read a file' in process.stderr
    assert is_refused == (folder.parent / "has nodes").exists()


def test_nothing_in_a_blend_runs(folder):
    source = blend(folder, RUNS)
    before = sorted(folder.parent.iterdir())
    headless_ok(source.name, *QUICK, *PICTURE, cwd=folder)
    assert sorted(folder.parent.iterdir()) == before
    assert sorted(path.name for path in folder.iterdir()) == ["cubic_craft.png", "file.blend"]


def test_a_texture_without_an_end_is_left_out(folder):
    zero = 'image = bpy.data.images.new("zero", 4, 4)\nimage.source = "FILE"\n'
    source = blend(folder, zero + 'image.filepath = "/dev/zero"\n', MATERIAL)
    process = headless_ok(source.name, *QUICK, *PICTURE, cwd=folder)
    assert "left out" in process.stderr and "/dev/zero" in process.stderr


def test_no_bytes_of_a_texture_outside_get_into_a_blend_but_its_path_does(folder):
    source = make_blend(BEGIN + PIXELS + MATERIAL + PACKS, folder / "file.blend")
    (folder.parent / "hidden").rename(folder.parent / "secret.png")
    headless_ok(source.name, *MESH, "--save-mesh", "out.blend", cwd=folder)
    make_blend(READ_IMAGE, folder / "out.blend")
    path, is_packed = json.loads((folder / "image.json").read_text())
    assert (Path(path), is_packed) == (folder.parent / "secret.png", False)


def test_nothing_outside_is_read_for_a_gltf(folder):
    for uri in ("../secret.txt", str(folder.parent / "secret.txt"), "data:/../../secret.txt"):
        (folder / "a.gltf").write_text(json.dumps(gltf(3, {"byteLength": 6, "uri": uri})))
        headless_refused("a.gltf", *MESH, "--save-mesh", "a.obj", words=["secret"], cwd=folder)


@pytest.mark.parametrize("is_sparse", [False, True])
def test_a_small_gltf_cannot_stand_for_much_data(folder, is_sparse):
    content = gltf(10**9)
    if is_sparse:
        content["accessors"][0] |= {"count": 3, "sparse": {"count": 10**9}}
    (folder / "a.gltf").write_text(json.dumps(content))
    words = ["a.gltf", "bytes", "export it again"]
    headless_refused("a.gltf", *MESH, "--save-mesh", "a.obj", words=words, cwd=folder)


def gltf(count, *buffers):
    """Return a glTF with one mesh of so many vertices."""
    view = {"buffer": 0, "byteLength": 6}
    accessor = {"componentType": 5126, "count": count, "type": "VEC3"}
    mesh = {"primitives": [{"attributes": {"POSITION": 0}}]}
    return {
        **{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}]},
        **{"nodes": [{"mesh": 0}], "meshes": [mesh], "buffers": list(buffers)},
        "accessors": [accessor | ({"bufferView": 0} if buffers else {})],
        "bufferViews": [view] if buffers else [],
    }


@pytest.mark.skipif(version("bpy") < "4.3", reason="it does not write every package")
@pytest.mark.parametrize("library", ["in.mtl", "../out.mtl"])
def test_no_texture_outside_gets_into_a_usdz(folder, library):
    make_blend(BEGIN + PIXELS, folder / "unused.blend")
    (folder / library).write_text("newmtl red\nKd 1 0 0\nmap_Kd -bm 0.5 ../secret.png\n")
    (folder / "a.obj").write_text(f"mtllib {library}\nusemtl red\n{CUBE}")
    process = headless_ok("a.obj", *MESH, "--save-mesh", "a.usdz", cwd=folder)
    assert "a.obj: left out" in process.stderr
    with zipfile.ZipFile(folder / "a.usdz") as package:
        assert package.namelist() == ["a.usdc"], "nor does it tell where it was made"


def test_materials_that_lie_beside_stay_where_others_are_left_out(folder):
    (folder / "in.mtl").write_text("newmtl red\nKd 1 0 0\n")
    (folder.parent / "out.mtl").write_text("newmtl green\nKd 0 1 0\n")
    text = "mtllib in.mtl\nmtllib ../out.mtl\nusemtl red\n" + CUBE
    (folder / "a.obj").write_text(text)
    headless_ok("a.obj", *MESH, "--save-mesh", "out.blend", cwd=folder)
    make_blend(READ_COLOR, folder / "out.blend")
    assert json.loads((folder / "color.json").read_text()) == [1, 0, 0, 1]


@pytest.mark.skipif(sys.platform == "win32", reason="it has no such files")
def test_no_pipe_is_waited_for(folder):
    os.mkfifo(folder / "pipe.png")
    os.mkfifo(folder / "pipe.obj")
    (folder / "in.mtl").write_text("newmtl red\nmap_Kd pipe.png\n")
    (folder / "a.obj").write_text(f"mtllib in.mtl\nusemtl red\n{CUBE}")
    process = headless_ok("a.obj", *MESH, "--save-mesh", "b.obj", cwd=folder)
    assert "left out" in process.stderr and "pipe.png" in process.stderr
    (folder / "a.fbx").write_text('RelativeFilename: "pipe.png"')
    (folder / "a.usda").write_text(USDA + "asset file = @./pipe.png@\n}\n")
    for name in ("a.fbx", "a.usda", "pipe.obj"):
        words = [name, "pipe"]
        headless_refused(name, *MESH, "--save-mesh", "c.obj", words=words, cwd=folder)


@pytest.mark.parametrize("name", ["a.usda", "a.usdc", "a.usdz"])
def test_no_layer_outside_is_read_for_a_usd(folder, inputs, name):
    shutil.copy(inputs / "awkward.usdc", folder.parent / "secret.usdc")
    crate = crate_with(b"../secret.usdc")
    (folder / "b.usda").write_text(USDA.replace("1.0", "1.0\n(subLayers = [@./a.usda@])"))
    layer = b'#usda 1.0\ndef Xform "x" (references = @../secret.usdc@</root>)\n{\n}\n'
    content = {"a.usda": layer, "a.usdc": crate, "a.usdz": b"PK\3\4" + bytes(60) + crate}[name]
    (folder / name).write_bytes(content)
    words = [name, "secret.usdc"]
    headless_refused(name, *MESH, "--save-mesh", "a.obj", words=words, cwd=folder)
    if name == "a.usda":
        words = ["b.usda", "secret.usdc"]
        headless_refused("b.usda", *MESH, "--save-mesh", "a.obj", words=words, cwd=folder)


def crate_with(text):
    """Return a binary USD file with nothing but a table of one text, as one literal of LZ4."""
    block = bytes([len(text) + 1 << 4] if len(text) < 14 else [0xF0, len(text) + 1 - 15])
    table = b"\0" + block + text + b"\0"
    start = 88
    contents = start + 24 + len(table)
    head = struct.pack("<8s8Bq64x", b"PXR-USDC", 0, 8, *(0,) * 6, contents)
    sizes = struct.pack("<QQQ", 1, len(text) + 1, len(table))
    sections = struct.pack("<Q16sqq", 1, b"TOKENS", start, len(table) + 24)
    return head + sizes + table + sections


def test_a_crash_of_an_importer_is_one_line(folder):
    """An importer that is not there stands in for it: none of Blender 5.3 is known to crash."""
    (folder / "a.usda").write_text(USDA + "}")
    command = [sys.executable, "-c", CRASH, folder / "a.usda"]
    said = subprocess.run(command, capture_output=True, text=True, check=False).stderr
    assert "a.usda: cannot be read (it crashes Blender" in said and "export it again" in said


@pytest.mark.skipif(sys.platform == "win32", reason="it needs rights for links")
def test_nothing_is_written_through_a_link(folder):
    (folder / "a.obj").write_text(CUBE)
    elsewhere = folder.parent / "elsewhere"
    elsewhere.mkdir()
    for link in ("out/.cubic_craft", "walk.abc.unfinished"):
        (folder / link).parent.mkdir(exist_ok=True)
        (folder / link).symlink_to(elsewhere)
    runs = (
        (*MESH, "--save-mesh", ".obj", "--output-folder", "out"),
        (*QUICK, "--bake", "walk.abc", "--frames", 1, 2),
    )
    for options in runs:
        headless_refused("a.obj", *options, words=["is a link", "remove it"], cwd=folder)
    make_blend(PLANT, folder / "result.obj")
    assert (folder / "result.obj").read_text() == "new"
    assert (folder.parent / "secret.txt").read_text() == "secret"
    assert list(elsewhere.iterdir()) == []


@pytest.mark.skipif(sys.platform == "win32", reason="it has no pipes, and needs rights for links")
def test_a_batch_takes_neither_links_out_of_its_folder_nor_pipes(folder):
    (folder.parent / "secret.obj").write_text(CUBE)
    meshes = folder / "meshes"
    meshes.mkdir()
    (meshes / "link.obj").symlink_to(folder.parent / "secret.obj")
    os.mkfifo(meshes / "pipe.obj")
    process = batch("meshes", "--report", "report.json", cwd=folder)
    assert process.returncode == 3, process.stderr
    assert statuses(folder) == {"link.obj": "failed"}
    assert "leads out of the folder" in process.stderr and "pipe" in process.stderr
