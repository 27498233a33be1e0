"""Cross checks of soils and of the footings on them."""

from __future__ import annotations

from edesign.project.analysis_file import AnalysisFile
from edesign.project.frame.foundations import Footing, FootingSupport, GivenStrain, Soil
from edesign.project.reading.problems import Keys, Problems, unknown_name


def check_foundations(project: AnalysisFile, problems: Problems, supports: object, place: Keys) -> None:
    """Check that soils are complete, that footings stand on one, and that their keys fit together.

    Args:
        project: read without schema problems.
        supports: of the frame or building: a mapping by lines, or one for all.
        place: of the supports in the file.
    """
    for name, soil in project.soils.items():
        _soil(problems, ("soils", name), soil)
    for line, support in supports.items() if isinstance(supports, dict) else ():
        if isinstance(support, FootingSupport):
            _footing(project, problems, (*place, line, "footing"), support.footing)


def _soil(problems: Problems, keys: Keys, soil: Soil) -> None:
    if (soil.shear_wave_velocity is None) == (soil.shear_modulus is None):
        problems.at_value(keys, "give either `shear_wave_velocity` or `shear_modulus`, one of them [E-KEY-03]")
    if soil.damping is None and (soil.strain is None or isinstance(soil.strain, GivenStrain)):
        message = (
            "`damping` is missing, the hysteretic damping of the soil as a share of critical, for example `3 %`"
            " [E-KEY-02]"
        )
        problems.at_value(keys, message)
    if soil.damping == 1.0:
        problems.at_value(
            (*keys, "damping"), "a soil of critical damping does not vibrate; less than 1 is allowed [E-VALUE-02]"
        )


def _footing(project: AnalysisFile, problems: Problems, keys: Keys, footing: Footing) -> None:
    if footing.soil not in project.soils:
        problems.at_value((*keys, "soil"), unknown_name("soil", footing.soil, project.soils))
    if footing.wall_contact is not None and footing.wall_contact > footing.embedment:
        message = (
            f"the walls are {footing.embedment:g} m below ground, less than {footing.wall_contact:g} m [E-VALUE-04]"
        )
        problems.at_value((*keys, "wall_contact"), message)
    if footing.bearing_resistance is not None and not footing.uplift:
        message = (
            "soil that gives way under pressure carries no tension either; give `uplift: true` with it [E-FRAME-06]"
        )
        problems.at_key((*keys, "bearing_resistance"), message)
    if "density" in footing.model_fields_set and footing.thickness is None:
        problems.at_key((*keys, "density"), "without `thickness` the footing has no mass [E-MODAL-02]")
    if footing.period is None and project.masses is None:
        message = "without `masses` there is no first period; give the `period` of the footing [E-MODAL-02]"
        problems.at_key(keys, message)
