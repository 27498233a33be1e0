"""How response measures are shown: header of a column, name of a row, unit."""

from __future__ import annotations

FRAME_COLUMNS = (  # header, measure, unit of the header in SI
    ("roof u [m]", "roof_displacement_m", 1.0),
    ("residual u [m]", "residual_roof_displacement_m", 1.0),
    ("roof drift [%]", "roof_drift", 0.01),
    ("storey drift [%]", "interstorey_drift", 0.01),
    ("residual drift [%]", "residual_interstorey_drift", 0.01),
    ("base shear [kN]", "base_shear_N", 1e3),
    ("col. base shear [kN]", "column_base_shear_N", 1e3),
    ("roof a [m/s2]", "roof_acceleration_m_s2", 1.0),
    ("beam rot. [mrad]", "beam_plastic_rotation_rad", 1e-3),
    ("col. rot. [mrad]", "column_plastic_rotation_rad", 1e-3),
    ("col. N [kN]", "column_axial_force_N", 1e3),
)
DAMPER_COLUMNS = (
    ("damper strain [%]", "damper_strain", 0.01),
    ("damper u [mm]", "damper_deformation_m", 1e-3),
    ("damper F [kN]", "damper_force_N", 1e3),
)
BRACE_COLUMNS = (
    ("brace ductility", "brace_ductility", 1.0),
    ("brace damage", "brace_damage", 1.0),
)
MEASURE_COLUMNS = (*FRAME_COLUMNS, *BRACE_COLUMNS, *DAMPER_COLUMNS)

MEASURE_ROWS = (  # name, measure, unit of the name in SI; those of the frame are in thesis Tables 5.8 and 5.9
    ("roof displacement [cm]", "roof_displacement_m", 0.01),
    ("residual roof displacement [cm]", "residual_roof_displacement_m", 0.01),
    ("roof drift [%]", "roof_drift", 0.01),
    ("interstorey drift [%]", "interstorey_drift", 0.01),
    ("residual interstorey drift [%]", "residual_interstorey_drift", 0.01),
    ("base shear, reactions [kN]", "base_shear_N", 1e3),
    ("base shear, columns [kN]", "column_base_shear_N", 1e3),
    ("roof acceleration [m/s2]", "roof_acceleration_m_s2", 1.0),
    ("beam plastic rotation [rad]", "beam_plastic_rotation_rad", 1.0),
    ("column plastic rotation [rad]", "column_plastic_rotation_rad", 1.0),
    ("column axial force [kN]", "column_axial_force_N", 1e3),
    ("brace ductility", "brace_ductility", 1.0),
    ("brace damage", "brace_damage", 1.0),
    ("damper strain [%]", "damper_strain", 0.01),
    ("damper deformation [mm]", "damper_deformation_m", 1e-3),
    ("damper force [kN]", "damper_force_N", 1e3),
)
ROUNDING = 1e-9  # m, N, rad: far below what any measure means


def measure_title(measure: str) -> tuple[str, str, float]:
    """Return a measure in words, its unit as shown ("" if it has no row in the tables), and that unit in SI."""
    title, factor = next(((name, factor) for name, key, factor in MEASURE_ROWS if key == measure), (measure, 1.0))
    words, _, unit = title.partition(" [")
    return words, unit.rstrip("]"), factor
