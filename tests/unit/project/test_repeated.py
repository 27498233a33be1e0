"""Lists in which equal values in a row stand together."""

from __future__ import annotations

import re

import pytest
from shear_frames import shear_frame_text

from edesign.errors import InputError
from edesign.frame.sections.profiles import profile_names
from edesign.project.loader import parse_project
from edesign.project.project import Project

DAMPERS = """
dampers:
  laws: {oil: {type: viscous, parameters: {c: 500 kN*s/m}}}
  devices: [{kind: storey, bays: 1, storeys: all, law: oil, scale: [2, {count: 2, value: 1.5}]}]
"""


def read(storeys: str, dampers: str = "") -> Project:
    text = shear_frame_text(3).replace("{count: 3, height: 4 m}", storeys) + "analyses: [{name: g, kind: gravity}]\n"
    return parse_project(text + dampers, "project.yaml", profile_names())


def test_equal_values_stand_for_all_of_them() -> None:
    found = read("[4 m, {count: 2, height: 3.5 m}]", DAMPERS)
    assert found.frame.storey_heights == (4.0, 3.5, 3.5)
    assert found.dampers is not None and found.dampers.devices[0].scale == (2.0, 1.5, 1.5)


@pytest.mark.parametrize(
    ("storeys", "message"),
    [
        ("[4 m, {count: 2, height: 3.5}, 4 m]", r"frame.storeys\[1\].height: .*`3.5` needs a unit"),
        ("[4 m, {count: 2, heigt: 3.5 m}]", r"frame.storeys\[1\].heigt: .*did you mean `height`"),
        ("[{count: 2, height: 4 m}, x]", r"frame.storeys\[1\]: `x` is no length"),
        ("[{count: 0, height: 4 m}]", r"frame.storeys\[0\].count: .*at least 1"),
        ("[]", "frame.storeys: the list is empty"),
    ],
)
def test_problems_are_told_where_they_stand(storeys: str, message: str) -> None:
    with pytest.raises(InputError, match=message):
        read(storeys)


def test_values_are_counted_with_all_equal_ones() -> None:
    text = DAMPERS.replace("count: 2", "count: 3")
    with pytest.raises(InputError, match=re.escape("4 values for 3 storeys")):
        read("{count: 3, height: 4 m}", text)
