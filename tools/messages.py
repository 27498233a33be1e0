"""List the messages of errors with their codes, from the source.

Every sentence that refuses an input or explains a failure ends with a code in brackets, such as `[E-TABLE-07]`. A code
names a mistake and its remedy, both listed in docs/reference/messages; sentences with one remedy share a code.

    python tools/messages.py                 the sentences by code, as in tests/unit/messages/sentences.txt
    python tools/messages.py --write         write that file anew
    python tools/messages.py --uncoded PATH  sentences below a path that have no code yet
"""

from __future__ import annotations

import argparse
import ast
import re
import sys
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SENTENCES = ROOT / "tests" / "unit" / "messages" / "sentences.txt"
CODE = re.compile(r"\[(E-[A-Z0-9]+-\d\d)\]")
CODED_TEXT = re.compile(rf"{CODE.pattern}|\{{code\}}$")  # also with the code of another message, put at the end

ERRORS = {
    *("InputError", "AnalysisError", "ArchiveError", "CampaignError", "SuiteError", "NoSuchMaterial", "NotTranslated"),
    *("NotTheProtocol", "DamagedArchive", "RefusedClient", "RefusedMotion", "SessionError", "RtsFileError", "NotFound"),
    "PackageNotInstalled",
}
"""Errors whose text a user reads; their subclasses that only pass a text on need not be here."""
CODED = {*ERRORS, "CoreError", "EdesignError", "ProjectError", "StudyError", "FileProblems", "PydanticCustomError"}
"""Errors whose text has a code already: a sentence that passes it on needs none."""
METHODS = {"Fault", "refuse", "_refuse", "at_value", "at_item", "at_key", "under", "error", "_failure", "_damaged"}
"""Functions that take the sentence of a problem."""
WORDS = re.compile(r"[A-Za-z]{2,}[^A-Za-z{}]+[A-Za-z]{2,}")
KEYS = re.compile(r"[A-Za-z]+(?:[._][A-Za-z]+)+")


def text_of(node: ast.expr, with_values: bool = True) -> str:
    """Return a string expression as a template: its literal parts, and `{...}` or `{}` for its values."""
    if isinstance(node, ast.Constant):
        return node.value if isinstance(node.value, str) else ""
    if isinstance(node, ast.JoinedStr):
        return "".join(text_of(part, with_values) for part in node.values)
    if isinstance(node, ast.FormattedValue):
        return _value(node.value, with_values)
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add):
        return text_of(node.left, with_values) + text_of(node.right, with_values)
    return _value(node, with_values)


def _value(node: ast.expr, with_values: bool) -> str:
    return f"{{{ast.unparse(node)}}}" if with_values else "{}"


def is_text(node: ast.AST) -> bool:
    """Return whether an expression is a string that is written here, at least in part."""
    if isinstance(node, ast.Constant):
        return isinstance(node.value, str)
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add):
        return is_text(node.left) or is_text(node.right)
    return isinstance(node, ast.JoinedStr)


def sentences(package: Path) -> list[tuple[str, str]]:
    """Return code and template of each sentence below a folder, sorted, each once."""
    found: set[tuple[str, str]] = set()
    for path in package.rglob("*.py"):
        tree = ast.parse(path.read_text(encoding="utf-8"))
        for node, function in _outermost(tree, tree):
            text = _with_beginning(text_of(node), node, function)
            found |= {(code, text.replace("\n", "\\n")) for code in CODE.findall(text)}
    return sorted(found)


def _outermost(node: ast.AST, function: ast.AST) -> Iterator[tuple[ast.expr, ast.AST]]:
    """The string expressions below a node with their function, not the parts of them; docstrings are not among them."""
    for child in ast.iter_child_nodes(node):
        if isinstance(child, ast.Expr) and isinstance(child.value, ast.Constant):
            continue
        if isinstance(child, ast.expr) and is_text(child):
            yield child, function
        else:
            yield from _outermost(child, child if isinstance(child, ast.FunctionDef) else function)


def _with_beginning(text: str, node: ast.expr, function: ast.AST) -> str:
    """A sentence whose first words stand in a variable above it, with these words."""
    name = re.match(r"\{(\w+)\}", text)
    if name is None:
        return text
    above = [
        one
        for one in ast.walk(function)
        if isinstance(one, ast.Assign) and one.lineno < node.lineno and is_text(one.value)
        if any(getattr(target, "id", "") == name[1] for target in one.targets)
    ]
    if not above:
        return text
    return text_of(max(above, key=lambda one: one.lineno).value) + text[name.end() :]


def uncoded(path: Path) -> list[ast.expr]:
    """Return the string expressions of a file that a user reads as a message, and that have no code.

    A sentence may be given to an error or to a collector of problems, or stand in a variable, a constant or the return
    of a function of the file that is given to one, alone or behind its place. A text without two words, such as a
    place before the message of another error, needs no code.
    """
    tree = ast.parse(path.read_text(encoding="utf-8"))
    functions = {node.name: node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef)}
    passed_on = {id(node) for node in _passed_on(tree)}
    found: dict[int, ast.expr] = {}
    for scope in ast.walk(tree):
        if isinstance(scope, (ast.FunctionDef, ast.Module)):
            for call in _calls(scope):
                for argument in [*call.args, *(keyword.value for keyword in call.keywords)]:
                    found |= {id(one): one for one in _sources(argument, scope, tree, functions)}
    left = (node for key, node in found.items() if key not in passed_on)
    return sorted(left, key=lambda node: (node.lineno, node.col_offset))


def _passed_on(tree: ast.Module) -> Iterator[ast.AST]:
    """Strings that hold the text of an error of edesign."""
    for handler in ast.walk(tree):
        if isinstance(handler, ast.ExceptHandler) and handler.name and handler.type is not None:
            kinds = handler.type.elts if isinstance(handler.type, ast.Tuple) else [handler.type]
            names = {kind.id for kind in kinds if isinstance(kind, ast.Name)}
            for node in ast.walk(handler):
                text = text_of(node) if isinstance(node, ast.expr) and is_text(node) else ""
                if names <= CODED and f"{{{handler.name}}}" in text or text.startswith(f"{{{handler.name}}}"):
                    yield node


def _calls(scope: ast.AST) -> Iterator[ast.Call]:
    for node in ast.walk(scope):
        if isinstance(node, ast.Call):
            name = node.func.id if isinstance(node.func, ast.Name) else getattr(node.func, "attr", "")
            if name in ERRORS or name in METHODS:
                yield node


def _sources(
    node: ast.expr, scope: ast.AST, tree: ast.Module, functions: dict[str, ast.FunctionDef], deep: bool = True
) -> Iterator[ast.expr]:
    """The strings without a code that an argument may be."""
    if is_text(node):
        if WORDS.search(KEYS.sub("{}", text_of(node, with_values=False))) and not CODED_TEXT.search(text_of(node)):
            yield node
        elif not CODED_TEXT.search(text_of(node)) and isinstance(node, ast.JoinedStr):
            for part in node.values:
                if isinstance(part, ast.FormattedValue):
                    yield from _sources(part.value, scope, tree, functions, deep)
    elif isinstance(node, ast.IfExp):
        yield from _sources(node.body, scope, tree, functions, deep)
        yield from _sources(node.orelse, scope, tree, functions, deep)
    elif isinstance(node, ast.Name) and deep:
        for place in (scope, tree):
            for one in tree.body if place is tree else ast.walk(place):
                named = isinstance(one, ast.Assign) and any(
                    getattr(target, "id", "") == node.id for target in one.targets
                )
                if isinstance(one, ast.Assign) and named and not _goes_on(one, node.id, place):
                    yield from _sources(one.value, scope, tree, functions, False)
    elif isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id in functions and deep:
        for one in ast.walk(functions[node.func.id]):
            if isinstance(one, ast.Return) and one.value is not None:
                yield from _sources(one.value, functions[node.func.id], tree, functions, False)


def _goes_on(assignment: ast.Assign, name: str, scope: ast.AST) -> bool:
    """Return whether a variable is the first part of a longer sentence, which has the code at its end."""
    uses = [node for node in ast.walk(scope) if isinstance(node, ast.Name) and node.id == name]
    after = [node for node in uses if node.lineno > assignment.lineno]
    if not after:
        return False
    first = min(after, key=lambda node: (node.lineno, node.col_offset))
    longer = (node for node in ast.walk(scope) if isinstance(node, ast.JoinedStr) and CODE.search(text_of(node)))
    return any(first is part for node in longer for part in ast.walk(node))


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--write", action="store_true")
    parser.add_argument("--uncoded", type=Path, metavar="PATH")
    given = parser.parse_args()
    if given.uncoded:
        for path in sorted(given.uncoded.rglob("*.py")) if given.uncoded.is_dir() else [given.uncoded]:
            for node in uncoded(path):
                print(f"{path}:{node.lineno}:{node.col_offset}\t{text_of(node)!r}")
        return 0
    text = "".join(f"{code}  {sentence}\n" for code, sentence in sentences(ROOT / "edesign"))
    if given.write:
        SENTENCES.write_text(text, encoding="utf-8")
    else:
        sys.stdout.write(text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
