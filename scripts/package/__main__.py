# SPDX-License-Identifier: GPL-3.0-or-later
"""Build the packages of the extension that bring the wheels it needs, check them, host them."""

import argparse
import os
import shutil
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:1] = [str(ROOT / "scripts"), str(ROOT)]  # not this folder: its names are too common

from package.check import check  # noqa: E402
from package.checksums import write_checksums  # noqa: E402
from package.targets import PLATFORMS, packages_for, packages_to_upload  # noqa: E402

DIST = ROOT / "dist"
CACHE = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "cubic_craft" / "wheels"


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
        command.add_argument("--cache", type=Path, default=CACHE, help="folder of the wheels")
    checks = commands.add_parser("check", help="check zips that have been built")
    checks.add_argument("zips", nargs="+", type=Path)
    repository = commands.add_parser("repository", help="a folder for a web server")
    repository.add_argument("zips", nargs="+", type=Path)
    repository.add_argument("--output", type=Path, default=DIST / "repository")
    sums = commands.add_parser("checksums", help="write those of all files in a folder")
    sums.add_argument("folder", type=Path)
    commands.add_parser("lock", help="choose the wheels anew")
    return parser.parse_args()


def main():
    """Do what the command line says."""
    options = arguments()
    if options.command == "lock":
        from package.lock import write_locks

        write_locks()
    elif options.command == "check":
        check_all(options.zips)
    elif options.command == "checksums":
        write_checksums(options.folder)
    elif options.command == "repository":
        make_repository(options.zips, options.output)
    elif options.command == "upload":
        build_uploads(options)
    else:
        build_all(options)


def build_all(options):
    """Build and list the packages; what another run has left in the folder is removed."""
    from package.build import build_package

    built = []
    for name in options.platforms:
        for stale in options.output.glob(f"cubic_craft-*-{name.replace('-', '_')}*"):
            stale.unlink()
        for package in packages_for(PLATFORMS[name]):
            built.append(build_package(package, options.plain, options.output, options.cache))
    write_checksums(options.output)
    show_sizes(built)


def build_uploads(options):
    """Build what is uploaded to the extensions platform, each range of Blenders as a version."""
    from package.build import build_package
    from package.upload import release_of, upload_problems, uploaded_version

    shutil.rmtree(options.output, ignore_errors=True)
    release = release_of(options.plain)
    built = []
    for package in packages_to_upload():
        version = uploaded_version(release, package)
        built.append(build_package(package, options.plain, options.output, options.cache, version))
    problems = upload_problems(built)
    if problems:
        raise SystemExit("\n".join(["the extensions platform would refuse them:", *problems]))
    show_sizes(built)


def show_sizes(paths):
    """List the zips."""
    for path in paths:
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


def check_all(zips):
    """Print the problems of all zips; ends with status 1 if there are any."""
    found = {path: check(path) for path in zips}
    for path, problems in found.items():
        print("\n  ".join([f"{path.name}: {'wrong' if problems else 'good'}", *problems]))
    raise SystemExit(any(found.values()))


if __name__ == "__main__":
    main()
