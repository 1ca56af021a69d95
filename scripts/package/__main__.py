# SPDX-License-Identifier: GPL-3.0-or-later
"""Build the packages of the extension that bring the wheels it needs, and host them."""

import argparse
import shutil
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:1] = [str(ROOT / "scripts"), str(ROOT)]  # not this folder: its names are too common

from package.targets import PLATFORMS, packages_for, packages_to_upload  # noqa: E402

DIST = ROOT / "dist"


def arguments():
    """Return the parsed command line."""
    parser = argparse.ArgumentParser(prog="package", description=__doc__)
    commands = parser.add_subparsers(dest="command", required=True)
    build = commands.add_parser("build", help="build the zips, one for each platform and Python")
    build.add_argument("--platforms", nargs="+", choices=PLATFORMS, default=list(PLATFORMS))
    upload = commands.add_parser("upload", help="build the zips for the extensions platform")
    for command, folder in ((build, "packages"), (upload, "upload")):
        command.add_argument("plain", type=Path, help="the extension without wheels")
        command.add_argument("--output", type=Path, default=DIST / folder)
    repository = commands.add_parser("repository", help="a folder for a web server")
    repository.add_argument("zips", nargs="+", type=Path)
    repository.add_argument("--output", type=Path, default=DIST / "repository")
    return parser.parse_args()


def main():
    """Do what the command line says."""
    options = arguments()
    if options.command == "repository":
        make_repository(options.zips, options.output)
        return
    from package.build import build_package

    is_upload = options.command == "upload"
    if is_upload:
        packages = packages_to_upload()
    else:
        packages = [each for name in options.platforms for each in packages_for(PLATFORMS[name])]
    for platform in {package.platform.name.replace("-", "_") for package in packages}:
        for stale in options.output.glob(f"cubic_craft-*-{platform}*"):
            stale.unlink()
    for package in packages:
        path = build_package(package, options.plain, options.output, is_upload)
        print(f"{path.stat().st_size / 1e6:6.1f} MB  {path.name}")


def make_repository(zips, output):
    """Copy the zips into a folder for any web server; Blender's tool writes the listing and a page.

    All addresses in the listing are relative, so that the folder can lie anywhere. The zip without
    wheels does not belong there: it is for all platforms, and Blender would then find two.
    """
    from build_extension import blender_tool

    shutil.rmtree(output, ignore_errors=True)
    output.mkdir(parents=True)
    for path in zips:
        shutil.copy(path, output / path.name)
    blender_tool("server-generate", "--repo-dir", output, "--html")


if __name__ == "__main__":
    main()
