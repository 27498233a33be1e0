"""`edesign translate`: files, refusals with their places, and that the texts in Python and Tcl say one thing."""

from __future__ import annotations

import ast
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from building_examples import DAMPED, SMALL, building

from edesign import load_project
from edesign.cli.main import main
from edesign.errors import InputError
from edesign.exchange.formats import find_format
from edesign.exchange.opensees.analyses import has_placed_dampers
from edesign.exchange.opensees.commands import Block, command, flat, heading, python_block, tcl_block
from edesign.exchange.opensees.fixed_ends import released_flexibility_loads, stiffness_factors
from edesign.exchange.opensees.integration import gauss_lobatto, piecewise_lobatto
from edesign.exchange.opensees.translate import opensees_script
from edesign.frame.loads import MemberLoads

CASES = Path(__file__).parents[2] / "cases"


def case(name: str) -> str:
    return str(CASES / name / "project.yaml")


def test_one_list_of_commands_in_both_languages() -> None:
    fibre = command("fiber", np.float64(0.1), 0.0, 2e-4, 1)
    block = Block("build", "A frame.", (heading("nodes"), command("section", "Fiber", 1, body=[fibre], comment="é")))
    assert python_block(block)[-3:] == [
        "    # nodes",
        '    ops.section("Fiber", 1)  # \\xe9',
        "    ops.fiber(0.1, 0.0, 0.0002, 1)",
    ]
    assert tcl_block(block)[-5:] == [
        "    # nodes",
        "    section Fiber 1 {  ;# /xe9",
        "        fiber 0.1 0.0 0.0002 1",
        "    }",
        "}",
    ]


def test_points_of_gauss_lobatto_in_parts() -> None:
    """Five points integrate polynomials of the seventh degree exactly, in each part."""
    places, weights = gauss_lobatto(5)
    np.testing.assert_allclose([weights @ places**n for n in range(8)], [1.0 / (n + 1) for n in range(8)], rtol=1e-14)
    parts, shares = (np.array(values) for values in piecewise_lobatto(5, (0.3, 0.4)))
    assert parts.size == 13 and np.all(np.diff(parts) > 0.0)
    kink = np.abs(parts - 0.3) ** 3
    np.testing.assert_allclose(shares @ kink, (0.3**4 + 0.7**4) / 4.0, rtol=1e-13)


def test_members_without_the_flexibility_of_their_hinges() -> None:
    """With no flexibility left out a member is a plain one; with equal ones K11 + K44 is that of one curvature."""
    assert stiffness_factors(3.0, 2.0, (0.0, 0.0)) == pytest.approx((4.0, 4.0, 2.0))
    without = 2.0 / (66.0 * 3.0)  # of n = 10
    K11, K33, K44 = stiffness_factors(3.0, 2.0, (without, without))
    assert K11 == pytest.approx(K33)
    assert 1.0 / (K11 - K44) == pytest.approx(0.5 - 1.0 / 66.0)  # ends that turn against each other
    ends = released_flexibility_loads(3.0, 2.0, (without, without), MemberLoads(-12.0))
    assert [force for force, _ in ends] == pytest.approx([0.0, 0.0], abs=1e-14)
    more = 12.0 * 2.0**2 / 12.0 * (1.0 / (1.0 - 2.0 / 66.0) - 1.0)
    assert [moment for _, moment in ends] == pytest.approx([-more, more])


@pytest.mark.parametrize(
    ("name", "place", "code"),
    [
        ("chevron_mgmm", ":20:7: dampers.laws.elastomer: V_1_1", "E-OPS-01"),
        ("brb_frame", ":22:7: dampers.laws.brb", "E-OPS-01"),
        ("devices_of_practice", ":25:92: dampers.devices[0].brace.play: V_1_1", "E-OPS-02"),
        ("deteriorating_hinges", ":27:5: panel_zones", "E-OPS-03"),
        ("buckling_braces", ":11:89: frame.braces[0].buckling", "E-OPS-03"),
        ("isolated_frame", ":33:5: dampers.isolation", "E-OPS-01"),
    ],
)
def test_what_opensees_lacks_is_refused_at_its_place(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], name: str, place: str, code: str
) -> None:
    model = tmp_path / "model.py"
    assert main(["translate", case(name), str(model)]) == 2
    reported = capsys.readouterr().err
    assert f"{name}/project.yaml{place}" in reported and f"[{code}]" in reported
    assert not list(tmp_path.iterdir())


def test_without_dampers(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    model = tmp_path / "model.tcl"
    assert main(["translate", case("chevron_mgmm"), str(model), "--without-dampers"]) == 0
    reported = capsys.readouterr().out
    assert "left out: dampers, isolators and tuned masses" in reported
    assert reported.count("left out:") == 2 and "left out: the dampers of the analys" in reported
    assert "- dampers, isolators and tuned masses" in model.read_text()


def test_laws_that_no_damper_has_are_not_left_out() -> None:
    """A project may keep the laws that its studies size dampers of."""
    assert not has_placed_dampers(load_project(CASES.parents[1] / "projects/office_6_storeys/frame.yaml"))
    assert has_placed_dampers(load_project(case("chevron_mgmm")))


def test_other_names_and_files_of_others(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    braced = case("braced_truss")
    assert main(["translate", braced, str(tmp_path / "model.inp")]) == 2
    assert "E-FILE-08" in capsys.readouterr().err
    assert main(["translate", braced, str(tmp_path / "my model.py")]) == 2
    assert "E-FILE-10" in capsys.readouterr().err
    record = tmp_path / "model_shake.txt"
    for other in (tmp_path / "model.py", record):
        other.write_text("mine\n")
        assert main(["translate", braced, str(tmp_path / "model.py")]) == 2
        assert "E-FILE-07" in capsys.readouterr().err
        assert other.read_text() == "mine\n"
        other.unlink()
    for name in ("model.py", "model.py", "model.tcl"):
        assert main(["translate", braced, str(tmp_path / name)]) == 0
    assert "Written by edesign" in (tmp_path / "model.tcl").read_text().splitlines()[0]
    ast.parse((tmp_path / "model.py").read_text())


def test_the_file_to_write_is_asked_for(capsys: pytest.CaptureFixture[str]) -> None:
    """Without it, and with the option that other programs have for it, by lines that can be copied."""
    for words in (["a b/frame.yaml"], ["a b/frame.yaml", "--to", "opensees"]):
        assert main(["translate", *words]) == 2
        said = capsys.readouterr().err
        assert "E-CLI-03" in said
        assert "  OpenSees:   edesign translate 'a b/frame.yaml' frame.tcl\n" in said
    assert main(["translate", "model.s2k"]) == 2
    assert "edesign translate model.s2k model.yaml [E-CLI-03]\n" in capsys.readouterr().err


def test_a_folder_is_made_or_named(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    braced, made = case("braced_truss"), tmp_path / "new" / "model.py"
    assert main(["translate", braced, str(made)]) == 0
    assert made.is_file()
    stages = [line for line in capsys.readouterr().err.splitlines() if line.endswith(" ...")]
    assert stages[1:] == ["building the frame ...", "reading 1 record ...", "translating the analyses ..."]
    assert main(["translate", braced, str(made / "model.py"), "--quiet"]) == 4
    assert capsys.readouterr().err == f"edesign: {made}: {made} is a file, and a folder is needed [E-FILE-06]\n"


def test_titles_cannot_leave_the_comment(tmp_path: Path) -> None:
    """Quotes, backslashes and line breaks of a title are text in both languages."""
    text = Path(case("braced_truss")).read_text(encoding="utf-8").replace("../records", str(CASES / "records"))
    title = next(line for line in text.splitlines() if line.startswith("title:"))
    file = tmp_path / "project.yaml"
    file.write_text(text.replace(title, r'title: "end \"\"\" \\ {} [exit] é \\"'), encoding="utf-8")
    for name in ("model.py", "model.tcl"):
        assert main(["translate", str(file), str(tmp_path / name)]) == 0
    ast.parse((tmp_path / "model.py").read_text())
    head = (tmp_path / "model.tcl").read_text().split("\nset HERE")[0]
    assert all(line.startswith("#") and not line.endswith("\\") for line in head.splitlines() if line)


def test_every_record_is_written_once(tmp_path: Path) -> None:
    project = load_project(case("vertical_motion"))
    script, beside = opensees_script(project, tmp_path / "model.py")
    texts = list(beside.files.values())
    assert len(set(texts)) == len(texts)
    assert {"ratio", "other"} <= set(script.analyses)


ANALYSES = """\
analyses:
  - {name: modes, kind: modal, modes: 3}
  - {name: push, kind: pushover, pattern: uniform, direction: x, roof_drift: 1 %, steps: 20}
"""
OF_BUILDING = {
    ".py": (
        'ops.model("basic", "-ndm", 3, "-ndf", 6)',
        'ops.geomTransf("PDelta", 1, 1.0, 0.0, 0.0)',
        'ops.element("forceBeamColumn", 1, 1, 10, 1, 1, "-iter", 50, 1e-10)',
        'ops.section("Aggregator", 4, 2, "P", 3, "My", 4, "Mz", 5, "T")',
        "ops.rigidDiaphragm(3, 28, 10, 11, 12, 13, 14, 15, 16, 17, 18)",
        "ops.fix(28, 0, 0, 1, 1, 1, 0)",
        'ops.constraints("Transformation")',
    ),
    ".tcl": (
        "model basic -ndm 3 -ndf 6",
        "geomTransf PDelta 1 1.0 0.0 0.0",
        "element forceBeamColumn 1 1 10 1 1 -iter 50 1e-10",
        "section Aggregator 4 2 P 3 My 4 Mz 5 T",
        "rigidDiaphragm 3 28 10 11 12 13 14 15 16 17 18",
        "fix 28 0 0 1 1 1 0",
        "constraints Transformation",
    ),
}


@pytest.mark.parametrize("suffix", OF_BUILDING)
def test_a_building_in_both_languages(tmp_path: Path, suffix: str) -> None:
    """Two storeys: webs of columns along x, hinged beams along y, rigid floors with their masses at the centres."""
    model = tmp_path / f"model{suffix}"
    found = find_format(model).translate(building(SMALL, ("hazard:", ANALYSES + "hazard:")), model)
    assert found.left_out == () and list(found.files) == [model]
    assert any("loads along 18 members stand at their ends" in text for text in found.differences)
    lines = [line.partition("#")[0].strip(" ;") for line in found.files[model].splitlines()]
    assert [line for line in OF_BUILDING[suffix] if line not in lines] == []
    assert not any("@" in line for line in lines)


def test_loads_of_a_building_are_whole(tmp_path: Path) -> None:
    """Forces upwards on nodes and members of the script are the weight of the gravity combination."""
    whole = building(SMALL)
    script, _ = opensees_script(whole, tmp_path / "model.py")
    commands: list[Any] = [command for block in script.blocks for command in flat(block.commands)]
    masses = sum(words[1] for name, *words in commands if name == "mass")
    places = {words[0]: np.array(words[1:]) for name, *words in commands if name == "node"}
    ends = {words[1]: words[2:4] for name, *words in commands if name == "element"}
    carried = 0.0
    for name, *words in commands:
        if name == "load":
            carried -= words[3]
        elif name == "eleLoad" and words[3] == "-beamUniform":
            start, end = (places[node] for node in ends[words[1]])
            carried -= words[5] * float(np.linalg.norm(end - start))
    assert masses > 1e5
    # half of the columns and braces of the first storey is no mass: it stands on the ground
    assert carried == pytest.approx(9.80665 * masses, rel=0.03) and carried > 9.80665 * masses


def test_parts_of_a_building_without_a_place_in_opensees(tmp_path: Path) -> None:
    """A tuned mass on a column line turns its floor; means of nodes need a rigid floor."""
    model, analysed = tmp_path / "model.py", DAMPED.replace("hazard:", ANALYSES + "hazard:")
    with pytest.raises(InputError, match=r"building.yaml:\d+:\d+: dampers.attachments: .*E-OPS-05"):
        find_format(model).translate(building(analysed), model)
    found = find_format(model).translate(building(analysed), model, without_dampers=True)
    assert found.left_out[0].startswith("dampers, isolators and tuned masses")
    loose = (
        analysed.partition("  attachments:")[0]
        .replace("chevron_braces", "chevron")
        .replace("columns:", "diaphragms: 1\ncolumns:")
    )
    with pytest.raises(InputError, match=r"building.yaml:\d+:\d+: dampers.laws.oil: VX_2_1_2: .*E-OPS-02"):
        find_format(model).translate(building(loose), model)
    found = find_format(model).translate(building(loose.replace("diaphragms: 1\n", "")), model)
    assert found.left_out == () and any("zeroLength" in sentence for sentence in found.differences)
    assert "dampers come with them" in find_format(model).translate(building(DAMPED), model).left_out[0]
