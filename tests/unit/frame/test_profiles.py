"""The catalogue against the published tables of its sections (EN 10365; areas in cm2, second moments in cm4)."""

from __future__ import annotations

import importlib.util
from pathlib import Path

import pytest

from edesign.errors import InputError
from edesign.frame.sections import profiles
from edesign.frame.sections.profiles import profile, profile_names

PUBLISHED = {  # name: h, b, tw, tf, r in mm; A; I_y
    "IPE300": (300, 150, 7.1, 10.7, 15, 53.81, 8356),
    "IPE360": (360, 170, 8.0, 12.7, 18, 72.73, 16270),
    "IPE400": (400, 180, 8.6, 13.5, 21, 84.46, 23130),
    "IPE450": (450, 190, 9.4, 14.6, 21, 98.82, 33740),
    "HEA200": (190, 200, 6.5, 10, 18, 53.83, 3692),
    "HEB300": (300, 300, 11, 19, 27, 149.1, 25170),
    "HEB320": (320, 300, 11.5, 20.5, 27, 161.3, 30820),
    "HEB360": (360, 300, 12.5, 22.5, 27, 180.6, 43190),
    "HEB450": (450, 300, 14, 26, 27, 218.0, 79890),
    "HEM300": (340, 310, 21, 39, 27, 303.1, 59200),
}


@pytest.mark.parametrize("name", PUBLISHED)
def test_catalogue_agrees_with_the_published_table(name: str) -> None:
    *sizes, area, inertia = PUBLISHED[name]
    found = profile(name)
    assert [found.h, found.b, found.tw, found.tf, found.r] == pytest.approx([size / 1000 for size in sizes], rel=1e-12)
    # the tables round to four digits, and the source of the catalogue draws fillets as polygons: 0.1 %
    assert found.area == pytest.approx(area * 1e-4, rel=1e-3)
    assert found.inertia == pytest.approx(inertia * 1e-8, rel=1e-3)


def test_all_families_are_there() -> None:
    names = profile_names()
    assert len(names) == len(set(names)) > 600
    for family, count in (("IPE", 18), ("HEA", 24), ("HEB", 24), ("HEM", 24)):
        assert sum(name.startswith(family) for name in names) == count


def test_an_unknown_name_offers_the_nearest() -> None:
    with pytest.raises(InputError, match="no section `HEB 460`; of HEB the catalogue has near it .*`HEB450`"):
        profile("HEB 460")


def test_the_file_is_what_its_script_writes(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("structuralcodes")
    folder = Path(profiles.__file__).parent / "data"
    spec = importlib.util.spec_from_file_location("generate_profiles", folder / "generate_profiles.py")
    assert spec is not None and spec.loader is not None
    script = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(script)
    monkeypatch.setattr(script, "TARGET", tmp_path / "profiles.csv")
    script.main()
    written = (tmp_path / "profiles.csv").read_text().splitlines()
    committed = (folder / "profiles.csv").read_text().splitlines()
    if written[0] != committed[0]:
        pytest.skip("another version of structuralcodes")
    assert written == committed
