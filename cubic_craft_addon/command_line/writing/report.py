# SPDX-License-Identifier: GPL-3.0-or-later
"""The report: versions, and the numbers of every run."""

import contextlib
import importlib.metadata
import platform
import tomllib
from argparse import Namespace
from pathlib import Path
from typing import Any

import bpy
import numpy as np

from ....solver.console.method_options import names_of_options
from ....solver.console.run_words import numbers_of
from ....solver.method import Advanced, Kept, KeptInScene, Style, StyleInScene
from ...environment.requirements import new_engine_warnings
from ...run.pipeline import MemberProblem, Solution
from ..solving.cubify_all import Sculpture

SETTINGS = {
    *names_of_options(Style, StyleInScene, Kept, Advanced, KeptInScene).values(),
    *("region", "symmetry", "with_modifiers"),
} - {"cubeness"}  # which each run has
_MANIFEST = Path(__file__).resolve().parents[3] / "blender_manifest.toml"
OPTIONAL_PACKAGES = ("taichi", "quadrants", "scipy", "cholespy", "pyamg")


def report_of(
    about: dict[str, Any], options: Namespace, seconds: dict[str, float]
) -> dict[str, Any]:
    """Return all that there is to report of a run.

    `about`: from `about_sculptures` or `bake_frames`. `seconds`: what "load", "write", "render" or
    "bake" took, and "total".
    """
    settings = {name: getattr(options, name) for name in sorted(SETTINGS)}
    return {
        "versions": _versions(),
        "notices": new_engine_warnings(),
        "settings": settings,
        **about,
        "seconds": seconds,
    }


def about_sculptures(sculptures: list[Sculpture], cubeness: list[float]) -> dict[str, Any]:
    """Return what the report has of each object at each cubeness."""
    return {
        "device": sculptures[0].solutions[0].result.device,
        "objects": [_object(sculpture, cubeness) for sculpture in sculptures],
    }


def _versions() -> dict[str, str | None]:
    versions: dict[str, str | None] = {
        "cubic_craft": tomllib.loads(_MANIFEST.read_text(encoding="utf-8"))["version"],
        "blender": bpy.app.version_string,
        "python": platform.python_version(),
        "numpy": np.__version__,
    }
    for package in OPTIONAL_PACKAGES:
        versions[package] = None
        with contextlib.suppress(importlib.metadata.PackageNotFoundError):
            versions[package] = importlib.metadata.version(package)
    return versions


def _object(sculpture: Sculpture, cubeness: list[float]) -> dict[str, Any]:
    member, problem = sculpture.member, sculpture.problem
    return {
        "name": sculpture.object.name,
        "vertices": member.vertices,
        "triangles": member.triangles,
        "components": member.shape.components,
        # What is solved at once has one energy, which is in the runs of each of them.
        "solved_with": [other.name for other in problem.pieces if other is not member],
        "runs": [
            _run(value, solution, problem)
            for value, solution in zip(cubeness, sculpture.solutions, strict=True)
        ],
    }


def _run(cubeness: float, solution: Solution, problem: MemberProblem) -> dict[str, Any]:
    result = solution.result
    return {
        "cubeness": cubeness,
        **numbers_of(result),
        "seconds": {
            "setup": problem.seconds,
            "solve": solution.seconds,
            "compile": result.compile_seconds,
        },
    }
