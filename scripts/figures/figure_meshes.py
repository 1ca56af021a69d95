# SPDX-License-Identifier: GPL-3.0-or-later
"""Where meshes are loaded and cubified, each once, however many figures show them.

`homer.obj`, which the paper shows too, is left out: it is a trademarked character.
"""

import math
from argparse import Namespace
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import bpy
import numpy as np
from mathutils import Euler, Matrix, Vector

from cubic_craft.cubic_craft_addon.command_line.options.handles_file import read_handles
from cubic_craft.cubic_craft_addon.command_line.picture.gallery import YAW, Group, extent_of
from cubic_craft.cubic_craft_addon.command_line.picture.studio import surface
from cubic_craft.cubic_craft_addon.command_line.process.progress import task
from cubic_craft.cubic_craft_addon.command_line.reading.load_meshes import Loaded, load
from cubic_craft.cubic_craft_addon.command_line.solving.cubify_all import handles_of_all
from cubic_craft.cubic_craft_addon.command_line.writing.detached import detached_copy
from cubic_craft.cubic_craft_addon.mesh_bridge import original_positions, read_values
from cubic_craft.cubic_craft_addon.read.member import read_member
from cubic_craft.cubic_craft_addon.run.pipeline import prepare, solve
from cubic_craft.cubic_craft_addon.settings.values import Settings
from cubic_craft.solver.console.output import refusals_of
from cubic_craft.solver.method import PAPER

from . import shapes

AS_IN_THE_PAPER = {**PAPER, "keep_symmetric": True, "hold_rest": True}
"""settings for figures that show what the energy of the paper does; what is symmetric stays so"""

AWAY = (-0.62, -0.30)
"""middle of what stands beside a mesh from that of the mesh, to the right and away from the camera,
relative to its largest side"""
ROUGH_ITERATIONS = 8
"""after which meshes are about as cubic as they become"""


@dataclass(frozen=True)
class Role:
    """How a mesh comes onto the stage."""

    source: str | Callable[[], bpy.types.Object]
    """a file in the folder of meshes, or what makes one of Blender's own shapes"""
    turn: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """degrees that stand it upright as it is imported"""
    yaw: float = math.degrees(YAW)
    """degrees toward the camera"""
    size: float = 1.0
    """in the gallery; by the largest extent alone, long legs would make a mesh look small"""


ROLES = {
    "bunny": Role("bunny.obj", turn=(-90.0, 0.0, 0.0), size=0.95),
    "spot": Role("spot.obj", turn=(0.0, 0.0, 180.0)),
    "owl": Role("owl.obj", turn=(-90.0, 0.0, 0.0), size=1.15),
    "horse": Role("horse.ply", turn=(0.0, 0.0, 180.0), yaw=-55.0, size=1.3),
    "armadillo": Role("armadillo.obj", turn=(0.0, 0.0, 180.0), size=1.15),
    "monkey": Role(shapes.monkey),
    "bear": Role(shapes.bear),
    "fox": Role(shapes.fox, yaw=-25.0, size=1.5),
}


@dataclass(frozen=True)
class Model:
    """A mesh in a scene of its own."""

    name: str
    role: Role
    scene: bpy.types.Scene
    loaded: Loaded
    path: Path | None
    """of its file"""
    original: np.ndarray
    """(n,3) float32 positions, object space"""

    @property
    def object(self) -> bpy.types.Object:
        """The first, and mostly only object."""
        return self.loaded.objects[0]

    @property
    def place(self) -> Matrix:
        """Where the object is, stood upright."""
        turn = Euler([math.radians(angle) for angle in self.role.turn])
        return turn.to_matrix().to_4x4() @ self.object.matrix_world


class FigureMeshes:
    """Loads meshes, cubifies them, and makes groups for galleries."""

    def __init__(self, folder: Path | None, is_rough: bool) -> None:
        self._limit = {"max_iterations": ROUGH_ITERATIONS} if is_rough else {}
        self._folder = folder
        self._model, self._solve = cache(self._load), cache(self._solve_now)

    def there(self, names: Sequence[str], instead: Sequence[str]) -> list[Model]:
        """Return those of the names whose files are there; if none is, the shapes instead."""
        return [self._model(name) for name in filter(self._path, names)] or [
            self._model(name) for name in instead
        ]

    def handles(self, model: Model, file: Path) -> tuple[Any, ...]:
        """Return the handles of a model that a file describes."""
        options = Namespace(pin=[], handles=read_handles(file), input=model.path)
        return handles_of_all(model.loaded, options)[model.object.name]

    def cubified(
        self,
        model: Model,
        cubeness: float,
        orientation: tuple[float, float, float] = (0.0, 0.0, 0.0),
        **others: Any,
    ) -> np.ndarray:
        """Return the cubic positions (n,3) float32 in object space.

        `orientation`: Euler angles of the cube in degrees, relative to the mesh. `others`: of
        `cubic_craft_addon.settings.values.Settings`. Raises InputError: the mesh cannot be
        cubified.
        """
        radians = tuple(math.radians(angle) for angle in orientation)
        settings = Settings(
            cubeness=cubeness, orientation=radians, space="OBJECT", **self._limit, **others
        )
        return self._solve(model.name, settings)

    def group(self, model: Model, positions: np.ndarray, label: str, finish: str) -> Group:
        """Return a copy of the model with other positions, for a gallery."""
        copy = detached_copy(model.object, positions, keep_modifiers=True)
        points = moved(positions, model.place)
        extent = extent_of(moved(model.original, model.place)) / model.role.size
        yaw = math.radians(model.role.yaw)
        return Group(label, [copy], [model.place], points, extent, finish, yaw)

    def _path(self, name: str) -> Path | None:
        source = ROLES[name].source
        path = self._folder / source if self._folder and isinstance(source, str) else None
        return path if path is not None and path.exists() else None

    def _load(self, name: str) -> Model:
        role, path, scene = ROLES[name], self._path(name), bpy.data.scenes.new(name)
        bpy.context.window.scene = scene
        loaded = Loaded([role.source()]) if callable(role.source) else load(path, None)
        bpy.context.view_layer.update()
        original = original_positions(loaded.objects[0].data)
        return Model(name, role, scene, loaded, path, original)

    def _solve_now(self, name: str, settings: Settings) -> np.ndarray:
        model = self._model(name)
        bpy.context.window.scene = model.scene
        title = f"{name}, cubeness {settings.cubeness:g}"
        with task(title) as shown, refusals_of(model.path or name):
            (solution,) = solve(prepare([read_member(model.object, settings)]))
            shown.summary = f"{solution.result.iterations} iterations, {solution.seconds:.1f} s"
        return solution.positions


def moved(points: np.ndarray, matrix: Matrix) -> np.ndarray:
    """Return points (n,3) float64 where a matrix takes them."""
    array = np.array(matrix)
    return points @ array[:3, :3].T + array[:3, 3]


def stand_beside(group: Group, obj: bpy.types.Object, matrix: Matrix) -> None:
    """Put an object in no scene, turned or scaled by a matrix, on the floor beside a group."""
    points = moved(read_values(obj.data.vertices, "co", width=3).astype(np.float64), matrix)
    low, high = group.points.min(axis=0), group.points.max(axis=0)
    away = Vector((*AWAY, 0.0)) * group.extent
    away.rotate(Matrix.Rotation(-group.yaw, 3, "Z"))
    middle = Vector((low + high) / 2) + away
    middle.z = low[2] - points[:, 2].min()
    place = Matrix.Translation(middle)
    group.copies.append(obj)
    group.places.append(place @ matrix)
    group.points = np.concatenate([group.points, moved(points, place)])


def colored_by(kind: str, roughness: float, **settings: Any) -> bpy.types.Material:
    """Return a material whose color is that of a new node of a kind with these settings."""
    material = surface("Colored", (1.0, 1.0, 1.0), roughness)
    nodes, links = material.node_tree.nodes, material.node_tree.links
    node = nodes.new(kind)
    for name, value in settings.items():
        setattr(node, name, value)
    links.new(node.outputs["Color"], nodes["Principled BSDF"].inputs["Base Color"])
    return material
