"""Arguments in docstrings that say nothing beyond their signature: `python -m tools.docstring_arguments [--remove]`.

What `edesign` exports describes all of its arguments. Elsewhere an entry stands for a unit, a shape, a range or a
meaning that names and types lack; `project: the validated project` is noise that hides the others.
"""

from __future__ import annotations

import ast
import re
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import edesign

ROOT = Path(__file__).parents[1]
SECTION = "Args:"
ENTRY = re.compile(r"\s*(?P<name>[*`\w, ]+):\s+(?P<text>.*)", re.DOTALL)

GRAMMAR = """a an the of its it is are was be in on at to for from by with and or that which who what where as this
these those their they one ones all any each every other others whose has have into""".split()
"""Words that join others."""

VAGUE = """block file given label list made name named number open own path read result row table thing validated value
whole written checked found core model unit text parsed""".split()
"""Words that are true of most arguments, and distinguish none from another."""

SAYS = re.compile(
    r'[0-9(;:=<>/_|`"]|None|True|False|default|, |[A-Z]{3}'  # values, symbols, names, a second clause
    r"|(?<!\w)(m|mm|N|kN|Nm|Pa|MPa|s|ms|Hz|kg|t|degC|K|rad|J|kJ|SI|g|%|degrees|points|years?|UTF)(?!\w)"  # units
)

LIMITS = re.compile(r"(?<!\w)(all|at least|without|not|only)(?!\w)")
"""Words by which an argument is less, or no less, than its type says."""


@dataclass(frozen=True)
class Entry:
    """An argument in a docstring.

    Attributes:
        path: of the module.
        lines: the first and the one behind the last, from 0.
        place: `function.argument`.
        text: what is said of it.
        signature: words that its name, type, function, module and the sentences above say.
        of_type: words that its name, its type and the first sentence of the docstring of this type say.
    """

    path: Path
    lines: tuple[int, int]
    place: str
    text: str
    signature: frozenset[str]
    of_type: frozenset[str]

    @property
    def says_nothing(self) -> bool:
        """Whether each of its words stands in the signature, or says nothing of any argument."""
        said, limited = words(self.text), LIMITS.search(self.text)
        return not SAYS.search(self.text) and (said <= self.signature or (said <= self.of_type and not limited))


def words(text: str) -> frozenset[str]:
    """The words of a text or of names in it, without grammar, in the singular."""
    split = re.findall(r"[A-Za-z]+", re.sub(r"([a-z])([A-Z])", r"\1 \2", text))
    found = {word.lower() for word in split}
    return frozenset(w[:-1] if len(w) > 3 and w.endswith("s") and not w.endswith("ss") else w for w in found) - SILENT


SILENT: frozenset[str] = frozenset({*GRAMMAR, *VAGUE})


def entries(path: Path) -> Iterator[Entry]:
    """The arguments in the docstrings of a module's functions and classes."""
    source = path.read_text(encoding="utf-8")
    lines = source.split("\n")
    module = words(" ".join(path.relative_to(ROOT).with_suffix("").parts))

    def of(node: ast.AST, above: frozenset[str]) -> Iterator[Entry]:
        for child in ast.iter_child_nodes(node):
            if isinstance(child, (ast.FunctionDef, ast.ClassDef)):
                own = above | words(child.name)
                if ast.get_docstring(child) is not None:
                    yield from _of_docstring(path, lines, child, own)
                yield from of(child, own)

    yield from of(ast.parse(source), module)


def _of_docstring(
    path: Path, lines: list[str], node: ast.FunctionDef | ast.ClassDef, known: frozenset[str]
) -> Iterator[Entry]:
    string = node.body[0]
    first, end = string.lineno - 1, (string.end_lineno or 0) - 1
    begin = next((i for i in range(first, end) if lines[i].strip() == SECTION), None)
    if begin is None:
        return
    known |= words(" ".join(lines[first:begin]))
    indent = len(lines[begin]) - len(lines[begin].lstrip()) + 4
    starts = []
    stop = begin + 1
    while stop < end and lines[stop].startswith(" " * indent):
        if not lines[stop].startswith(" " * (indent + 1)):
            starts.append(stop)
        stop += 1
    types = _types(node)
    for start, after in zip(starts, [*starts[1:], stop], strict=True):
        match = ENTRY.match(" ".join(line.strip() for line in lines[start:after]))
        if match is None:
            raise SystemExit(f"{path}:{start + 1}: this is no argument")
        name = match["name"].strip("*` ")
        own = words(name) | words(types.get(name, ""))
        of_type = own.union(*(of_types().get(one, ()) for one in re.findall(r"\w+", types.get(name, ""))))
        yield Entry(path, (start, after), f"{node.name}.{name}", match["text"], known | own, of_type)


@cache
def of_types() -> dict[str, frozenset[str]]:
    """What the first sentence of a class says, by the name of the class; of classes of one name what all say."""
    found: dict[str, frozenset[str]] = {}
    for path in (ROOT / "edesign").rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.ClassDef):
                said = words((ast.get_docstring(node) or "").partition("\n")[0])
                found[node.name] = found.get(node.name, said) & said
    return found


def _types(node: ast.FunctionDef | ast.ClassDef) -> dict[str, str]:
    """Annotations of the arguments, which a class has in its `__init__` or, of a dataclass, as its fields."""
    if isinstance(node, ast.ClassDef):
        fields = {
            s.target.id: s.annotation
            for s in node.body
            if isinstance(s, ast.AnnAssign) and isinstance(s.target, ast.Name)
        }
        found = {name: ast.unparse(annotation) for name, annotation in fields.items()}
        for item in node.body:
            if isinstance(item, ast.FunctionDef) and item.name == "__init__":
                found |= _types(item)
        return found
    arguments = [*node.args.posonlyargs, *node.args.args, *node.args.kwonlyargs, node.args.vararg, node.args.kwarg]
    return {one.arg: ast.unparse(one.annotation) for one in arguments if one and one.annotation}


def exported() -> frozenset[tuple[Path, str]]:
    """Module and name of what `edesign` exports."""
    objects = [getattr(edesign, name) for name in edesign.__all__]
    return frozenset(
        (ROOT / (one.__module__.replace(".", "/") + ".py"), one.__name__)
        for one in objects
        if hasattr(one, "__module__")
    )


def needless() -> list[Entry]:
    """Entries that say nothing, of all that `edesign` does not export."""
    out = exported()
    found = (entry for path in sorted((ROOT / "edesign").rglob("*.py")) for entry in entries(path))
    return [e for e in found if e.says_nothing and (e.path, e.place.partition(".")[0]) not in out]


def remove(found: list[Entry]) -> None:
    """Take entries out of their files, sections that nothing is left of, and lines that only closed a docstring."""
    for path in {entry.path for entry in found}:
        lines = path.read_text(encoding="utf-8").split("\n")
        for entry in sorted((e for e in found if e.path == path), key=lambda e: -e.lines[0]):
            begin, after = entry.lines
            del lines[begin:after]
            if lines[begin - 1].strip() == SECTION and (not lines[begin].strip() or lines[begin].strip() == '"""'):
                del lines[begin - 1]
                if not lines[begin - 2].strip():
                    del lines[begin - 2]
                    begin -= 1
                above = lines[begin - 2].strip()
                if lines[begin - 1].strip() == '"""' and above.startswith('"""') and len(lines[begin - 2]) <= 117:
                    lines[begin - 2] += '"""'
                    del lines[begin - 1]
        path.write_text("\n".join(lines), encoding="utf-8")


if __name__ == "__main__":
    listed = needless()
    if "--remove" in sys.argv[1:]:
        remove(listed)
    for entry in listed:
        print(f"{entry.path.relative_to(ROOT)}:{entry.lines[0] + 1}: {entry.place}: {entry.text}")
    print(f"{len(listed)} arguments say nothing", file=sys.stderr)
