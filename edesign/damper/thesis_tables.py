"""The thesis' prototype damper: what was measured (Tables A.1-A.4) and what its law predicts."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from importlib import resources

import numpy as np

from edesign.damper.damper import Damper
from edesign.damper.laws import law
from edesign.damper.parameters import read_parameters
from edesign.damper.temperature import GammaT, TemperatureModel
from edesign.damper.testing.specimen import Specimen
from edesign.damper.testing.steady_state import PropertyRows, predict

_MPA = 1e6
PROTOTYPE = Specimen("prototype", layers=2, layer_area=0.180 * 0.230, layer_thickness=0.012)
"""The specimen of the thesis. The thickness is not printed; 12 mm is where Table 4.2 fits G' of Table A.1 best."""

TABLE_4_4 = GammaT()
"""gamma_T as printed."""


@dataclass(frozen=True)
class Residuals:
    """Predicted over measured less one, shape (n,) each."""

    G_storage: np.ndarray
    G_eq: np.ndarray
    loss_factor: np.ndarray

    def rms(self) -> tuple[float, float, float]:
        """Return the root of the mean square of each property.

        Returns:
            One value a property, dimensionless.
        """
        return _each(self, lambda r: float(np.sqrt(np.mean(r**2))))

    def mean(self) -> tuple[float, float, float]:
        """Return the mean of each property.

        Returns:
            One value a property, dimensionless.
        """
        return _each(self, lambda r: float(np.mean(r)))


def _each(r: Residuals, function: Callable[[np.ndarray], float]) -> tuple[float, float, float]:
    return function(r.G_storage), function(r.G_eq), function(r.loss_factor)


@cache
def measured() -> PropertyRows:
    """Return the 120 rows of Tables A.1-A.4.

    In Table A.4 the rows of 30 % strain at 1 and 2 Hz are identical: a slip of the source.
    """
    text = resources.files("edesign.damper").joinpath("data/thesis_appendix_a.csv").read_text(encoding="utf-8")
    T, percent, frequency, G_storage, G_eq, loss_factor = np.loadtxt(
        text.splitlines(), delimiter=",", skiprows=1, unpack=True
    )
    return PropertyRows(
        percent / 100.0, frequency, T, G_storage * _MPA, G_eq * _MPA, loss_factor * G_storage * _MPA, loss_factor
    )


def prototype_damper() -> Damper:
    """Return the prototype by the MGMM with Table 4.2."""
    mgmm = law("mgmm")
    return Damper(mgmm, read_parameters(mgmm, "thesis_table_4_2"))


def predicted(damper: Damper | None = None, temperature_model: TemperatureModel | None = TABLE_4_4) -> PropertyRows:
    """Return the properties that a law predicts for the 120 tests.

    Args:
        damper: law with its parameters; None: the MGMM with Table 4.2.
        temperature_model: how they change with temperature; by default Table 4.4.
    """
    rows = measured()
    return predict(
        damper or prototype_damper(), PROTOTYPE, rows.strain, rows.frequency, rows.temperature_C, temperature_model
    )


def residuals(predicted: PropertyRows, measured: PropertyRows) -> Residuals:
    """Return the relative residuals of a prediction.

    Args:
        measured: properties of the same tests.
    """
    return Residuals(
        predicted.G_storage / measured.G_storage - 1.0,
        predicted.G_eq / measured.G_eq - 1.0,
        predicted.loss_factor / measured.loss_factor - 1.0,
    )


def pointedness(rows: PropertyRows) -> np.ndarray:
    """Return G_eq / (G' sqrt(1 + n^2)), shape (n,): 1 for an ellipse.

    A linear law has sinusoidal stress, whose amplitude is the root of the squares of G' and G''. A spring beside a
    dashpot of constant force (exponent near 0) has G_eq / G' = 1 + pi n / 4: 1.2 for n = 0.35. A rate-independent loop,
    whose stress is largest at the largest strain, has less than 1.
    """
    return rows.G_eq / (rows.G_storage * np.sqrt(1.0 + rows.loss_factor**2))


def residual_csv(predicted: PropertyRows, measured: PropertyRows) -> str:
    """Return the rows with measured and predicted properties and relative residuals as CSV.

    Args:
        measured: properties of the same tests.
    """
    r = residuals(predicted, measured)
    columns = {
        "temperature_C": measured.temperature_C,
        "shear_strain_percent": 100.0 * measured.strain,
        "frequency_Hz": measured.frequency,
        "G_storage_measured_MPa": measured.G_storage / _MPA,
        "G_storage_predicted_MPa": predicted.G_storage / _MPA,
        "G_storage_residual_percent": 100.0 * r.G_storage,
        "G_eq_measured_MPa": measured.G_eq / _MPA,
        "G_eq_predicted_MPa": predicted.G_eq / _MPA,
        "G_eq_residual_percent": 100.0 * r.G_eq,
        "loss_factor_measured": measured.loss_factor,
        "loss_factor_predicted": predicted.loss_factor,
        "loss_factor_residual_percent": 100.0 * r.loss_factor,
    }
    lines = [",".join(columns)]
    lines += [",".join(f"{value:.4g}" for value in row) for row in zip(*columns.values(), strict=True)]
    return "\n".join(lines) + "\n"
