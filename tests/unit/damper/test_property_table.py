"""Property tables: files, and interpolation on the grid."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import scipy
from messages import says

from edesign.damper.testing.measured_histories import DamperTest
from edesign.damper.testing.properties import properties
from edesign.damper.testing.property_table import PropertyTable, read_property_table, write_property_table
from edesign.damper.testing.signals import sine
from edesign.damper.testing.specimen import Specimen
from edesign.errors import InputError

HEADERS = "temperature_C,shear_strain_percent,frequency_Hz,G_storage_MPa,G_eq_MPa,loss_factor\n"


def table(temperatures: tuple[float, ...] = (20.0, 30.0), scatter: float = 0.0) -> PropertyTable:
    """Properties that are linear in strain, log frequency and temperature, and in no product of them."""
    axes = np.meshgrid(temperatures, (0.1, 0.2, 0.5), (0.25, 1.0, 4.0), indexing="ij")
    t, g, f = (axis.ravel() for axis in axes)
    g = g * (1.0 + scatter * np.tile([-1.0, 0.0, 1.0], t.size // 3))
    return PropertyTable(t, g, f, storage(g, f, t), 1.1 * storage(g, f, t), 0.4 - 0.2 * g + 0.01 * np.log(f))


def storage(g: np.ndarray, f: np.ndarray, t: np.ndarray) -> np.ndarray:
    return 1e6 * (2.0 - g + 0.1 * np.log(f) - 0.01 * (t - 20.0))


@pytest.mark.parametrize("temperatures", [(20.0, 30.0), (20.0,)])
def test_interpolation_is_that_of_scipy(temperatures: tuple[float, ...]) -> None:
    """To the last bit, as archives of designs hold what it gives."""
    random = np.random.default_rng(3)
    rows = table(temperatures)
    values = random.uniform(0.5, 1.0, (3, rows.strain.size))
    rows = PropertyTable(rows.temperature_C, rows.strain, rows.frequency, *values)
    g, f, t = (random.uniform(*ends, (20, 5)) for ends in ((0.1, 0.5), (0.25, 4.0), (20.0, temperatures[-1])))
    g[0], f[1] = (0.1, 0.2, 0.5, 0.2, 0.1), (0.25, 1.0, 4.0, 4.0, 1.0)
    found = rows.interpolate(g, f, t)
    axes = (np.array(temperatures), np.array([0.1, 0.2, 0.5]), np.log([0.25, 1.0, 4.0]))
    kept = slice(int(len(temperatures) == 1), None)
    grid = np.squeeze(np.moveaxis(values.reshape(3, len(temperatures), 3, 3), 0, -1))
    peer = scipy.interpolate.RegularGridInterpolator(axes[kept], grid)
    wanted = peer(np.stack((t, g, np.log(f))[kept], axis=-1))
    assert np.array_equal(np.stack((found.G_storage, found.G_eq, found.loss_factor), axis=-1), wanted)


def test_interpolation_is_exact_where_the_properties_are_linear() -> None:
    g, f, t = np.array([0.1, 0.13, 0.35, 0.5]), np.array([0.25, 0.7, 3.0, 4.0]), np.array([20.0, 24.0, 29.0, 30.0])
    found = table().interpolate(g, f, t)
    assert found.G_storage == pytest.approx(storage(g, f, t))
    assert found.G_eq == pytest.approx(1.1 * storage(g, f, t))
    assert found.loss_factor == pytest.approx(0.4 - 0.2 * g + 0.01 * np.log(f))
    assert found.G_loss == pytest.approx(found.loss_factor * found.G_storage)
    assert found.inside.all()
    assert float(table().interpolate(0.2, 1.0, 25.0).G_storage) == pytest.approx(1e6 * (2.0 - 0.2 - 0.05))


def test_one_temperature_is_enough_for_tests_at_it() -> None:
    found = table((20.0,)).interpolate([0.15, 0.3], 0.5, 20.4)
    assert found.G_storage == pytest.approx(storage(np.array([0.15, 0.3]), np.array(0.5), np.array(20.0)))
    with pytest.raises(InputError, match="temperature 25 degC .* 20 degC .*E-PROPS-03"):
        table((20.0,)).interpolate(0.2, 1.0, 25.0)


def test_measured_amplitudes_that_differ_a_little_are_one_level() -> None:
    assert table(scatter=0.01).levels[1] == pytest.approx([0.1, 0.2, 0.5])


def test_outside() -> None:
    with pytest.raises(InputError, match="strain 60 % .* 10 to 50 % .*E-PROPS-03"):
        table().interpolate(0.6, 1.0, 20.0)
    with pytest.raises(InputError, match=r"frequency 5 Hz .* 0\.25 to 4 Hz .*E-PROPS-03"):
        table().interpolate(0.3, 5.0, 20.0)
    found = table().interpolate([0.6, 0.3], [1.0, 1.0], 20.0, outside="edge")
    assert found.inside.tolist() == [False, True]
    assert found.G_storage[0] == pytest.approx(1e6 * (2.0 - 0.5))


def test_a_missing_combination_is_named() -> None:
    whole = table()
    keep = np.arange(len(whole)) != 4
    names = ("temperature_C", "strain", "frequency", "G_storage", "G_eq", "loss_factor")
    part = PropertyTable(*(getattr(whole, name)[keep] for name in names))
    with pytest.raises(InputError, match=r"20 % strain, 1 Hz and 20 degC \(1 of 18 .*E-PROPS-02"):
        part.interpolate(0.3, 1.0, 20.0)


def test_files(tmp_path: Path) -> None:
    write_property_table(table(), tmp_path / "p.csv")
    back = read_property_table(tmp_path / "p.csv")
    assert (tmp_path / "p.csv").read_text().startswith(HEADERS + "20,10,0.25,")
    for name in ("temperature_C", "strain", "frequency", "G_storage", "G_eq", "loss_factor"):
        assert getattr(back, name) == pytest.approx(getattr(table(), name), rel=1e-6)  # seven digits


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (
            HEADERS.replace("G_eq_MPa", "G_eq_kPa") + "20,10,1,1,1,1\n",
            "column 5 (`G_eq_kPa`): the column is unknown; did you mean",
        ),
        (HEADERS.replace(",loss_factor", "") + "20,10,1,1,1\n", "p.csv:1: `loss_factor` E-PROPS-04"),
        (HEADERS + "20,10,1,1,1,0.4\n20,20,1,1,-1,0.4\n", "p.csv:3, column 5 (`G_eq_MPa`): -1 E-PROPS-01"),
    ],
)
def test_wrong_files(tmp_path: Path, text: str, said: str) -> None:
    (tmp_path / "p.csv").write_text(text)
    with pytest.raises(InputError) as raised:
        read_property_table(tmp_path / "p.csv")
    assert says(str(raised.value), said)


def test_too_few_cycles_are_counted() -> None:
    t, u = sine(0.001, 1.0, 9)
    test = DamperTest("short", t, u, 1e6 * u)
    specimen = Specimen("p", 1, 1.0, 0.01)
    with pytest.raises(InputError, match="test short: cycles 5 to 15 .* 15 .*9; ask for cycles 1 to 9 .*E-TEST-08"):
        properties(test, specimen, (5, 15))
    assert properties(test, specimen, (2, 9)).G_storage == pytest.approx(1e6 * 0.01)
    assert properties(test, specimen).cycles == (3, 9)
    t, u = sine(0.001, 1.0, 2, 0.5, 0.5)
    with pytest.raises(InputError, match="test two: .* 3 .* there are 2 .*E-TEST-08"):
        properties(DamperTest("two", t, u, 1e6 * u), specimen)
    with pytest.raises(InputError, match="cycles: 5 to 3 .*E-TEST-08"):
        properties(test, specimen, (5, 3))
    with pytest.raises(InputError, match="test short: .*E-TEST-06"):
        properties(DamperTest("short", t, u), specimen)
