# SPDX-License-Identifier: GPL-3.0-or-later
"""The lock is complete, and the cache is never trusted."""

import pytest
from made_up import LINUX, good_wheels, sha256

from scripts.package import fetch, pip
from scripts.package.locked import needed_by_solver, read_lock
from scripts.package.wheel import requirement_name


def test_everything_that_the_solver_needs_is_locked():
    locked = read_lock()
    for requirement in needed_by_solver():
        version, hashes = locked[requirement_name(requirement)]
        assert requirement.specifier.contains(version) and hashes


def test_nothing_locked_is_blenders_own():
    assert "numpy" not in read_lock()


def test_a_wheel_cut_short_is_fetched_again(tmp_path, monkeypatch):
    """And only then: the second time nothing is asked for."""
    (name, content) = next(item for item in good_wheels().items() if item[0].startswith("deep"))
    lock = tmp_path / "lock"
    lock.write_text(f"# {name}\ndeep==1.0 \\\n    --hash=sha256:{sha256(content)}\n")
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
        assert fetch.fetch(LINUX, "3.11", tmp_path / "cache", lock) == [folder / name]
    assert asked == [("download", "linux-x64", "3.11")]


def test_a_changed_wheel_is_not_used(tmp_path, monkeypatch):
    (name, content) = next(item for item in good_wheels().items() if item[0].startswith("deep"))
    lock = tmp_path / "lock"
    lock.write_text(f"deep==1.0 --hash=sha256:{sha256(b'another')}\n")
    folder = tmp_path / "cache" / "linux-x64-python3.11"
    folder.mkdir(parents=True)
    (folder / name).write_bytes(content)
    asked = []
    monkeypatch.setattr(pip, "run", lambda *arguments: asked.append(arguments))
    with pytest.raises(SystemExit, match="pip has not brought deep as locked"):
        fetch.fetch(LINUX, "3.11", tmp_path / "cache", lock)
    assert len(asked) == 1
