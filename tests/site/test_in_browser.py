# SPDX-License-Identifier: GPL-3.0-or-later
"""The site as a reader sees it in Chromium, opened from the disk; `make test-site`.

It leaves pictures of some pages in ``build/site_pictures``, as wide as a phone and as a desktop.
"""

import html
import json
import re
import shutil
import subprocess
from pathlib import Path
from urllib.parse import quote

import pytest

ROOT = Path(__file__).parents[2]
SITE = ROOT / "build" / "site"
PICTURES = ROOT / "build" / "site_pictures"
PHONE = Path(__file__).with_name("phone.html")
PHONE_WIDTH = 390  # pixels, that of its frame
BROWSERS = ("chromium-headless-shell", "chromium", "google-chrome")
BROWSER = next(filter(None, map(shutil.which, BROWSERS)), None)
LIGHT, DARK = 1, 0

pytestmark = [
    pytest.mark.skipif(BROWSER is None, reason="no Chromium here"),
    pytest.mark.skipif(not (SITE / "index.html").exists(), reason="make docs builds the site"),
]


@pytest.fixture
def browse(tmp_path):
    """Return a function that opens an address and gives what Chromium prints."""

    def opened(address, *options):
        command = [
            *(BROWSER, "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars"),
            *("--allow-file-access-from-files", f"--user-data-dir={tmp_path}"),
            *("--virtual-time-budget=60000", *options, address),
        ]
        run = subprocess.run(command, capture_output=True, text=True, check=True, timeout=180)
        return run.stdout

    return opened


def on_phone(*pages):
    """Return the address at which pages are shown as wide as on a phone."""
    addresses = [(SITE / page).as_uri() for page in pages]
    return f"{PHONE.as_uri()}#{quote(json.dumps(addresses))}"


@pytest.mark.parametrize(
    ("words", "page"),
    [
        ("solidity", "guide/presets.html"),
        ("symmetry", "guide/form_and_volume.html"),
        ("install", "index.html"),
        ("rest_mesh", "library.html"),
    ],
)
def test_search_finds_from_the_disk_and_shows_the_guide_first(browse, words, page):
    found = search(browse, words)
    assert found, "the search finds nothing"
    assert found[0] == (SITE / page).as_uri()


@pytest.mark.parametrize(
    ("words", "page"),
    [(".glb", "send_to.html"), ("--jobs", "batch.html"), ("pip", "library.html")],
)
def test_search_finds_endings_options_and_commands(browse, words, page):
    assert (SITE / page).as_uri() in search(browse, words)


def search(browse, words):
    """Return the addresses of the pages that the search finds, the best first."""
    document = browse(f"{(SITE / 'index.html').as_uri()}?q={quote(words)}", "--dump-dom")
    return re.findall(r'<a href="([^"?#]*)[^"]*" class="md-search-result__link"', document)


def test_no_page_is_wider_than_a_phone(browse):
    pages = sorted(path.relative_to(SITE) for path in SITE.rglob("*.html"))
    title = re.search("<title>(.*?)</title>", browse(on_phone(*pages), "--dump-dom"))
    widths = json.loads(html.unescape(title[1]))
    assert len(widths) == len(pages)
    assert {page: width for page, width in widths.items() if width > PHONE_WIDTH} == {}


@pytest.mark.thorough(3)
@pytest.mark.parametrize("scheme", [LIGHT, DARK], ids=["light", "dark"])
@pytest.mark.parametrize("page", ["index", "first_sculpture", "guide/live", "how_it_works"])
def test_pictures(browse, page, scheme):
    name = f"{page.replace('/', '_')}_{'dark' if scheme == DARK else 'light'}"
    PICTURES.mkdir(parents=True, exist_ok=True)
    for width, address in (
        (PHONE_WIDTH, on_phone(f"{page}.html")),
        (1280, (SITE / f"{page}.html").as_uri()),
    ):
        picture = PICTURES / f"{name}_{width}.png"
        picture.unlink(missing_ok=True)
        browse(
            address,
            f"--screenshot={picture}",
            f"--window-size={width},844",
            f"--blink-settings=preferredColorScheme={scheme}",
        )
        assert picture.exists()
