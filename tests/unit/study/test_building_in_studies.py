"""Studies take a building where they took a plane frame: its model, and the root of its archive."""

from __future__ import annotations

import numpy as np
from building_examples import ANALYSED, building

from edesign.core import Analysis
from edesign.space.nonlinear.build import build_building
from edesign.study.analysis.structure import make_structure
from edesign.study.results.provenance import root_group


def test_the_model_is_that_of_the_building() -> None:
    whole = building(ANALYSED)
    structure = make_structure(whole)
    assert structure.frame.model.dimension == 3
    alone = Analysis(build_building(whole).model)
    assert np.array_equal(structure.analysis.modes(6).period, alone.modes(6).period)


def test_the_root_of_an_archive_names_the_building() -> None:
    whole = building(ANALYSED)
    root = root_group(whole, ["gravity"], {})
    assert root.attributes["building_file"] == "building.yaml"
    assert root.attributes["building_checksum"] == whole.checksum
    assert root.variables["building_text"].values == ANALYSED
    assert not [name for name in (*root.attributes, *root.variables) if name.startswith("project_")]
