"""The viewer of a building in a browser: what it draws is the motion of the archive, seen as an eye would see it."""

from __future__ import annotations

import base64
import hashlib
import json
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from cases.test_report_page import browser
from driven_page import driven
from moving_building import DAMPERS, PICTURES, STEP, formula, moving_archive, small_building

from edesign.archive.reader import open_archive
from edesign.report.html.render import Cover, render
from edesign.report.motion.building_geometry import moving_building
from edesign.report.motion.encoding import STEPS
from edesign.report.motion.geometry import Geometry
from edesign.report.motion.still import member_curve
from edesign.report.page.sections.motion import motion
from edesign.report.page.source import Source

DRIVER = """<!DOCTYPE html><html><body><iframe src="page.html" style="width: {width}px; height: 900px; border: 0">
</iframe><script>onload = async () => {{
  const page = document.querySelector('iframe').contentWindow;
  for (let i = 0; i < 100 && !page.document.querySelector('.viewer.on'); i++)
    await new Promise(done => setTimeout(done, 20));
  const root = page.document.querySelector('.viewer'), canvas = root.querySelector('canvas');
  const slider = root.querySelector('input'), figure = root.querySelector('.moving');
  const go = k => {{ slider.value = k; slider.dispatchEvent(new page.Event('input')); }};
  const pixel = page.document.createElement('canvas').getContext('2d', {{ willReadFrequently: true }});
  const color = ([x, y]) => {{
    const sharp = page.devicePixelRatio || 1;
    pixel.drawImage(canvas, -Math.round(x * sharp), -Math.round(y * sharp));
    return [...pixel.getImageData(0, 0, 1, 1).data].slice(0, 3);
  }};
  const between = (a, b, share) => [0, 1].map(c => canvas.at[a][c] + share * (canvas.at[b][c] - canvas.at[a][c]));
  const state = () => ({{ ...canvas.dataset, ...figure.dataset, picture: +root.dataset.picture, at: canvas.at,
    lines: canvas.lines,
    size: [canvas.clientWidth, canvas.clientHeight], hinge: color(between({hinge}, 0.1)),
    damper: color(between({damper}, 0.5)) }});
  const key = key => {{ const event = new page.KeyboardEvent('keydown', {{ key, bubbles: true, cancelable: true }});
    canvas.dispatchEvent(event); return event.defaultPrevented; }};
  const finger = (type, id, x, y) => canvas.dispatchEvent(new page.PointerEvent(type,
    {{ pointerId: id, pointerType: 'touch', clientX: x, clientY: y, bubbles: true }}));
  canvas.setPointerCapture = () => {{}}; // made events belong to no finger
  const steps = {{
    start: () => go(0), later: () => go({later}),
    left: () => key('ArrowLeft'), up: () => key('ArrowUp'), near: () => key('+'),
    drag: () => {{
      finger('pointerdown', 7, 100, 100); finger('pointermove', 7, 150, 110); finger('pointerup', 7, 150, 110);
    }},
    pinch: () => {{
      finger('pointerdown', 7, 100, 100); finger('pointerdown', 8, 200, 100);
      finger('pointermove', 8, 220, 100);
      finger('pointerup', 7, 100, 100); finger('pointerup', 8, 220, 100);
    }},
    elevation: () => key('1'), side: () => key('2'), plan: () => key('3'), corner: () => key('0'),
    time: () => key('PageUp'), last: () => go(10000),
  }};
  const found = {{}};
  for (const [name, act] of Object.entries(steps)) {{ act(); found[name] = state(); }}
  const boxes = [...root.querySelectorAll('figure, canvas, svg, .controls')].map(e => e.getBoundingClientRect());
  document.documentElement.dataset.found = JSON.stringify({{ found,
    requests: page.performance.getEntriesByType('resource').length,
    wide: boxes.filter(box => box.right > page.innerWidth + 1).length,
    scroll: page.getComputedStyle(canvas).touchAction, legend: root.querySelector('.legend').textContent,
    titles: [...root.querySelectorAll('.diagram figcaption')].map(e => e.textContent) }});
}};</script></body></html>"""
LATER = 105


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A page with the motion of the small building alone."""
    return _page(moving_archive(tmp_path_factory.mktemp("building")))


@pytest.fixture(scope="module")
def told(made: Path, tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    """What a reader sees on a desk."""
    return _seen(made, tmp_path_factory.mktemp("driven"), 1280)


@pytest.fixture(scope="module")
def geometry(tmp_path_factory: pytest.TempPathFactory) -> Geometry:
    """What moves of the building, in the order in which it is drawn."""
    return moving_building(small_building(tmp_path_factory.mktemp("nodes")), ())


def _page(archive: Path) -> Path:
    with open_archive(archive) as opened:
        page = render(Cover("Motion", "", ""), [motion(Source(opened))])
    archive.with_suffix(".html").write_text(page, encoding="utf-8")
    return archive.with_suffix(".html")


def _data(page: Path) -> dict[str, Any]:
    (data,) = re.findall(r'<script type="application/json">(.*?)</script>', page.read_text(encoding="utf-8"), re.DOTALL)
    return dict(json.loads(data))


def _seen(page: Path, folder: Path, width: int) -> dict[str, Any]:
    names = list(small_building(folder).layout.nodes)
    ends = {"hinge": ("A1.1", "B1.1"), "damper": ("B1.0", "B2.1")}
    points = {what: ", ".join(str(names.index(name)) for name in pair) for what, pair in ends.items()}
    return driven(browser(), page, folder, DRIVER.format(width=width, later=LATER, **points))


def _eye(state: dict[str, Any], places: np.ndarray, middle: np.ndarray) -> np.ndarray:
    """Coordinates of points to the right of and above the axis of sight over their distance along it, (n, 2).

    A pinhole camera, written anew: the eye at its distance from the middle, which it looks at, upright.
    """
    turn, tilt = np.radians(float(state["turn"])), np.radians(float(state["tilt"]))
    towards = np.array((np.sin(turn) * np.cos(tilt), -np.cos(turn) * np.cos(tilt), np.sin(tilt)))
    eye = middle + float(state["away"]) * towards
    forward = (middle - eye) / np.linalg.norm(middle - eye)
    east = np.array((np.cos(turn), np.sin(turn), 0.0))
    right = np.cross(forward, (0.0, 0.0, 1.0)) if abs(forward[2]) < 0.999 else east
    right = right / np.linalg.norm(right)
    up = np.cross(right, forward)
    rays = places - eye
    return np.column_stack((rays @ right, rays @ up)) / (rays @ forward)[:, np.newaxis]


def test_nodes_are_drawn_where_an_eye_sees_them(made: Path, told: dict[str, Any], geometry: Geometry) -> None:
    assert told["requests"] == 0 and told["wide"] == 0
    _compare(told, geometry, _data(made)["scale"])


@pytest.mark.slow
def test_nodes_are_drawn_on_a_phone(made: Path, tmp_path: Path, geometry: Geometry) -> None:
    told = _seen(made, tmp_path, 360)
    assert told["wide"] == 0
    _compare(told, geometry, _data(made)["scale"])


def _compare(told: dict[str, Any], geometry: Geometry, scale: float) -> None:
    nodes = geometry.nodes
    rest = np.array(list(nodes.values()))
    middle = 0.5 * (rest.min(axis=0) + rest.max(axis=0))
    for name, state in told["found"].items():
        moved = formula(nodes, np.array([STEP * state["picture"]]))[0, :, :3]
        seen = _eye(state, rest + scale * moved, middle)
        wide, high = state["size"]
        drawn = (np.array(state["at"])[:, :2] - (0.5 * wide, 0.5 * high)) * (1.0, -1.0)
        focus = float(np.sum(drawn * seen) / np.sum(seen**2))
        # displacements, up to 0.08 m, are rounded by the viewer to 1/4000 of the largest at most; nothing is nearer
        metre = focus / (float(state["away"]) - 8.0)
        assert drawn == pytest.approx(focus * seen, abs=scale * 0.08 / STEPS * metre + 0.01, rel=0.0), name
        # members bend as cubics, which another test compares with beam theory
        motion = formula(nodes, np.array([STEP * state["picture"]]))[0]
        for member, line in zip(geometry.members, state["lines"], strict=True):
            curve = _eye(state, member_curve(geometry, member, motion, scale, len(line)), middle)
            found = (np.array(line)[:, :2] - (0.5 * wide, 0.5 * high)) * (1.0, -1.0)
            # turns are rounded as displacements, in rad; their arm is 4/27 of the length of a member, 6 m at most
            assert found == pytest.approx(focus * curve, abs=2.0 * scale * 0.08 / STEPS * metre + 0.01, rel=0.0), member
        if name not in ("near", "drag", "pinch"):  # nearer than all of it
            assert np.all(np.abs(drawn) < (0.5 * wide, 0.5 * high)), name


def test_it_is_not_mirrored(told: dict[str, Any], geometry: Geometry) -> None:
    """Seen from the front x goes right, y away and z up; from above y goes up; and x across y points at the eye."""
    names = list(geometry.nodes)

    def at(state: str, node: str) -> np.ndarray:
        return np.array(told["found"][state]["at"][names.index(node)])

    for state in ("start", "elevation"):
        assert at(state, "B1.0")[0] > at(state, "A1.0")[0] + 20.0
        assert at(state, "A1.1")[1] < at(state, "A1.0")[1] - 20.0
        assert at(state, "A3.0")[2] > at(state, "A1.0")[2] + 3.0  # m
    assert at("plan", "A3.0")[1] < at("plan", "A1.0")[1] - 20.0 and at("plan", "B1.0")[0] > at("plan", "A1.0")[0] + 20.0
    assert at("side", "A3.0")[0] > at("side", "A1.0")[0] + 20.0  # along y: looking at it from +x
    assert at("plan", "A1.2")[2] < at("plan", "A1.0")[2]  # the roof is nearer to an eye above


def test_keys_and_fingers_turn_it(told: dict[str, Any]) -> None:
    found = told["found"]

    def eye(name: str) -> tuple[float, float, float]:
        state = found[name]
        return float(state["turn"]), float(state["tilt"]), float(state["near"])

    turn, tilt, near = eye("start")
    assert (turn, tilt, near) == (30.0, 18.0, 1.0)
    assert eye("left") == (turn + 5.0, tilt, 1.0) and eye("up") == (turn + 5.0, tilt + 5.0, 1.0)
    assert eye("near") == (turn + 5.0, tilt + 5.0, 1.15)
    # 50 px to the right and 10 px down at 0.4 degrees each: what is in front goes with the finger
    assert eye("drag") == pytest.approx((turn + 5.0 - 20.0, tilt + 5.0 + 4.0, 1.15))
    # two fingers 100 px apart, then 120; one of them moved, by 20 px at 0.2 degrees
    assert eye("pinch") == pytest.approx((turn - 15.0 - 4.0, tilt + 9.0, 1.15 * 1.2))
    assert [eye(name)[:2] for name in ("elevation", "side", "plan", "corner")] == [(0, 0), (90, 0), (0, 90), (30, 18)]
    pictures = [found[name]["picture"] for name in ("corner", "time", "last")]
    assert pictures == [LATER, min(LATER + round(1 / STEP), PICTURES - 1), PICTURES - 1]
    assert told["scroll"] == "pan-y"  # a finger that goes up or down scrolls the page


def test_colors_tell_yield_and_strokes(made: Path, told: dict[str, Any]) -> None:
    found, classes = told["found"], dict(_data(made)["classes"])
    assert (found["start"]["hinges"], found["later"]["hinges"], found["last"]["hinges"]) == ("0", "2", "2")
    time = STEP * np.arange(PICTURES)
    largest = np.maximum.accumulate(np.abs(0.012 * np.sin(7.0 * time) * time / time[-1]))
    assert 0.005 < largest[LATER] < 0.010 < largest[-1]
    # the line is wider than a pixel where it is looked at
    assert _hex(found["later"]["hinge"]) == classes["5 to 10 mrad"]
    assert _hex(found["start"]["hinge"]) not in classes.values()
    red, _, blue = found["later"]["damper"]
    stroke = np.sin(7.0 * STEP * LATER)  # of N_B1.0_B2.1, times 5 mm of 20: pale
    assert (red - blue) * stroke > 0 and abs(red - blue) < 80
    assert "stroke of the damper > 0, to 20 mm" in told["legend"]
    assert [title for title in told["titles"] if "drift" in title] == [
        f"Storey drift along {axis}, pale: largest" for axis in ("x", "y")
    ]


def _hex(color: list[int]) -> str:
    return "#" + "".join(f"{part:02x}" for part in color)


def test_texts_below_are_those_of_the_archive(told: dict[str, Any]) -> None:
    state = told["found"]["later"]
    roof = formula({"centre": (5.0, 4.0, 7.0)}, np.array([STEP * LATER]))[0, 0]
    step = 0.06 / STEPS
    assert (float(state["x"]), float(state["y"])) == pytest.approx((roof[0], roof[1]), abs=step)
    # of both storeys the drift is the displacement of the roof over 7 m, and that along x is larger
    assert state["axis"] == "x" and float(state["drift"]) == pytest.approx(roof[0] / 7.0, abs=0.06 / 7.0 / STEPS)


def test_only_pages_of_buildings_have_its_program(made: Path) -> None:
    """The security policy lets the one program run: both files, the plane viewer last."""
    text = made.read_text(encoding="utf-8")
    (program,) = re.findall(r"<script>(.*?)</script>", text, re.DOTALL)
    folder = Path(render.__code__.co_filename).parent
    own = [(folder / name).read_text(encoding="utf-8") for name in ("viewer_of_buildings.js", "viewer.js")]
    assert program == "".join(own) and "http" not in own[0]
    digest = base64.b64encode(hashlib.sha256(program.encode()).digest()).decode()
    assert f"script-src 'sha256-{digest}'" in text


def test_floors_alone_move_as_rigid_bodies(tmp_path: Path, geometry: Geometry) -> None:
    """Without the nodes their motion in plan is that of the floors, turn included, to the rounding of the viewer."""
    page = _page(moving_archive(tmp_path, motion=False))
    (about,) = _data(page)["variants"]
    assert about["loose"] == [] and len(about["bodies"]) == 3 and not about["whole"]
    assert "Only floors were kept" in page.read_text(encoding="utf-8")
    state = _seen(page, tmp_path, 1280)["found"]["plan"]
    nodes = geometry.nodes
    moved = formula(nodes, np.array([STEP * state["picture"]]))[0, :, :2]
    rest = np.array(list(nodes.values()))[:, :2]
    drawn = np.array(state["at"])[:, :2] * (1.0, -1.0)
    expected = rest + _data(page)["scale"] * moved
    expected, drawn = expected - expected.mean(axis=0), drawn - drawn.mean(axis=0)
    metre = float(np.sum(drawn * expected) / np.sum(expected**2))
    assert drawn == pytest.approx(metre * expected, abs=0.3)  # px: parallel but for a share of 1e-4, and the rounding


def test_dampers_without_a_place_are_left_out(made: Path) -> None:
    (about,) = _data(made)["variants"]
    assert [damper["name"] for damper in about["dampers"]] == list(DAMPERS[:3])
