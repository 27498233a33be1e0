"""A page of a report in a browser, moved by a driver that frames it."""

from __future__ import annotations

import html
import json
import re
import subprocess
from pathlib import Path
from typing import Any

import pytest


def driven(program: str | None, page: Path, folder: Path, driver: str) -> dict[str, Any]:
    """Return what a driver puts as JSON into `data-found` of its own root; the test is skipped without a browser.

    Args:
        program: the browser; None: there is none.
        page: framed by the driver as page.html.
        driver: HTML.
    """
    if program is None:
        pytest.skip("no chromium here")
    (folder / "page.html").write_text(page.read_text(encoding="utf-8"), encoding="utf-8")
    framing = folder / "driver.html"
    framing.write_text(driver, encoding="utf-8")
    options = ["--headless=new", "--no-sandbox", "--disable-gpu", f"--user-data-dir={folder / 'profile'}"]
    options += ["--allow-file-access-from-files", "--window-size=1400,900", "--enable-logging=stderr", "--v=0"]
    words = [program, *options, "--virtual-time-budget=4000", "--dump-dom", framing.as_uri()]
    done = subprocess.run(words, capture_output=True, text=True, check=False, timeout=60)
    assert "CONSOLE" not in done.stderr, done.stderr
    found = re.search(r'data-found="([^"]*)"', done.stdout)
    assert found is not None
    return dict(json.loads(html.unescape(found[1])))
