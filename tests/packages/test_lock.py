# SPDX-License-Identifier: GPL-3.0-or-later
"""The locks are complete, and the cache is never trusted."""

import json

import pytest
from made_up import LINUX, good_wheels, sha256

from scripts.package import fetch, lock, pip
from scripts.package.locked import REQUIREMENTS, needed_by_solver, read_lock
from scripts.package.targets import PLATFORMS, packages_for
from scripts.package.wheel import holding, requirement_name

PACKAGES = [package for platform in PLATFORMS.values() for package in packages_for(platform)]
LOCKS = sorted({package.lock for package in PACKAGES})


@pytest.mark.parametrize("package", PACKAGES, ids=lambda package: package.file_name("1"))
def test_everything_that_the_solver_needs_is_locked(package):
    locked = read_lock(REQUIREMENTS / package.lock)
    for requirement in holding(needed_by_solver(), package.platform, package.python):
        version, hashes = locked[requirement_name(requirement)]
        assert requirement.specifier.contains(version) and hashes


def test_each_package_has_one_engine():
    engines = {"taichi", "quadrants"}
    found = [engines & read_lock(REQUIREMENTS / package.lock).keys() for package in PACKAGES]
    newest = [package.python == "3.14" for package in PACKAGES]
    assert found == [{"quadrants"} if is_newest else {"taichi"} for is_newest in newest]


@pytest.mark.parametrize("name", LOCKS)
def test_nothing_locked_is_blenders_own(name):
    assert "numpy" not in read_lock(REQUIREMENTS / name)


def test_the_markers_of_requirements_are_those_of_the_target(tmp_path, monkeypatch):
    """Whatever Python and machine the lock is made with."""
    asked = {}

    def resolve(command, platform, python, *options):
        asked[platform.name, python] = {str(option).partition("==")[0] for option in options}
        return json.dumps({"install": []})

    monkeypatch.setattr(pip, "run", resolve)
    for package in PACKAGES:
        lock.write_lock(tmp_path / package.lock, [package])
    assert {"taichi", "cholespy", "pyamg", "scipy"} <= asked["windows-x64", "3.13"]
    assert {"quadrants", "cholespy", "pyamg", "scipy"} <= asked["linux-x64", "3.14"]
    assert {"quadrants", "scipy"} <= asked["linux-arm64", "3.14"]
    assert not {"taichi", "cholespy"} & asked["linux-arm64", "3.14"]


def test_a_wheel_cut_short_is_fetched_again(tmp_path, monkeypatch):
    """And only then: the second time nothing is asked for."""
    (name, content) = next(item for item in good_wheels().items() if item[0].startswith("deep"))
    locked = tmp_path / "lock"
    locked.write_text(f"# {name}\ndeep==1.0 \\\n    --hash=sha256:{sha256(content)}\n")
    folder = tmp_path / "cache" / "linux-x64-python3.11"
    folder.mkdir(parents=True)
    (folder / name).write_bytes(content[: len(content) // 2])
    asked = []

    def download(command, platform, python, *options):
        asked.append((command, platform.name, python))
        assert "--require-hashes" in options
        (folder / name).write_bytes(content)

    monkeypatch.setattr(pip, "run", download)
    for _ in range(2):
        assert fetch.fetch(LINUX, "3.11", tmp_path / "cache", locked) == [folder / name]
    assert asked == [("download", "linux-x64", "3.11")]


def test_a_changed_wheel_is_not_used(tmp_path, monkeypatch):
    (name, content) = next(item for item in good_wheels().items() if item[0].startswith("deep"))
    locked = tmp_path / "lock"
    locked.write_text(f"deep==1.0 --hash=sha256:{sha256(b'another')}\n")
    folder = tmp_path / "cache" / "linux-x64-python3.11"
    folder.mkdir(parents=True)
    (folder / name).write_bytes(content)
    asked = []
    monkeypatch.setattr(pip, "run", lambda *arguments: asked.append(arguments))
    with pytest.raises(SystemExit, match="pip has not brought deep as locked"):
        fetch.fetch(LINUX, "3.11", tmp_path / "cache", locked)
    assert len(asked) == 1
