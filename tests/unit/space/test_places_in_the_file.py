"""Errors that come from the analysis name the line of the building file that they are about."""

from __future__ import annotations

import re

import pytest
from building_examples import IRREGULAR, SMALL, building

from edesign.core.errors import CoreError
from edesign.errors import InputError
from edesign.space.elastic_design import elastic_design
from edesign.space.extract import frame_row
from edesign.space.file_places import keys_named, telling_member
from edesign.space.structure.geometry import space_frame


def reported(text: str) -> str:
    with pytest.raises(InputError) as error:
        elastic_design(building(text))
    return str(error.value)


def line_of(text: str, part: str) -> int:
    return text[: text.index(part)].count("\n") + 1


@pytest.mark.parametrize(
    ("supports", "key"),
    [
        ("{default: @{ux: free, uy: free}, B2: {ux: free, uy: free}}", "default"),
        ("{A1: {ux: free, uy: free}, all: @{ux: free, uy: free}}", "all"),  # the later entry counts
    ],
)
def test_a_mechanism_is_reported_at_the_support_that_lets_it_move(supports: str, key: str) -> None:
    text = SMALL.replace("columns: [", f"supports: {supports.replace('@', '')}\ncolumns: [", 1)
    place = f"5:{len('supports: ') + supports.index('@') + 1}"
    moves = "the building slides along x: the frame is a mechanism; it moves freely at A1"
    assert reported(text).startswith(f"building.yaml:{place}: supports.{key}: {moves}")


@pytest.mark.parametrize(
    ("name", "keys"),
    [
        ("member C_A2_2: its stiffness is not a finite number", ("columns", 1)),
        ("member C_B1_2: its stiffness is not a finite number", ("columns", 0)),
        ("case 3: the displacement at A2.2.ux is not a finite number", ("columns", 1)),
        ("moves freely at B2.1.uz", ("columns", 1)),
        ("moves freely at C3.0.rx", ("supports", "C-D")),
        ("moves freely at D1.0.rx", ("supports", "D1")),
        ("moves freely at A1.0.rx", ("supports", "default")),
        ("member BX_1_1_1 has the length 0", ("beams", 1)),
        ("member BY_A_2_1_2: its axial force is not a finite number", ("beams", 2)),
        ("member DY_A_2_3_r: A is nan", ("braces", 1)),
        ("the stiffness of the frame is not a finite number", ("supports",)),
    ],
)
def test_the_entry_of_what_the_core_names(name: str, keys: tuple[str | int, ...]) -> None:
    text = IRREGULAR.replace("at: [A, B2-D2], storeys: 1,", "at: [A, B2-D2],")
    assert keys_named(building(text), name) == keys


def test_what_is_not_finite_is_reported_with_its_member() -> None:
    file = building(SMALL)
    with pytest.raises(InputError, match=r"building.yaml:7:5: beams\[0\]: member BX_1_1_1: its axial force"):  # noqa: SIM117
        with telling_member(file):
            raise CoreError("ED_E_NOT_FINITE", "member BX_1_1_1: its axial force is not a finite number")
    with pytest.raises(CoreError, match="out of memory"), telling_member(file):
        raise CoreError("ED_E_MEMORY", "out of memory")


def test_modes_too_close_for_srss_are_reported_at_the_combination() -> None:
    text = SMALL.replace("  systems:", "  combination: srss\n  systems:")
    said = reported(text)
    assert said.startswith(f"building.yaml:{line_of(text, 'combination')}:16: design.combination: `srss` needs")


def test_a_missing_block_is_reported_with_a_line() -> None:
    assert reported(SMALL.partition("design:")[0]).startswith("building.yaml:1:1: design: this block is missing")


@pytest.mark.parametrize(("frame", "part", "said"), [("YD", "{uz: 400 MN/m", ".* D1 .*E-SPACE-04")])
def test_what_a_project_file_cannot_say_is_reported_with_its_entry(frame: str, part: str, said: str) -> None:
    file = building(IRREGULAR)
    with pytest.raises(InputError) as error:
        row = frame_row(file, space_frame(file), frame)
        row.check()
        [one.support(i) for one in row.frames for i in range(len(one.lines))]
    column = IRREGULAR.index(part) - IRREGULAR.rfind("\n", 0, IRREGULAR.index(part))
    place = f"{line_of(IRREGULAR, part)}:{column}"
    assert re.match(f"building.yaml:{place}: frame {frame}: {said}", str(error.value))
