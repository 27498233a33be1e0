"""How many workers commands have: as many in all of them where they are not told, so that none surprises."""

from __future__ import annotations

from typing import Annotated

import typer

DEFAULT = 2
"""Every machine of today has two cores. Results do not depend on it."""
Workers = Annotated[
    int, typer.Option("--workers", "-w", min=1, help="How many work at the same time; results do not depend on it.")
]
