"""The viewer of the report in a browser: what it shows is what the archive holds."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest
from cases.test_report_page import browser
from driven_page import driven
from report_project import write_report_project

from edesign.archive.reader import open_archive
from edesign.project import load_project
from edesign.report.html.render import Cover, render
from edesign.report.motion.encoding import STEPS
from edesign.report.page.sections.motion import motion
from edesign.report.page.source import Source
from edesign.study.results.motion import FINENESS
from edesign.study.run.run import run_project

PICTURES = (*range(0, 160, 8), 10_000)  # the last is beyond the end
DRIVER = """<!DOCTYPE html><html><body><iframe src="page.html" style="width: {width}px; height: 900px; border: 0">
</iframe><script>onload = async () => {{
  const page = document.querySelector('iframe').contentWindow, all = (e, words) => [...e.querySelectorAll(words)];
  const viewers = () => all(page.document, '.viewer.on');
  for (let i = 0; i < 100 && viewers().length < all(page.document, '.viewer').length; i++)
    await new Promise(done => setTimeout(done, 20));
  const shown = e => all(e, 'circle[data-end]').filter(c => c.style.display !== 'none').map(c => c.dataset.end);
  const state = root => ({{ ...root.dataset, frames: all(root, '.moving').map(e => ({{ ...e.dataset, shown: shown(e),
    strokes: all(e, '[data-mass]').map(m => [m.dataset.mass, +m.dataset.stroke]),
    sheared: all(e, '[data-damper^=I_]').map(i => i.getAttribute('d').match(/-?[\\d.]+/g).map(Number)),
    forces: all(e, '[data-damper]').map(d => [d.dataset.damper, +d.dataset.force]) }})),
    loop: {{ ...(root.querySelector('circle[data-x]') || {{ dataset: {{}} }}).dataset }} }});
  const press = (root, key) => root.querySelector('.live input').dispatchEvent(
    new page.KeyboardEvent('keydown', {{ key, bubbles: true, cancelable: true }}));
  const found = viewers().map(root => {{
    const slider = root.querySelector('input'), button = root.querySelector('button'), seen = [state(root)];
    for (const k of {pictures}) {{
      slider.value = k;
      slider.dispatchEvent(new page.Event('input'));
      seen.push(state(root));
    }}
    const keys = [];
    for (const key of ['Home', 'ArrowRight', 'ArrowRight', 'ArrowLeft', 'End'])
      {{ press(root, key); keys.push(+root.dataset.picture); }}
    press(root, 'Home'); press(root, ' ');
    const playing = button.textContent;
    press(root, ' ');
    const switches = all(root, '.variants input'), switched = [];
    for (const i of switches.length ? [0, 1, 0] : [])
      {{ switches[i].click(); switched.push(all(root, '.moving').map(e => e.style.display !== 'none')); }}
    const wide = all(root, 'figure, svg, .controls').filter(e => e.getBoundingClientRect().right > page.innerWidth + 1);
    return {{ seen, keys, switched, playing, paused: button.textContent, wide: wide.length,
      still: root.querySelector('.picture .scroll').getBoundingClientRect().height }};
  }});
  document.documentElement.dataset.found = JSON.stringify({{ found, viewers: all(page.document, '.viewer').length,
    requests: page.performance.getEntriesByType('resource').length }});
}};</script></body></html>"""


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The archive of the small project with its motion, and beside it a page with this section alone."""
    folder = tmp_path_factory.mktemp("motion")
    path = write_report_project(folder)
    text = path.read_text(encoding="utf-8").replace("energy, dampers]", "energy, dampers, motion]")
    path.write_text(text, encoding="utf-8")
    archive = run_project(load_project(path), folder / "office.h5").archive
    with open_archive(archive) as opened:
        section = motion(Source(opened))
    Path(archive).with_suffix(".html").write_text(render(Cover("Motion", "", ""), [section]), encoding="utf-8")
    return Path(archive)


def _driven(page: Path, folder: Path, width: int) -> dict[str, Any]:
    """What a reader sees who moves the slider and presses keys."""
    return driven(browser(), page, folder, DRIVER.format(width=width, pictures=list(PICTURES)))


@pytest.mark.parametrize("width", [pytest.param(360, marks=pytest.mark.slow), 1280])
def test_viewer_shows_what_the_archive_holds(made: Path, tmp_path: Path, width: int) -> None:
    told = _driven(made.with_suffix(".html"), tmp_path, width)
    assert told["requests"] == 0 and told["viewers"] == len(told["found"]) == 2  # DBE and MCE
    dbe = told["found"][0]
    assert [frame["analysis"] for frame in dbe["seen"][0]["frames"]] == ["bare.DBE", "damped.DBE"]
    assert dbe["switched"] == [[False, True], [False, True], [True, True]]  # the last one stays
    with h5py.File(made) as archive:
        for viewer in told["found"]:
            for state in viewer["seen"]:
                _compare(state, archive)
    for viewer in told["found"]:
        last = int(viewer["seen"][-1]["picture"])
        assert [int(state["picture"]) for state in viewer["seen"][1:-1]] == list(PICTURES[:-1])
        assert viewer["keys"] == [0, 1, 2, 1, last] and (viewer["playing"], viewer["paused"]) == ("Pause", "Play")
        assert viewer["wide"] == 0 and viewer["still"] == 0  # the still is for paper, and without the program


def _compare(state: dict[str, Any], archive: h5py.File) -> None:
    """One picture against the samples of the archive, within the rounding of the viewer's numbers."""
    picture = int(state["picture"])
    for frame in state["frames"]:
        group = archive["analyses"][frame["analysis"]]
        time, pictures = group["time"][:], group["motion_time"][:]
        # steps have six decimals
        assert float(state["time"]) == pytest.approx(pictures[picture], abs=1e-6 * (picture + 1))
        k = int(np.argmin(np.abs(time - pictures[picture])))
        at_end = picture == len(pictures) - 1

        def near(found: object, values: np.ndarray, expected: float) -> None:
            # half a step, and the rounding of the step to six digits
            assert float(str(found)) == pytest.approx(expected, abs=float(np.abs(values).max()) * (0.5 / STEPS + 1e-6))

        near(frame["roof"], group["floor_displacement"][:], group["floor_displacement"][k, -1])
        drifts = group["storey_drift"][k]
        near(frame["drift"], group["storey_drift"][:], drifts[int(frame["storey"]) - 1])
        near(abs(float(frame["drift"])), group["storey_drift"][:], float(np.abs(drifts).max()))
        for name, force in frame["forces"]:
            i = [damper.decode() for damper in group["damper"][:]].index(name)
            near(force, group["damper_force"][:], group["damper_force"][k, i])
        yielded, unclear = set(), set()
        for kind in ("column", "beam"):
            rotation = np.maximum.accumulate(np.abs(group[f"{kind}_plastic_rotation"][: picture + 1]))[-1]
            if at_end:
                extremes = [np.abs(group[f"{kind}_plastic_rotation_{which}"][:]) for which in ("max", "min")]
                rotation = np.maximum(*extremes)
            for name, ends in zip(group[kind][:], rotation, strict=True):
                for end, value in zip(("start", "end"), ends, strict=True):
                    label = f"{name.decode()} {end}"
                    if abs(value - 1e-3) < 2e-5:  # so near the limit, 1 mrad, rounding decides
                        unclear.add(label)
                    elif value > 1e-3:
                        yielded.add(label)
        assert set(frame["shown"]) - unclear == yielded
        assert int(frame["hinges"]) == len(frame["shown"])


def test_isolators_shear_and_tuned_masses_swing(tmp_path: Path) -> None:
    """Corners of an isolator: two stay on the ground, two go with the base; a mass moves against its floor."""
    path = tmp_path / "isolated.yaml"
    path.write_text(ISOLATED, encoding="utf-8")
    (tmp_path / "pulse.csv").write_text(
        "".join(f"{0.02 * i},{2.0 * np.sin(6.0 * 0.02 * i)}\n" for i in range(120)), encoding="utf-8"
    )
    archive = Path(run_project(load_project(path), tmp_path / "isolated.h5").archive)
    with open_archive(archive) as opened:
        page = render(Cover("Motion", "", ""), [motion(Source(opened))])
    archive.with_suffix(".html").write_text(page, encoding="utf-8")
    data = json.loads(re.findall(r'<script type="application/json">(.*?)</script>', page, re.DOTALL)[0])
    told = _driven(archive.with_suffix(".html"), tmp_path, 1280)
    with h5py.File(archive) as file:
        group = file["analyses/shake"]
        base, stroke = (group[f"{name}_displacement"][:].astype(float).ravel() for name in ("base", "tuned_mass"))
        time, pictures = group["time"][:], group["motion_time"][:]
    assert np.abs(base).max() > 0.01 and np.abs(stroke).max() > 0.005
    for state in told["found"][0]["seen"]:
        k = int(np.argmin(np.abs(time - pictures[int(state["picture"])])))
        frame = state["frames"][0]
        ((name, found),) = frame["strokes"]
        assert name == "T_1_1" and found == pytest.approx(stroke[k], abs=np.abs(stroke).max() * (0.5 / STEPS + 1e-6))
        for x, corners in zip((0.0, 6.0), frame["sheared"], strict=True):
            bottom, top = corners[0:4:2], corners[4:8:2]
            assert sum(bottom) / 2 == pytest.approx(x, abs=1e-3)  # m on the drawing, which has three decimals
            # the nodes are kept with 2000 steps, drawn so many times larger
            rounding = data["scale"] * np.abs(base).max() * (0.5 / FINENESS + 0.5 / STEPS) + 2e-3
            assert sum(top) / 2 == pytest.approx(x + data["scale"] * base[k], abs=rounding)


ISOLATED = """\
edesign: 1
title: Storey on isolators with a tuned mass
frame:
  bays: [6 m]
  storeys: [4 m]
  diaphragms: all
  columns: [{storeys: all, section: HEB260, material: S275}]
  beams: [{floors: all, section: IPE360, material: S275}]
materials:
  S275: {law: elastic, E: 210 GPa}
masses: {given: [{lines: all, floors: all, mass: 20 t}]}
dampers:
  laws: {rubber: {type: kelvin_voigt, parameters: {k: 0.4 kN/mm, c: 0.02 kN*s/mm}}}
  isolation:
    isolators: [{law: rubber}]
    base: {mass: 20 t, rotation: fixed}
    design_displacement: 50 mm
  attachments: [{kind: tuned_mass, floor: 1, mass: 2 t, frequency: 1 Hz, damping: 5 %}]
damping: {kind: none}
integration: {method: newmark, time_step: 0.02 s}
records: {pulse: {file: pulse.csv, acceleration_unit: m/s^2}}
analyses: [{name: shake, kind: history, record: pulse, free_vibration: 1 s}]
outputs: {histories: [floors, storeys, dampers, motion]}
"""


def test_some_ends_yield_in_time(made: Path) -> None:
    """Else the comparison of hinges would be one of nothing with nothing."""
    with h5py.File(made) as archive:
        rotation = np.abs(archive["analyses/bare.MCE/beam_plastic_rotation"][:]).max(axis=(1, 2))
    assert rotation[0] < 1e-3 < rotation[-1]


def test_page_without_the_program_has_the_stills(made: Path) -> None:
    text = made.with_suffix(".html").read_text(encoding="utf-8")
    assert text.count('<div class="still">') == text.count('<script type="application/json">') == 2
    for data in re.findall(r'<script type="application/json">(.*?)</script>', text, re.DOTALL):
        assert len(data) <= 400_000 and json.loads(data)["n"] > 50
