"""Names of lines, nodes and members of a frame."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import Literal

LINE = r"[A-Z][A-Za-z0-9']{0,7}"
"""Expression of the name of a column line: letters, or what plans call it, such as `A1` or `B'`."""


def line_name(index: int) -> str:
    """Return the name of a column line: 0 -> A, 25 -> Z, 26 -> AA, 27 -> AB.

    Raises:
        ValueError: the index is negative.
    """
    if index < 0:
        raise ValueError(f"line index {index} is negative")
    name = ""
    index += 1
    while index > 0:
        index, letter = divmod(index - 1, 26)
        name = chr(ord("A") + letter) + name
    return name


def line_index(name: str) -> int:
    """Return the position of a column line from the left: A -> 0, AA -> 26; the inverse of `line_name`.

    Raises:
        ValueError: `name` is not made of the letters A to Z.
    """
    if not name or not all("A" <= letter <= "Z" for letter in name):
        raise ValueError(f"`{name}` is no line name: lines are A, B, ... Z, AA, AB, ...")
    index = 0
    for letter in name:
        index = 26 * index + ord(letter) - ord("A") + 1
    return index - 1


def plain_line(name: str) -> bool:
    """Return whether the name of a column line is made of capital letters alone, as those without own names are."""
    return name.isalpha() and name.isupper()


def node_name(line: str, floor: int) -> str:
    """Return the name of the node on a line at a floor: A3; `A1.3` where the name of the line ends in no letter.

    Args:
        line: name of the column line.
        floor: number of the floor; 0 is the base.
    """
    return f"{line}{floor}" if line.isalpha() else f"{line}.{floor}"


def column_name(line: str, storey: int) -> str:
    """Return the name of the column on a line in a storey: C_A_3.

    Args:
        storey: number of the storey, from 1.
    """
    return f"C_{line}_{storey}"


def _in_bay(kind: str, bay: int, level: int, frame: str) -> str:
    """What stands in a bay at a floor or in a storey: B_2_5, or BX_1_2_5 in frame X1 of a building."""
    return f"{kind}{frame[:1]}_{frame[1:]}_{bay}_{level}" if frame else f"{kind}_{bay}_{level}"


def beam_name(bay: int, floor: int, frame: str = "") -> str:
    """Return the name of the beam in a bay at a floor: B_2_5, of a building BX_1_2_5.

    Args:
        bay: number of the bay, from 1.
        floor: number of the floor; 0 is the base.
        frame: name of the plane frame of a building, such as X1; "" of none.
    """
    return _in_bay("B", bay, floor, frame)


def beam_half_names(bay: int, floor: int, frame: str = "") -> tuple[str, str]:
    """Return the names of the halves of a beam that braces meet in the middle: B_2_5_1, B_2_5_2.

    The node between them is named B_2_5.

    Args:
        bay: number of the bay, from 1.
        floor: number of the floor; 0 is the base.
        frame: name of the plane frame of a building, such as X1; "" of none.
    """
    name = beam_name(bay, floor, frame)
    return f"{name}_1", f"{name}_2"


def damper_names(kind: str, bay: int, storey: int, frame: str = "") -> tuple[str, ...]:
    """Return the names of the dampers of a kind in a bay and storey, such as V_2_5, of a building VX_1_2_5.

    In place of the braces of a chevron are two: V_2_5_r, which rises from left to right, and V_2_5_f.

    The letters are V for chevron, R for rising, F for falling, S for storey.

    Args:
        kind: chevron, chevron_braces, rising, falling or storey.
        bay: number of the bay, from 1.
        storey: number of the storey, from 1.
        frame: name of the plane frame of a building, such as X1; "" of a project.
    """
    letter = {"chevron": "V", "chevron_braces": "V", "rising": "R", "falling": "F", "storey": "S"}[kind]
    name = _in_bay(letter, bay, storey, frame)
    return (f"{name}_r", f"{name}_f") if kind == "chevron_braces" else (name,)


MemberKind = Literal["column", "beam", "brace"]
_KINDS: Mapping[str, MemberKind] = {"C": "column", "B": "beam", "D": "brace"}


def member_kind(name: str) -> MemberKind:
    """Return what a member of a frame or building is, by its name."""
    return _KINDS[name[0]]


def storey_of(label: str) -> int:
    """Return the storey in the label of a storey, or the name of a column, beam, half of a beam, or brace.

    They are 3, C_A_3, B_1_3, B_1_3_2, D_1_3_r, and of buildings C_A2_3, BX_2_1_3, BX_2_1_3_2, DX_2_1_3_r; a beam counts
    with the storey below its floor.

    Args:
        label: of a storey, or the name of a member.
    """
    parts = label.split("_")
    if len(parts) == 1:
        return int(label)
    return int(parts[1 + len(parts[0])])  # beams and braces of a building have the label of their frame before the bay


_STANDING = {"V": "chevron", "R": "rising diagonal", "F": "falling diagonal", "S": "between floors"}


def damper_place(name: str) -> tuple[str, str]:
    """Return how a damper stands and where, in words, by its name: `V_2_5` is a chevron in bay 2, `VX_1_2_5` of X1."""
    letter, _, rest = name.partition("_")
    parts = rest.split("_")
    if letter[0] in _STANDING and len(parts) > 1:
        frame = f"{letter[1]}{parts.pop(0)} " if len(letter) > 1 else ""
        in_place = parts[2:3] in (["r"], ["f"])
        return "in place of chevron braces" if in_place else _STANDING[letter[0]], f"{frame}bay {parts[0]}"
    if letter == "N":
        return "between nodes", " to ".join(parts[:2])
    if letter == "I":
        return "isolator", f"line {parts[0]}"
    return "beside the isolated base", f"line {parts[0]}"


def isolator_name(line: str) -> str:
    """Return the name of the isolator under a line: I_A."""
    return f"I_{line}"


def base_device_name(line: str) -> str:
    """Return the name of a damper or stop between the ground and an isolated base at a line: G_A."""
    return f"G_{line}"


def of_axis(name: str, axis: str) -> str:
    """Return the name of what acts at the base of a building along an axis: I_A1_x; without an axis the name."""
    return f"{name}_{axis}" if axis else name


def tuned_mass_name(floor: int, number: int) -> str:
    """Tuned mass or tanks on a floor, with its number in the project: T_10_1."""
    return f"T_{floor}_{number}"


def tuned_mass_floor(name: str) -> int:
    """The floor that a tuned mass stands on, by its name."""
    return int(name.split("_")[1])


def damper_between_name(start: str, end: str) -> str:
    """Return the name of a damper between two nodes: N_A0_B1.

    Args:
        start: name of the first node.
        end: name of the second node.
    """
    return f"N_{start}_{end}"


def free_name(name: str, taken: Collection[str]) -> str:
    """Return a name, or with the next number where several dampers stand at one place: V_1_3, V_1_3_2.

    Args:
        taken: names that are used.
    """
    number = 2
    chosen = name
    while chosen in taken:
        chosen = f"{name}_{number}"
        number += 1
    return chosen


def brace_name(bay: int, storey: int, direction: str, frame: str = "") -> str:
    """Return the name of the brace in a bay and storey, rising (r) or falling (f) from left to right: D_2_5_r.

    Args:
        bay: number of the bay, from 1.
        storey: number of the storey, from 1.
        frame: name of the plane frame of a building, such as X1; "" of none.
    """
    return f"{_in_bay('D', bay, storey, frame)}_{direction}"


def bay_of(name: str) -> tuple[str, int, int, str] | None:
    """Return the frame, bay, storey or floor, and way of what stands in a bay, by its name; None of other names.

    They are ("", 2, 5, "") of B_2_5, and ("X1", 2, 5, "r") of DX_1_2_5_r or VX_1_2_5_r.

    Args:
        name: of a beam, brace or damper.
    """
    kind, *parts = name.split("_")
    frame = f"{kind[1:]}{parts.pop(0)}" if len(kind) == 2 and len(parts) > 2 else ""
    if len(parts) < 2 or kind[0] not in "BDVRFS" or not (parts[0].isdigit() and parts[1].isdigit()):
        return None
    return frame, int(parts[0]), int(parts[1]), parts[2] if parts[2:3] in (["r"], ["f"]) else ""
