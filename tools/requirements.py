"""Print the requirements of one part of pyproject.toml, one a line, for `pip install -r`.

Usage: requirements.py build | run | dev | records | blind | peers | wheel | docs

pip cannot install an extra of an editable project without building the project again;
this keeps pyproject.toml the only list.
"""

from __future__ import annotations

import sys
import tomllib
from pathlib import Path


def requirements(part: str) -> list[str]:
    """Requirements of the build system (`build`), to run (`run`), or of an extra, as written in pyproject.toml."""
    config = tomllib.loads((Path(__file__).parent.parent / "pyproject.toml").read_text(encoding="utf-8"))
    lists: dict[str, list[str]] = {
        "build": config["build-system"]["requires"],
        "run": config["project"]["dependencies"],
        **config["project"]["optional-dependencies"],
    }
    return lists[part]


if __name__ == "__main__":
    print("\n".join(requirements(sys.argv[1])))
