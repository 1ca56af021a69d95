# SPDX-License-Identifier: GPL-3.0-or-later
"""How a setting is declared, for Blender, the command lines and the library alike."""

from collections.abc import Callable, Sequence
from dataclasses import field, fields
from typing import Any, NamedTuple


class Setting(NamedTuple):
    """What is declared of a setting."""

    default: Any
    label: str
    """in the panel"""
    text: str
    """the tooltip"""
    help: str | None = None
    """of the option on command lines, to which the default is added; None for no option"""
    option: str = ""
    """the name of the option without its dashes, if it is another one"""
    metavar: Any = None
    limits: tuple[float, float] | None = None
    """the least and the largest"""
    soft: tuple[float, float] | None = None
    """the ends of the slider, if it is shorter"""
    digits: int = 3
    """behind the point"""
    subtype: str = "NONE"
    """Blender's; EULER are angles in radians, and degrees on command lines"""
    choices: tuple[Any, ...] = ()
    """identifier, label, text and, if it is not its place, the number of each"""
    of_forms: tuple[str, ...] = ()
    """the forms that have it, if not all do"""
    paper: Any = None
    """value as in the paper, also with ``--paper``; None leaves it as it is"""
    in_animation: Any = None
    """value in all frames of an animation; None for that of the frame"""
    is_of_all_frames: bool = False
    """whether it says which vertices are solved, so that it cannot be animated"""
    is_of_mesh: bool = False
    """whether each of several objects keeps its own"""
    keeps_result: bool = False
    """whether a result does not become outdated by it"""


def setting(default: Any, numbers: Sequence[int] = (), **about: Any) -> Callable[..., Any]:
    """Return what makes the field of a dataclass, which is a setting, from its words.

    `numbers`: of the choices, if they are not their places. `about`: other fields of a `Setting`.
    What it returns takes the label, the text, the help if there is an option, and ``choices``: as
    `Setting` has them, or a dict of identifiers and "label: text".
    """

    def declare(label: str, text: str, help: str | None = None, choices: Any = ()) -> Any:
        if isinstance(choices, dict):
            choices = [(name, *words.split(": ", 1)) for name, words in choices.items()]
        if numbers:
            choices = [(*words, number) for words, number in zip(choices, numbers, strict=True)]
        found = Setting(default, label, text, help, choices=tuple(choices), **about)
        return field(default=default, metadata={"setting": found})

    return declare


def declared(*groups: type) -> dict[str, Setting]:
    """Return the settings of dataclasses by their names."""
    every = (each for group in groups for each in fields(group))
    return {each.name: each.metadata["setting"] for each in every if "setting" in each.metadata}
