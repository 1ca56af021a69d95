# SPDX-License-Identifier: GPL-3.0-or-later
"""Check what is in a package. Blender's own validator opens no wheel and misses all of this."""

import json
import tomllib
import zipfile
from pathlib import Path, PurePosixPath

from .locked import REQUIREMENTS, needed_by_solver, read_lock
from .rules import rule_problems
from .targets import NUMPY_OF_BLENDER, SIZE_LIMIT_BYTES, all_packages
from .wheel import Wheel, holding, requirement_name

BILL = "sbom.cdx.json"  # the bill of materials
FROM_BLENDER = "numpy"  # extensions share it with Blender, so none may bring one


def check(path, package=None, lock=None, needed=None, limit=SIZE_LIMIT_BYTES):
    """Compare a zip with what it promises.

    Parameters
    ----------
    path : Path
        The zip.
    package : Package, optional
        Its promise; by default that of its name.
    lock : dict, optional
        Version and hashes by name; by default the lock of its wheels.
    needed : list of Requirement, optional
        What the extension imports; by default the requirements of the solver.
    limit : int
        Largest size, in bytes.

    Returns
    -------
    list of str
        The problems; empty if all is well.
    """
    path = Path(path)
    package = package or _promise_of(path)
    lock = read_lock(REQUIREMENTS / package.lock) if lock is None else lock
    needed = needed_by_solver() if needed is None else needed
    with zipfile.ZipFile(path) as archive:
        manifest = tomllib.loads(archive.read("blender_manifest.toml").decode())
        names = archive.namelist()
        bill = json.loads(archive.read(BILL)) if BILL in names else {}
        wheels = [
            Wheel.read(PurePosixPath(name).name, archive.open(name))
            for name in names
            if name.endswith(".whl")
        ]
        problems = rule_problems(archive, manifest)
    problems += _manifest_problems(manifest, package, names)
    problems += _credit_problems(wheels, names, bill)
    problems += [p for wheel in wheels for p in _wheel_problems(wheel, package, lock)]
    used = set()
    problems += _dependency_problems(wheels, package, needed, used)
    for wheel in wheels:
        is_foreign = wheel.name == FROM_BLENDER or not wheel.fits(package.platform, package.python)
        if wheel.file_name not in used and not is_foreign:
            problems.append(f"{wheel.file_name} is needed by nothing")
    size = path.stat().st_size
    if size >= limit:
        problems.append(f"it has {size:,} bytes, {limit:,} or more")
    return problems


def _promise_of(path):
    """Return the package with the name of the file."""
    with zipfile.ZipFile(path) as archive:
        manifest = tomllib.loads(archive.read("blender_manifest.toml").decode())
    for package in all_packages():
        if package.file_name(manifest["version"]) == path.name:
            return package
    raise ValueError(f"{path.name} is not the name of a package")


def _manifest_problems(manifest, package, names):
    """Compare the manifest with the promise and with the files in the zip."""
    problems = []
    listed = {name.removeprefix("./") for name in manifest.get("wheels", [])}
    inside = {name for name in names if name.endswith(".whl")}
    problems += [f"{name} is in the manifest but not in the zip" for name in listed - inside]
    problems += [f"{name} is in the zip but not in the manifest" for name in inside - listed]
    if manifest.get("platforms") != [package.platform.name]:
        problems.append(f"its platforms are {manifest.get('platforms')}")
    expected = {"blender_version_max": None, **package.blender_versions()}
    for field, value in expected.items():
        if manifest.get(field) != value:
            problems.append(f"its {field} is {manifest.get(field)}, not {value}")
    return problems


def _credit_problems(wheels, names, bill):
    """Check that all that is bundled is credited and listed."""
    problems = [f"{name} is missing" for name in ("THIRD_PARTY.md", BILL) if name not in names]
    listed = {h["content"] for part in bill.get("components", []) for h in part["hashes"]}
    for wheel in wheels:
        if not any(name.startswith(f"licences/{wheel.name}/") for name in names):
            problems.append(f"there is no licence text of {wheel.name}")
        if bill and wheel.sha256 not in listed:
            problems.append(f"{wheel.file_name} is not in {BILL}")
    return problems


def _wheel_problems(wheel, package, lock):
    """Check a wheel by itself."""
    problems = []
    if wheel.name == FROM_BLENDER:
        problems.append(f"{wheel.file_name} would take the place of Blender's own")
    elif wheel.name not in lock:
        problems.append(f"{wheel.file_name} is not locked")
    else:
        version, hashes = lock[wheel.name]
        if wheel.version != version or wheel.sha256 not in hashes:
            problems.append(f"{wheel.file_name} is not the locked file of version {version}")
    if not wheel.fits(package.platform, package.python):
        here = f"{package.platform.name}, Python {package.python}"
        problems.append(f"{wheel.file_name} is not for {here}")
    if wheel.misplaced:
        problems.append(f"{wheel.file_name} has files where older Blenders leave them unfound")
    return problems


def _dependency_problems(wheels, package, needed, used):
    """Follow all dependencies; adds the file names of what is needed to `used`."""
    problems = []
    platform, python = package.platform, package.python
    here = f"{platform.name}, Python {python}"
    waiting = [(r, "the solver") for r in holding(needed, platform, python)]
    seen = set()
    while waiting:
        requirement, wanted_by = waiting.pop()
        name = requirement_name(requirement)
        if name == FROM_BLENDER:
            for version in NUMPY_OF_BLENDER[python]:
                if not requirement.specifier.contains(version):
                    text = f"{wanted_by} needs {requirement}, some Blenders have {version} ({here})"
                    problems.append(text)
            continue
        found = [wheel for wheel in wheels if wheel.name == name and wheel.fits(platform, python)]
        if not found:
            problems.append(f"{name} has no wheel for {here}; {wanted_by} needs it")
        elif not requirement.specifier.contains(found[0].version):
            problems.append(f"{wanted_by} needs {requirement}, not {found[0].version} ({here})")
        if len(found) > 1 and name not in seen:
            files = ", ".join(wheel.file_name for wheel in found)
            problems.append(f"Blender would install only one of {files} ({here})")
        if found and name not in seen:
            seen.add(name)
            used.update(wheel.file_name for wheel in found)
            waiting += [(r, name) for r in found[0].requirements(platform, python)]
    return list(dict.fromkeys(problems))
