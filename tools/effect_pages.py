"""Write the tables of docs/reference/effects out of the code: forms, where they act, parameters with their priors.

What stands between `<!-- begin NAME -->` and `<!-- end -->` is written, and all.md whole. Equations and confounded
effects are text of people; all.md takes the equations from the pages.

Usage: python -m tools.effect_pages [--check]
"""

from __future__ import annotations

import re
import sys
from collections.abc import Iterable, Sequence
from pathlib import Path

from edesign.calibration.dampers.effect import EffectForm
from edesign.calibration.dampers.law_forces import accepted
from edesign.core.damper import PLACEMENTS, EffectValues
from edesign.damper.laws import LAWS
from tools.effect_forms import Row, damper_rows, structure_rows, table_rows

ROOT = Path(__file__).resolve().parents[1]
FOLDER = ROOT / "docs" / "reference" / "effects"
BLOCK = re.compile(r"(<!-- begin (?P<name>\w+) -->\n).*?(<!-- end -->)", re.DOTALL)
STRUCTURES, TABLES, ALL = "structures", "tables", "all"
"""Pages of the effects of structures, of those that tables of moduli alone show, and of all of them in one table."""

_EQUATION = re.compile(
    r"^ {4}(?:(?P<effect>[a-z_]+)\.)?(?P<form>[a-zNQ_]+(?:_k)?) {2,}(?P<equation>\S.*)$", re.MULTILINE
)
_TOP = """# All effects in one table

<!-- written by tools/effect_pages.py -->

Each form of each effect that `edesign calibrate` knows. [The index](README.md) says what the symbols of the priors
mean; the pages of the effects say what parameters mean, and which effects are confounded.

"""
_HEAD = "| effect | equation | acts on | parameters and priors |\n|---|---|---|---|\n"


def page_of(row: Row) -> str:
    """Return the page, without its ending, that describes a form.

    Args:
        row: the form.
    """
    if row in _TABLE_ROWS:
        return TABLES
    return row.form.name if isinstance(row.form, EffectForm) else STRUCTURES


_TABLE_ROWS = table_rows()
ROWS: tuple[Row, ...] = (*damper_rows(), *_TABLE_ROWS, *structure_rows())
"""All forms."""


def equations(page: str) -> dict[tuple[str, str], str]:
    """Return the equations of a page by names of effect and form.

    Args:
        page: without its ending.
    """
    text = (FOLDER / f"{page}.md").read_text(encoding="utf-8")
    return {(found["effect"] or page, found["form"]): found["equation"] for found in _EQUATION.finditer(text)}


def texts() -> dict[Path, str]:
    """Return the text of every page as it should be."""
    found = {}
    for path in sorted(FOLDER.glob("*.md")):
        text = path.read_text(encoding="utf-8")
        found[path] = BLOCK.sub(lambda block: f"{block[1]}\n{_block(block['name'])}\n{block[3]}", text)
    return found | {FOLDER / f"{ALL}.md": _all()}


def _block(name: str) -> str:
    if name == "laws":
        return _laws()
    if name in ("damper", "rig", "instrument"):
        return _index([row for row in ROWS if row.form.name == page_of(row) and row.form.kind == name])
    return _forms([row for row in ROWS if page_of(row) == name], several=name in (STRUCTURES, TABLES))


def _table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    lines = [head, ["---"] * len(head), *rows]
    return (
        "".join("| " + " | ".join(cells) + " |\n" for cells in lines).replace("| --- ", "|---").replace("--- |", "---|")
    )


def _index(rows: Sequence[Row]) -> str:
    found = []
    for name in dict.fromkeys(row.form.name for row in rows):
        own = [row for row in rows if row.form.name == name]
        heading = (FOLDER / f"{name}.md").read_text(encoding="utf-8").partition("\n")[0]
        title = heading.removeprefix("# ").partition(" (`")[0]
        forms = ", ".join(dict.fromkeys(row.name for row in own))
        where = ", ".join(dict.fromkeys(place for row in own for place in row.where))
        files = ", ".join(dict.fromkeys(row.law_file for row in own if row.law_file)) or "-"
        found.append((f"[`{name}`]({name}.md)", title, forms, where, files))
    return _table(("effect", "what", "forms", "acts on", "in law files"), found)


def _forms(rows: Sequence[Row], several: bool) -> str:
    """Return tables of forms and of parameters, signatures and sources."""
    names = {id(row): f"{row.form.name}.{row.name}" if several else row.name for row in rows}
    head = ("form", "what", "acts on", "laws", "in law files")[: 3 if several else 5]
    cells = [
        (names[id(row)], row.title, ", ".join(row.where), ", ".join(row.laws) or "all", row.law_file or "-")
        for row in rows
    ]
    text = _table(head, [one[: len(head)] for one in cells])
    listed: dict[tuple[str, str, str, str], list[str]] = {}
    for row in rows:
        for one, prior, bounds in row.parameters:
            listed.setdefault((one.name, one.unit or "-", prior, bounds), []).append(names[id(row)])
        for name, value in row.fixed.items():
            listed.setdefault((name, "", f"fixed: {value}", ""), []).append(names[id(row)])
    if listed:
        of_each = [
            (f"`{name}`", ", ".join(dict.fromkeys(of)), unit, prior, bounds)
            for (name, unit, prior, bounds), of in listed.items()
        ]
        text += "\n" + _table(("parameter", "forms", "unit", "prior", "bounds"), of_each)
    for title, key in (("Signature", "signature"), ("Source", "source")):
        each: dict[str, list[str]] = {}
        for row in rows:
            each.setdefault(getattr(row.form, key), []).append(names[id(row)])
        items = [f"- {', '.join(dict.fromkeys(of))}: {what}.\n" for what, of in each.items()]
        text += f"\n{title}:\n\n" + "".join(items)
    return text


def _all() -> str:
    text = _TOP
    parts = (
        ("Of the damper", [row for row in ROWS if _kind(row) == "damper"]),
        ("Of the rig", [row for row in ROWS if _kind(row) == "rig"]),
        ("Of the instruments", [row for row in ROWS if _kind(row) == "instrument"]),
        ("Of tables of moduli", _TABLE_ROWS),
        ("Of structures", [row for row in ROWS if page_of(row) == STRUCTURES]),
    )
    known = {page: equations(page) for page in dict.fromkeys(map(page_of, ROWS))}
    for title, rows in parts:
        text += f"## {title}\n\n{_HEAD}"
        for row in rows:
            page, name = page_of(row), row.form.name
            equation = re.sub(r" {2,}", "; ", known[page].get((name, row.name), "").replace(",   ", ", "))
            equation = equation.replace("|", "\\|").replace("*", "\\*")
            of = "<br>".join(f"`{one.name}` ({one.unit or '-'}): {prior}" for one, prior, _ in row.parameters) or "-"
            laws = f"<br>of {', '.join(row.laws)}" if row.laws else ""
            cells = f"[{name}.{row.name}]({page}.md){laws}", equation, ", ".join(row.where), of
            text += "| " + " | ".join(cells) + " |\n"
        text += "\n"
    return text.rstrip("\n") + "\n"


def _kind(row: Row) -> str:
    own = row.form.name == page_of(row)
    return row.form.kind if own and isinstance(row.form, EffectForm) else ""


def _laws() -> str:
    """Return which placements each law takes, and which effects are its own."""
    sys.path.append(str(ROOT / "tests" / "support"))
    from damper_examples import EXAMPLES

    rows = []
    for name, law in LAWS.items():
        each = {place: EffectValues("payne.network", (0.1, 1.0, 1.0), place) for place in PLACEMENTS}
        of = [place for place, effect in each.items() if accepted(law, EXAMPLES[name], [effect])]
        own = dict.fromkeys(f"{row.form.name}.{row.name}" for row in ROWS if name in row.laws)
        rows.append((f"[`{name}`](../laws/{name}.md)", ", ".join(of) or "none", ", ".join(own) or "-"))
    return _table(("law", "placements", "effects that not every law has"), rows)


def main() -> int:
    """Write the pages, or with --check name those that are out of date."""
    old = [path for path, text in texts().items() if not path.exists() or path.read_text(encoding="utf-8") != text]
    for path in old:
        if "--check" in sys.argv[1:]:
            print(f"{path.relative_to(ROOT)} is out of date: python -m tools.effect_pages writes it", file=sys.stderr)
        else:
            path.write_text(texts()[path], encoding="utf-8")
    return int("--check" in sys.argv[1:] and bool(old))


if __name__ == "__main__":
    sys.exit(main())
