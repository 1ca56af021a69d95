# SPDX-License-Identifier: GPL-3.0-or-later
"""Normals that are stored as vectors in object space turn with the surface, and come back."""

import importlib

import bpy
import numpy as np
import pytest
from results import RESULTS
from snapshot import snapshot_object, unchanged

pytestmark = pytest.mark.parametrize("domain", ["POINT", "CORNER", "FACE"])

NAME = "custom_normal"


def add_cube(domain):
    """Add a cube of vectors with a length and a direction of their own each."""
    bpy.ops.mesh.primitive_cube_add()
    obj = bpy.context.object
    attribute = obj.data.attributes.new(NAME, "FLOAT_VECTOR", domain)
    vectors = np.random.default_rng(1).normal(size=(len(attribute.data), 3))
    attribute.data.foreach_set("vector", vectors.astype(np.float32).ravel())
    return obj


def read(mesh):
    attribute = mesh.attributes[NAME]
    flat = np.empty(3 * len(attribute.data), np.float32)
    attribute.data.foreach_get("vector", flat)
    return flat.reshape(-1, 3)


def quarters(axis, count):
    """Return matrices (count,3,3) of a quarter turn about an axis."""
    matrix = np.roll(np.diag([1.0, 0.0, 0.0]), (axis, axis), (0, 1))
    one, other = (axis + 1) % 3, (axis + 2) % 3
    matrix[one, other], matrix[other, one] = -1.0, 1.0
    return np.repeat(matrix[None], count, axis=0)


def write(bridge, mesh, rotations):
    positions = np.einsum("nij,nj->ni", rotations, bridge.original_positions(mesh))
    bridge.write_mesh(mesh, positions, rotations)


def test_they_turn_with_the_surface_and_come_back(bridge, domain):
    obj = add_cube(domain)
    before = read(obj.data)
    with unchanged(obj):
        for axis in range(3):  # each result starts from the original
            turn = quarters(axis, 8)
            write(bridge, obj.data, turn)
            np.testing.assert_allclose(read(obj.data), before @ turn[0].T, atol=1e-6)
        bridge.restore(obj)


def test_a_face_turns_as_its_corners_do(bridge, domain):
    """The lower half stays: of each side two corners turn, and two do not."""
    obj = add_cube(domain)
    before, mesh = read(obj.data), obj.data
    upper = bridge.read_positions(mesh)[:, 2] > 0
    turns = np.where(upper[:, None, None], quarters(2, 8), np.eye(3))
    write(bridge, mesh, turns)
    after = read(mesh)
    of_face = [turns[list(face.vertices)].mean(axis=0) for face in mesh.polygons]
    of_corner = [turns[loop.vertex_index] for loop in mesh.loops]
    matrices = {"POINT": turns, "CORNER": of_corner, "FACE": of_face}[domain]
    expected = np.einsum("kij,kj->ki", np.array(matrices), before)
    for vectors in (after, expected):
        vectors /= np.linalg.norm(vectors, axis=1, keepdims=True)
    np.testing.assert_allclose(after, expected, atol=1e-6)


def test_what_its_corners_cancel_out_stays(bridge, domain):
    """The upper half turns by a half, so that those of the four sides point nowhere."""
    obj = add_cube(domain)
    mesh = obj.data
    count = len(mesh.attributes[NAME].data)
    mesh.attributes[NAME].data.foreach_set("vector", np.tile([1.0, 0.0, 0.0], count))
    upper = bridge.read_positions(mesh)[:, 2] > 0
    half = quarters(2, 8) @ quarters(2, 8)
    write(bridge, mesh, np.where(upper[:, None, None], half, np.eye(3)))
    np.testing.assert_allclose(np.linalg.norm(read(mesh), axis=1), 1.0, atol=1e-6)


def test_all_results_can_be_undone(bridge, cubify, domain):
    obj = add_cube(domain)
    before = read(obj.data)
    for result in RESULTS:
        made = cubify(obj, result)
        is_turned = not np.array_equal(read(made.data), before)
        assert is_turned == (result != "SHAPE_KEY")
        bridge.restore(made)
        np.testing.assert_array_equal(read(made.data), before)
        bpy.context.view_layer.objects.active = obj


def test_edited_ones_are_turned_back(bridge, domain):
    obj = add_cube(domain)
    before, mesh = read(obj.data), obj.data
    write(bridge, mesh, quarters(0, 8))
    vectors = 3.0 * read(mesh)
    mesh.attributes[NAME].data.foreach_set("vector", vectors.ravel())
    bridge.restore(obj)
    np.testing.assert_allclose(read(mesh), 3.0 * before, atol=1e-5)


def test_a_failure_leaves_them_as_they_were(bridge, error, monkeypatch, domain):
    obj = add_cube(domain)
    write(bridge, obj.data, quarters(0, 8))
    before = snapshot_object(obj)
    results = importlib.import_module(f"{bridge.__name__}.result.results")

    def fail(*_):
        raise error("no")

    monkeypatch.setattr(results, "remove_cubic_key", fail)  # the last that is done
    with pytest.raises(error):
        write(bridge, obj.data, quarters(1, 8))
    assert snapshot_object(obj) == before
