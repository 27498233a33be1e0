"""Input files with one to three mistakes as people and editors make them, drawn by seed."""

from __future__ import annotations

import random
import re
from collections.abc import Callable, Iterator
from typing import NamedTuple

from edesign.project.reading.yaml_nodes import Node, parse

Random = random.Random
Mutation = Callable[[str, Random], str]

JUNK = (
    *("", "~", "NaN", ".nan", ".inf", "-.inf", "nan m", "inf kN", "1e400 m", "1e308 kN/m^2", "0", "-1", "-0", "1", "7"),
    *("1e308", "1e-308", "99999999999999999999", "0x1F", "1_000", "true", "false", "no", "[]", "{}", "[[]]", "[1, 2]"),
    *("{a: 1}", "'text'", "all", "none", "auto", "fixed", "x", "z", "3,5 m", "5 feet", "5 m m", "1/0", "1/250", "50 %"),
    *("200 %", "-5 %", "7850 g/m^3", "210 MPa", "275 Pa", "4 mm", "4.5 N/m^2", "4.5 MN/m^2", "7200 m", "1e9 t", "é"),
)
PLACES = (
    *(
        "Z9",
        "A0",
        "0",
        "A1-",
        "-1",
        "C1-A2",
        "3-1",
        "1-0",
        "1-99",
        "99",
        "X1",
        "YA",
        "X99",
        "A-2",
        "a1",
        "A1.2",
        "AAA1",
    ),
    *("[]", "[A1, A1]", "[1, [2]]", "1.5", "1--2", "all-2", "[all, 1]", "{x: 9}", "{x: 1-2, y: 0}", "{z: 1}", "٣"),
)
UNITS = (
    "",
    "m",
    "mm",
    "km",
    "kN",
    "N",
    "MPa",
    "Pa",
    "GPa",
    "kN/m",
    "kN/m^2",
    "N/m^2",
    "MN/m^2",
    "t",
    "g",
    "kg/m^3",
    "%",
    "s",
)
SIGNS = (
    ":",
    ": ",
    "{",
    "}",
    "[",
    "]",
    ",",
    "\t",
    " #",
    "'",
    '"',
    "\x00",
    "\x85",
    "é",
    "&a ",
    "*a",
    "!!int ",
    "- ",
    "\n",
    "|",
)


class Entry(NamedTuple):
    """A key of a mapping: where it begins in the text, and its value."""

    start: int
    key: str
    value: Node
    flow: bool


# ---- keys ----


def dropped_key(text: str, rnd: Random) -> str:
    entry = rnd.choice(entries(text))
    rest = text[entry.value.span[1] :]
    return text[: entry.start] + (re.sub(r"^\s*,\s*", "", rest) if entry.flow else rest)


def doubled_key(text: str, rnd: Random) -> str:
    entry = rnd.choice(entries(text))
    whole = text[entry.start : entry.value.span[1]]
    between = ", " if entry.flow else "\n" + " " * (entry.start - text.rfind("\n", 0, entry.start) - 1)
    return text[: entry.start] + whole + between + text[entry.start :]


def misspelt_key(text: str, rnd: Random) -> str:
    entry = rnd.choice(entries(text))
    return text[: entry.start] + misspelt(entry.key, rnd) + text[entry.start + len(entry.key) :]


def other_key(text: str, rnd: Random) -> str:
    entry, other = rnd.choice(entries(text)), rnd.choice(entries(text))
    return text[: entry.start] + other.key + text[entry.start + len(entry.key) :]


# ---- values ----


def junk_value(text: str, rnd: Random) -> str:
    return replaced(text, rnd.choice(scalars(text)), rnd.choice(JUNK))


def junk_part(text: str, rnd: Random) -> str:
    return replaced(text, rnd.choice(entries(text)).value, rnd.choice(JUNK))


def wrong_place(text: str, rnd: Random) -> str:
    selections = ("at", "floors", "storeys", "frames", "bays", "x", "y", "diaphragms", "columns", "group", "level")
    found = [e.value for e in entries(text) if e.key in selections] or scalars(text)
    return replaced(text, rnd.choice(found), rnd.choice(PLACES))


def other_unit(text: str, rnd: Random) -> str:
    found = [node for node in scalars(text) if " " in node.text and node.text[:1].isdigit()]
    node = rnd.choice(found or scalars(text))
    return replaced(text, node, f"{node.text.split()[0]} {rnd.choice(UNITS)}")


def scaled_value(text: str, rnd: Random) -> str:
    node = rnd.choice([node for node in scalars(text) if re.match(r"[0-9]", node.text)])
    number = re.match(r"[0-9.]+", node.text)
    assert number
    factor = rnd.choice([0.0, -1.0, 1e-9, 1e-3, 0.1, 10.0, 1e3, 1e6, 1e12, 1e200])
    try:
        value = float(number[0]) * factor
    except ValueError:  # a name such as 1.2.3
        return text
    return replaced(text, node, f"{value:g}{node.text[number.end() :]}")


def swapped_values(text: str, rnd: Random) -> str:
    one, two = sorted(rnd.sample(scalars(text), 2), key=lambda node: node.span)
    first, second = (text[slice(*node.span)] for node in (one, two))
    return text[: one.span[0]] + second + text[one.span[1] : two.span[0]] + first + text[two.span[1] :]


def misspelt_value(text: str, rnd: Random) -> str:
    node = rnd.choice([node for node in scalars(text) if len(node.text) > 1])
    return replaced(text, node, misspelt(node.text, rnd))


def listed_value(text: str, rnd: Random) -> str:
    node = rnd.choice([entry.value for entry in entries(text)])
    said = text[slice(*node.span)]
    return replaced(text, node, said.strip("[]") if said.startswith("[") else f"[{said}]")


# ---- text ----


def truncated(text: str, rnd: Random) -> str:
    return text[: rnd.randrange(len(text))]


def indented(text: str, rnd: Random) -> str:
    lines = text.split("\n")
    k = rnd.randrange(len(lines))
    lines[k] = rnd.choice([" " + lines[k], "\t" + lines[k], lines[k].removeprefix(" "), lines[k].lstrip()])
    return "\n".join(lines)


def moved_line(text: str, rnd: Random) -> str:
    lines = text.split("\n")
    line = lines.pop(rnd.randrange(len(lines)))
    for _ in range(rnd.choice([0, 1, 2])):  # deleted, moved or doubled
        lines.insert(rnd.randrange(len(lines)), line)
    return "\n".join(lines)


def stray_sign(text: str, rnd: Random) -> str:
    k = rnd.randrange(len(text))
    return text[:k] + rnd.choice(SIGNS) + text[k + rnd.choice([0, 1]) :]


MUTATIONS: tuple[Mutation, ...] = (
    *(dropped_key, doubled_key, misspelt_key, other_key),
    *(junk_value, junk_value, junk_part, wrong_place, wrong_place, other_unit, scaled_value, scaled_value),
    *(swapped_values, misspelt_value, listed_value),
    *(truncated, indented, moved_line, stray_sign),
)


def mutants(texts: dict[str, str], count: int, seed: int) -> Iterator[tuple[str, str]]:
    """Yield names of mutants, with what was done, and their texts; every third one has up to two mistakes more."""
    rnd = Random(seed)
    names = sorted(texts)
    for number in range(count):
        name = names[number % len(names)]
        text, done = texts[name], []
        for _ in range(rnd.choice([1, 1, 1, 1, 2, 3])):
            mutation = rnd.choice(MUTATIONS)
            if entries(text) and len(scalars(text)) > 10:
                text, done = mutation(text, rnd), [*done, mutation.__name__]
        yield f"{number:03d} {name} {'+'.join(done)}", text


# ---- parts of a text ----


def entries(text: str) -> list[Entry]:
    starts = [0, *(match.end() for match in re.finditer("\n", text))]

    def below(node: Node) -> Iterator[Entry]:
        for key, value in (node.entries or {}).items():
            mark = node.key_marks[key]
            yield Entry(starts[mark.line - 1] + mark.column - 1, key, value, node.flow)
            yield from below(value)
        for item in node.items or ():
            yield from below(item)

    return list(below(parse(text)[0]))


def scalars(text: str) -> list[Node]:
    def below(node: Node) -> Iterator[Node]:
        parts = [*(node.entries or {}).values(), *(node.items or ())]
        if node.entries is None and node.items is None and node.span[1] > node.span[0]:
            yield node
        for part in parts:
            yield from below(part)

    return list(below(parse(text)[0]))


def replaced(text: str, node: Node, value: str) -> str:
    return text[: node.span[0]] + value + text[node.span[1] :]


def misspelt(word: str, rnd: Random) -> str:
    k = rnd.randrange(len(word))
    return rnd.choice(
        [word[:k] + word[k + 1 :], word[:k] + word[k] + word[k:], word[:k] + rnd.choice("xq9-_ ") + word[k + 1 :]]
    )
