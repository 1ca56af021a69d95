# SPDX-License-Identifier: GPL-3.0-or-later
"""The options of both command lines stay as they are: names, values, limits and what --help says.

`frozen_options.json` has them as they were, and how a command line is read.
"""

import argparse
import json
from pathlib import Path

from scripts.cubic_craft.cubic_craft_addon.command_line.options import arguments as of_blender

from library.command_line import arguments as of_library
from tests import frozen

FROZEN = Path(__file__).with_name("frozen_options.json")
COMMANDS = {
    "blender": (of_blender._parser("command"), of_blender.parse),
    "library": (of_library._parser(), of_library.parse),
}
FILES = {"blender": "--no-render --report r.json", "library": "a.obj b.obj"}
OTHERS = (
    "--crispness 0.2 --solidity 0.4 --keep-pose off --detail 0.3 --detail-strength 2 "
    "--keep-apart off --together off --refine off --rotation free"
)
GIVEN = {
    "library": (
        "--paper",
        "--paper --keep-pose on --detail 0.1 --keep-apart on --together parts --refine auto",
        OTHERS,
    )
}
GIVEN["blender"] = (
    *GIVEN["library"],
    "--paper --symmetry x --hold-rest on",
    f"{OTHERS} --symmetry off --hold-rest off --floor on --space object --map A --detail-map B",
)


def about(action):
    """Return all that a parser knows of an option; its limits as they are told."""
    found = {
        name: value
        for name in ("dest", "nargs", "default", "metavar", "help", "required")
        if (value := getattr(action, name)) is not None
    }
    if action.choices:
        found["choices"] = list(action.choices)
    if action.type not in (None, Path):
        found["refuses"] = [refusal(action, text) for text in ("nan", "1.5", "x")]
    return {**found, "action": type(action).__name__.removeprefix("_")}


def refusal(action, text):
    try:
        return repr(action.type(text))
    except argparse.ArgumentTypeError as error:
        return str(error)


def declared():
    for command, (parser, parse) in COMMANDS.items():
        for action in parser._actions:
            if "--version" not in action.option_strings:
                yield f"{command} {[*action.option_strings, action.dest][0]}", about(action)
        files = FILES[command].split()
        nothing = vars(parse(files))
        yield f"{command} reads nothing", nothing
        for given in GIVEN[command]:
            read = vars(parse([*files, *given.split()]))
            yield f"{command} reads {given}", {n: x for n, x in read.items() if x != nothing[n]}


def test_options_of_both_command_lines_are_as_they_were():
    frozen.check(json.loads(json.dumps(dict(declared()), default=str)), FROZEN)
