# SPDX-License-Identifier: GPL-3.0-or-later
"""A figure in an A-pose, of round limbs in one skin, with a rig of the usual bones.

The skin is where a smooth union of capsules ends, in a grid that is symmetric about x = 0.
"""

import numpy as np

import bpy  # isort: skip
from scene import select  # isort: skip

ARM = np.array([1.0, 0.0, -1.0]) / 2**0.5
LEG = np.array([np.sin(np.radians(15.0)), 0.0, -np.cos(np.radians(15.0))])
SHOULDER, HIP = np.array([0.2, 0.0, 1.42]), np.array([0.11, 0.0, 0.92])
ELBOW, WRIST = SHOULDER + 0.3 * ARM, SHOULDER + 0.58 * ARM
KNEE, ANKLE = HIP + 0.42 * LEG, HIP + 0.8 * LEG

BONES = {
    # name: head, tail, parent
    "Hips": ((0, 0, 0.92), (0, 0, 1.08), None),
    "Spine": ((0, 0, 1.08), (0, 0, 1.25), "Hips"),
    "Chest": ((0, 0, 1.25), (0, 0, 1.47), "Spine"),
    "Neck": ((0, 0, 1.47), (0, 0, 1.57), "Chest"),
    "Head": ((0, 0, 1.57), (0, 0, 1.84), "Neck"),
    "UpperArm.L": (SHOULDER, ELBOW, "Chest"),
    "LowerArm.L": (ELBOW, WRIST, "UpperArm.L"),
    "Hand.L": (WRIST, WRIST + 0.13 * ARM, "LowerArm.L"),
    "UpperLeg.L": (HIP, KNEE, "Hips"),
    "LowerLeg.L": (KNEE, ANKLE, "UpperLeg.L"),
    "Foot.L": (ANKLE, ANKLE + [0.0, -0.17, -0.06], "LowerLeg.L"),
}
"""those with .L have mirror images"""
LIMBS = tuple(
    f"{name}.{side}"
    for name in ("UpperArm", "LowerArm", "Hand", "UpperLeg", "LowerLeg", "Foot")
    for side in "LR"
)
CAPSULES = (
    # from, to, radius
    ((0.08, 0, 0.95), (0.09, 0, 1.36), 0.13),
    ((0, 0, 1.4), (0, 0, 1.6), 0.055),
    ((0, 0, 1.66), (0, 0, 1.74), 0.115),
    (SHOULDER, WRIST, 0.055),
    (WRIST, WRIST + 0.09 * ARM, 0.06),
    (HIP, ANKLE, 0.075),
    (ANKLE + [0, 0.0, -0.02], ANKLE + [0, -0.14, -0.04], 0.06),
)
"""those beside the middle have mirror images"""
_CELL = 0.028
_BLEND = 0.03
_SOFT = 0.02  # of the weights
_TRUNK = ("Hips", "Spine", "Chest")


def mirrored(point):
    """Return the mirror image of a point."""
    return np.asarray(point, dtype=float) * [-1.0, 1.0, 1.0]


def all_bones():
    """Return BONES with those of the other side."""
    found = dict(BONES)
    for name, (head, tail, parent) in BONES.items():
        if name.endswith(".L"):
            other = parent and parent.replace(".L", ".R")
            found[name.replace(".L", ".R")] = (mirrored(head), mirrored(tail), other)
    return found


def distances(points, head, tail):
    """Return the distances (n,) of points from a segment."""
    head, tail = np.asarray(head, float), np.asarray(tail, float)
    along = tail - head
    share = np.clip((points - head) @ along / (along @ along), 0.0, 1.0)
    return np.linalg.norm(points - head - share[:, None] * along, axis=1)


def _inside(points):
    """Return how deep points are within the figure (n,), by a smooth union."""
    total = np.zeros(len(points))
    for head, tail, radius in CAPSULES:
        sides = [(head, tail)]
        if head[0] != 0.0:
            sides.append((mirrored(head), mirrored(tail)))
        for one, other in sides:
            total += np.exp((radius - distances(points, one, other)) / (0.3 * _BLEND))
    return 0.3 * _BLEND * np.log(total)


def figure_mesh():
    """Return vertices (n,3) and quads (m,4) of the figure, symmetric bit for bit."""
    low, high = np.array([-0.85, -0.32, -0.02]), np.array([0.85, 0.2, 1.95])
    count = np.round((high - low) / _CELL).astype(int)
    count[0] += count[0] % 2
    x = (np.arange(count[0]) - 0.5 * (count[0] - 1)) * _CELL
    y, z = low[1] + _CELL * np.arange(count[1]), low[2] + _CELL * np.arange(count[2])
    centers = np.stack(np.meshgrid(x, y, z, indexing="ij"), axis=-1)
    half = centers[: count[0] // 2]
    is_half = (_inside(half.reshape(-1, 3)) > 0.0).reshape(half.shape[:3])
    is_in = np.concatenate([is_half, is_half[::-1]])
    faces = []
    grid = np.arange(np.prod(count + 1)).reshape(count + 1)
    for axis in range(3):
        padded = np.pad(is_in, [(1, 1) if a == axis else (0, 0) for a in range(3)])
        for sign in (1, -1):
            step = np.moveaxis(padded, axis, 0)
            out = step[:-1] & ~step[1:] if sign > 0 else ~step[:-1] & step[1:]
            i = np.moveaxis(np.stack(np.nonzero(out)), 0, 1)
            at = np.zeros((len(i), 3), int)
            others = [a for a in range(3) if a != axis]
            at[:, axis], at[:, others] = i[:, 0], i[:, 1:]
            corners = []
            for a, b in ((0, 0), (1, 0), (1, 1), (0, 1)):
                corner = at.copy()
                corner[:, (axis + 1) % 3] += a
                corner[:, (axis + 2) % 3] += b
                corners.append(grid[tuple(corner.T)])
            faces.append(np.stack(corners[::sign], axis=1))
    faces = np.concatenate(faces)
    used, faces = np.unique(faces, return_inverse=True)
    faces = faces.reshape(-1, 4)
    ijk = np.stack(np.unravel_index(used, count + 1), axis=1)
    V = np.stack(
        [(ijk[:, 0] - 0.5 * count[0]) * _CELL, y[0] - 0.5 * _CELL + ijk[:, 1] * _CELL,
         z[0] - 0.5 * _CELL + ijk[:, 2] * _CELL], axis=1)  # fmt: skip
    return _projected(V, ijk, faces, count), faces


def _projected(V, ijk, faces, count):
    """Move the corners of cells onto the skin, those with x >= 0 and their images."""
    from scipy.sparse import csr_matrix

    edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 3]], faces[:, [3, 0]]])
    n = len(V)
    means = csr_matrix((np.ones(len(edges)), (edges[:, 0], edges[:, 1])), shape=(n, n))
    means = means.maximum(means.T)
    degree = np.asarray(means.sum(axis=1))
    at = {tuple(key): number for number, key in enumerate(ijk)}
    image = np.array([at[count[0] - i, j, k] for i, j, k in ijk])
    is_left = ijk[:, 0] * 2 > count[0]
    is_middle = ijk[:, 0] * 2 == count[0]
    for step in range(8):
        V = 0.5 * V + 0.5 * (means @ V) / degree
        if step >= 4:
            e = 1e-4
            gradient = np.stack(
                [(_inside(V + e * d) - _inside(V - e * d)) / (2 * e) for d in np.eye(3)], axis=1
            )
            depth = _inside(V)
            V = V - 0.9 * (depth / np.maximum((gradient**2).sum(axis=1), 0.25))[:, None] * gradient
        V[is_middle, 0] = 0.0
        V[image[is_left]] = mirrored(V[is_left])
    return V.astype(np.float32).astype(float)


def figure_weights(V):
    """Return the weights (n,) of each bone by name, symmetric."""
    bones = all_bones()
    narrowed = V.copy()  # the trunk is wider than its bones
    narrowed[:, 0] = np.copysign(np.maximum(np.abs(V[:, 0]) - 0.09, 0.0), V[:, 0])
    far = []
    for name, (head, tail, _) in bones.items():
        is_trunk = name in _TRUNK
        radius = 0.13 if is_trunk else 0.055 if name == "Neck" else 0.11 if name == "Head" else 0.06
        far.append(distances(narrowed if is_trunk else V, head, tail) - radius)
    far = np.stack(far, axis=1)
    share = np.exp(-(far - far.min(axis=1, keepdims=True)) / _SOFT)
    share[share < 0.02] = 0.0
    share /= share.sum(axis=1, keepdims=True)
    return dict(zip(bones, share.T, strict=True))


def add_figure(name="Figure", *, mesh=None, bones=None, weights=None):
    """Add the figure with its rig, and return both."""
    V, faces = mesh or figure_mesh()
    data = bpy.data.meshes.new(name)
    data.from_pydata(V.tolist(), [], faces.tolist())
    obj = bpy.data.objects.new(name, data)
    bpy.context.scene.collection.objects.link(obj)
    rig = add_rig(bones or all_bones())
    for bone, values in (weights or figure_weights(V)).items():
        group = obj.vertex_groups.new(name=bone)
        for index in np.flatnonzero(values > 0.0).tolist():
            group.add([index], float(values[index]), "REPLACE")
    modifier = obj.modifiers.new("Armature", "ARMATURE")
    modifier.object = rig
    select(obj)
    return obj, rig


def add_rig(bones):
    """Add an armature with bones: name to head, tail and the name of the parent."""
    rig = bpy.data.objects.new("Rig", bpy.data.armatures.new("Rig"))
    bpy.context.scene.collection.objects.link(rig)
    select(rig)
    bpy.ops.object.mode_set(mode="EDIT")
    for bone_name, (head, tail, _) in bones.items():
        bone = rig.data.edit_bones.new(bone_name)
        bone.head, bone.tail = head, tail
    for bone_name, (_, _, parent) in bones.items():
        if parent:
            rig.data.edit_bones[bone_name].parent = rig.data.edit_bones[parent]
    bpy.ops.object.mode_set(mode="OBJECT")
    return rig
