# SPDX-License-Identifier: GPL-3.0-or-later
"""The version of the manifest is either released, or spoken of as one that is to come."""

import re
import tomllib

from documents import PAGES, ROOT

CHANGELOG = ROOT / "CHANGELOG.md"


def test_the_changelog_knows_the_version():
    manifest = tomllib.loads((ROOT / "blender_manifest.toml").read_text(encoding="utf-8"))
    version = manifest["version"]
    text = CHANGELOG.read_text(encoding="utf-8")
    if re.search(rf"^## \[{re.escape(version)}\] - \d{{4}}-\d\d-\d\d$", text, re.MULTILINE):
        return
    unreleased = text.split("\n## [Unreleased]\n")[1].split("\n## ")[0]
    assert f"This will be {version}" in unreleased
    for page in set(PAGES) - {CHANGELOG}:
        words = page.read_text(encoding="utf-8")
        assert not re.search(rf"\b{re.escape(version)}\b", words), f"{page.name} has {version}"
