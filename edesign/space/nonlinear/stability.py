"""What moves of a building that is unstable under its loads, in words."""

from __future__ import annotations

import numpy as np

from edesign.core import Modes
from edesign.frame.frame_model import FrameModel, RigidPart


def softest_motion(frame: FrameModel, modes: Modes) -> str:
    """Return which floor moves most in the first mode, and how.

    Args:
        frame: of the building.
    """
    found = []
    for body in (body for floor in frame.floors for body in floor.parts or (floor,)):
        x, y = (float(np.mean([modes.moved(one)[0] for one in alike])) for alike in body.movers)
        plan = np.array([frame.places[node][:2] for node in body.nodes])
        radius = 0.5 * float(np.hypot(*np.ptp(plan, axis=0)))
        turn = float(modes.moved(body.turn)[0]) * radius if body.turn else 0.0
        words = ("sways along x", "sways along y", "turns about the vertical")
        most = int(np.argmax(np.abs([x, y, turn])))
        subject = f"diaphragm {body.name}" if isinstance(body, RigidPart) else f"floor {body.number}"
        found.append((abs((x, y, turn)[most]), f"{subject} {words[most]}"))
    return max(found)[1]
