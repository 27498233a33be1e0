"""A scene as the text that the viewer in the page reads: small, as its numbers are whole, packed, and deflated."""

from __future__ import annotations

import base64
import json
import zlib
from typing import Any

import numpy as np

from edesign.report.drawing.captions import plain
from edesign.report.motion.geometry import SIGN, Hung, floor_shares
from edesign.report.motion.moving import FINER, Loop, Moving
from edesign.report.motion.plan_motion import rigid_motion
from edesign.report.motion.scenes import Scene
from edesign.report.response.frame_figures import COLORS
from edesign.study.results.motion import FINENESS

STEPS = 4000
"""Whole numbers up to the largest magnitude of a quantity: values are rounded to 1/8000 of it at most."""
DIGITS = 4  # of places in the frame, m: a tenth of a millimetre
SCALES = (1, 2, 5, 10, 20, 50, 100, 200, 500)
REACH = 0.16  # of the larger side of the frame that the largest displacement may be drawn as


class Packed:
    """Series of numbers, one after the other in one block."""

    def __init__(self) -> None:
        self._series: list[np.ndarray] = []
        self._count = 0

    def add(self, values: np.ndarray, step: float = 0.0) -> dict[str, Any]:
        """Add series of equal length and return where they are.

        Args:
            values: (n,) or (n, ...).
            step: to which they are rounded, if it is coarser than their own.

        Returns:
            `at` of the first number, `n` numbers in each of `w` series, and `q`, the quantity that 1 stands for.
        """
        table = np.asarray(values, dtype=float).reshape(len(values), -1)
        largest = float(np.max(np.abs(table), initial=0.0))
        step = max(step, float(f"{largest / STEPS:.6g}") if largest else 1.0)
        whole = np.rint(table / step).astype(np.int32)
        steps = np.diff(whole, axis=0, prepend=0).T.astype("<i2")
        place = {"at": self._count, "n": len(table), "w": table.shape[1], "q": step}
        self._series.append(steps.ravel())
        self._count += steps.size
        return place

    def text(self) -> str:
        """Return all of it: differences from picture to picture as low bytes, then high bytes; deflated, in base64."""
        block = np.concatenate([*self._series, np.zeros(0, dtype="<i2")])
        split = block.view(np.uint8).reshape(-1, 2).T.tobytes()
        return base64.b64encode(zlib.compress(split, 9)).decode("ascii")


def scene_text(scene: Scene) -> str:
    """Return a scene as JSON in which nothing can end an element of the page."""
    packed = Packed()
    found = {
        "n": len(scene.time),
        "dt": round(float(scene.time[1] - scene.time[0]), 6),
        "start": round(float(scene.time[0]), 6),
        "peak": scene.peak,
        "finer": FINER,
        "scale": fitting_scale(scene),
        "scales": SCALES,
        "ground": packed.add(scene.ground),
        "classes": [[name, color] for name, color in zip(scene.scale.names[1:], COLORS, strict=True)],
        "variants": [_variant(one, packed) for one in scene.variants],
    }
    if scene.in_space:
        found["space"] = True
    found["data"] = packed.text()
    return json.dumps(found, separators=(",", ":"), ensure_ascii=True).replace("<", "\\u003c")


def fitting_scale(scene: Scene) -> int:
    """Return how many times displacements are drawn larger than they are, as a round number."""
    largest = max(float(np.max(np.abs(one.floors))) for one in scene.variants)
    sides = [np.ptp(np.array(list(one.geometry.nodes.values())), axis=0).max() for one in scene.variants]
    fair = [scale for scale in SCALES if scale * largest <= REACH * float(max(sides))]
    return fair[-1] if fair else SCALES[0]


def _variant(one: Moving, packed: Packed) -> dict[str, Any]:
    geometry = one.geometry
    places = list(geometry.nodes.values())
    order = {name: i for i, name in enumerate(geometry.members)}
    found: dict[str, Any] = {
        "title": one.title,
        "analysis": one.analysis,
        "color": one.color,
        "nodes": [_places(place) for place in places],
        "members": [[name, *pair] for name, pair in geometry.members.items()],
        "levels": [round(level, DIGITS) for level in geometry.levels],
        "floors": packed.add(one.floors),
        "drift": packed.add(one.drift),
        "drift_max": packed.add(one.drift_max),
        "drift_min": packed.add(one.drift_min),
        "ends": [[order[name], end] for name, end in one.ends],
        "limits": [[float(f"{limit:.4g}") for limit in limits] for limits in one.limits],
        "largest": [float(f"{largest:.4g}") for largest in one.ends.values()],
        "dampers": [
            {
                "name": damper.name,
                "braces": [[_hung(start), _hung(end)] for start, end in damper.braces],
                "body": [_hung(point) for point in damper.body],
                "span": damper.span,
                "wide": round(damper.wide, DIGITS),
            }
            for damper in geometry.dampers
        ],
        "supports": [[support.kind, support.node] for support in geometry.supports],
        "base": list(geometry.base),
        "ground": round(geometry.ground, DIGITS),
        "sign": round(SIGN * geometry.size, DIGITS),
        "masses": [[mass.name, _hung(mass.at)] for mass in geometry.masses],
        "reach": float(f"{one.reach:.4g}"),
        "loops": [_loop(loop, packed) for loop in one.loops],
    }
    if geometry.in_space:
        found |= _in_space(one, packed)
    elif one.nodes is None:
        found["shares"] = [[below, round(share, DIGITS)] for below, share in floor_shares(geometry.levels, places)]
    else:
        found |= {name: packed.add(one.nodes[:, :, i]) for i, name in enumerate(("ux", "uy", "rz"))}
    if geometry.masses:
        found["strokes"] = packed.add(one.strokes)
    if one.rotation is not None:
        found["rotation"] = packed.add(one.rotation)
    if one.force is not None and one.force.shape[1]:
        found["force"] = packed.add(one.force)
    return found


def _in_space(one: Moving, packed: Packed) -> dict[str, Any]:
    """What a building has beyond a frame. Levels whose nodes move as a rigid body in plan are packed as such."""
    geometry, motion = one.geometry, one.node_motion
    places = np.array(list(geometry.nodes.values()))
    step = seen_step(motion)
    bodies, loose = [], []
    for level in np.unique(places[:, 2].round(DIGITS)):
        there = np.flatnonzero(np.abs(places[:, 2] - level) < 10.0**-DIGITS)
        middle, mean, turn = rigid_motion(places[there, :2], motion[:, there, :2])
        x, y = (places[there, :2] - middle).T
        rigid = np.stack((mean[:, :1] - np.outer(turn, y), mean[:, 1:] + np.outer(turn, x)), axis=-1)
        if np.max(np.abs(rigid - motion[:, there, :2])) > 2.0 * step:
            loose += there.tolist()
            continue
        body = {"nodes": there.tolist(), "at": _places(tuple(middle.tolist()))}
        bodies.append(body | {"moved": packed.add(mean), "turn": packed.add(turn)})
    names = list(geometry.members)
    found: dict[str, Any] = {
        "bodies": bodies,
        "loose": loose,
        "uz": packed.add(motion[:, :, 2], step),
        "rx": packed.add(motion[:, :, 3], step),
        "ry": packed.add(motion[:, :, 4], step),
        "hinged": sorted([names.index(name), end] for name, end in geometry.hinged),
        "slabs": geometry.slabs,
        "grid": [[label, _places(start), _places(end)] for label, start, end in geometry.grid],
        "masses": [[mass.name, _hung(mass.at), mass.direction] for mass in geometry.masses],
        "whole": one.nodes is not None,
    }
    if loose:
        found |= {name: packed.add(motion[:, loose, i], step) for name, i in (("ux", 0), ("uy", 1), ("rz", 5))}
    if one.deformation is not None and one.deformation.shape[1]:
        found["deformation"] = packed.add(one.deformation)
    return found


def seen_step(motion: np.ndarray) -> float:
    """Return the power of two, m and rad, to which archives round the motion of the nodes of a building.

    Args:
        motion: (pictures, nodes, 6) m, m, m, rad, rad, rad.
    """
    largest = float(np.max(np.abs(motion[..., :3]), initial=0.0))
    return float(2.0 ** np.floor(np.log2(largest / FINENESS))) if largest > 0.0 else 0.0


def _loop(loop: Loop, packed: Packed) -> dict[str, Any]:
    ends = [plain(float(np.max(np.abs(values), initial=0.0))) for values in (loop.x, loop.y)]
    return {
        "label": loop.label,
        "x": packed.add(loop.x),
        "y": packed.add(loop.y),
        "axes": [loop.x_label, loop.y_label],
        "ends": ends,
    }


def _places(place: tuple[float, ...]) -> list[float]:
    return [round(part, DIGITS) for part in place]


def _hung(point: Hung) -> list[float]:
    return [*_places(point.at), *point.nodes, round(point.share, DIGITS)]
