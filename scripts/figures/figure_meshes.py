# SPDX-License-Identifier: GPL-3.0-or-later
"""Where meshes are loaded and cubified, each once, however many figures show them."""

import math
from argparse import Namespace
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import bpy
import numpy as np
from headless.detached import detached_copy
from headless.errors import InputError
from headless.extension import Extension
from headless.gallery import Group, extent_of
from headless.handles_file import read_handles
from headless.load_meshes import Loaded, load
from headless.pose import handles_of_all
from headless.progress import ProgressBar
from mathutils import Euler, Matrix

from .models import FILES, OWN_SHAPES, Role

__all__ = ("AS_IN_THE_PAPER", "FigureMeshes", "Model", "moved")

AS_IN_THE_PAPER = {"solidity": 0.0, "together": "OFF", "refine": "OFF", "rotation": "FREE"}
"""settings for figures that show what the energy of the paper does"""


@dataclass(frozen=True)
class Model:
    """A mesh of the cast, in a scene of its own."""

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
    """Loads the cast, cubifies it, and makes groups for galleries."""

    def __init__(
        self,
        extension: Extension,
        root: Path,
        folder: Path | None,
        bar: ProgressBar,
        verbose: bool,
    ) -> None:
        self.extension = extension
        self.root = root
        self._folder = folder
        self._bar = bar
        self._verbose = verbose
        self._models: dict[str, Model] = {}
        self._solved: dict[tuple, np.ndarray] = {}

    def there(self, names: Sequence[str], instead: Sequence[str]) -> list[Model]:
        """Return those of the names whose files are there; if none is, the shapes instead."""
        files = [name for name in names if self._path(FILES[name])]
        return [self._model(name) for name in files or instead]

    def handles(self, model: Model, file: Path) -> tuple[Any, ...]:
        """Return the handles of a model that a file of `examples` describes."""
        options = Namespace(pin=[], handles=read_handles(file), input=model.path)
        return handles_of_all(model.loaded, options, self.extension)[model.object.name]

    def cubified(
        self,
        model: Model,
        cubeness: float,
        orientation: tuple[float, float, float] = (0.0, 0.0, 0.0),
        **others: Any,
    ) -> np.ndarray:
        """Return the cubic positions (n,3) float32 in object space.

        Parameters
        ----------
        orientation : Euler angles of the cube in degrees, relative to the mesh
        others : of `cubic_craft_addon.settings.values.Settings`

        Raises
        ------
        InputError
            The mesh cannot be cubified.
        """
        radians = tuple(math.radians(angle) for angle in orientation)
        settings = self.extension.settings.Settings(
            cubeness=cubeness, orientation=radians, space="OBJECT", **others
        )
        key = (model.name, settings)
        if key not in self._solved:
            self._solved[key] = self._solve(model, settings)
        return self._solved[key]

    def group(self, model: Model, positions: np.ndarray, label: str, finish: str) -> Group:
        """Return a copy of the model with other positions, for a gallery."""
        copy = detached_copy(model.object, positions, self.extension, keep_modifiers=True)
        points = moved(positions, model.place)
        extent = extent_of(moved(model.original, model.place)) / model.role.size
        return Group(label, [copy], [model.place], points, extent, finish, model.role.yaw)

    def _path(self, role: Role) -> Path | None:
        path = self._folder / role.file if self._folder is not None and role.file else None
        return path if path is not None and path.exists() else None

    def _model(self, name: str) -> Model:
        if name not in self._models:
            role = FILES.get(name) or OWN_SHAPES[name]
            scene = bpy.data.scenes.new(name)
            bpy.context.window.scene = scene
            path = self._path(role)
            if role.make is not None:
                loaded = Loaded([role.make()])
            else:
                loaded = load(path, None, self._verbose)
            bpy.context.view_layer.update()
            original = self.extension.mesh_bridge.original_positions(loaded.objects[0].data)
            self._models[name] = Model(name, role, scene, loaded, path, original)
        return self._models[name]

    def _solve(self, model: Model, settings: Any) -> np.ndarray:
        bpy.context.window.scene = model.scene
        with self._bar.task(f"{model.name}, cubeness {settings.cubeness:g}") as task:
            try:
                member = self.extension.member.read_member(model.object, settings)
                prepared = self.extension.assembly.prepare([member])
                (solution,) = self.extension.pipeline.solve(prepared)
            except self.extension.solver.CubicCraftError as error:
                raise InputError(f"{model.path or model.name}: {error}") from error
            task.finish(f"{solution.result.iterations} iterations, {solution.seconds:.1f} s")
        return solution.positions


def moved(points: np.ndarray, matrix: Matrix) -> np.ndarray:
    """Return points (n,3) float64 where a matrix takes them."""
    array = np.array(matrix)
    return points @ array[:3, :3].T + array[:3, 3]
