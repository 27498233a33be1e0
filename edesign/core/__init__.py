"""The numerical core: plane frames of force-based fibre beam-columns. The only package that knows C."""

from edesign.core._edcore import ffi, lib
from edesign.core.analysis import Analysis, SupportMotion
from edesign.core.campaign import CampaignForces, CampaignTest, campaign_forces
from edesign.core.damper import CoreDamper, EffectValues, LawValues
from edesign.core.errors import CoreError
from edesign.core.integrators import HHT, GeneralisedAlpha, Integrator, Newmark
from edesign.core.materials import Bilinear, Elastic, Fatigue, MenegottoPinto, Steel
from edesign.core.model import Model
from edesign.core.modes import Modes, damped_eigenvalue, natural_modes
from edesign.core.response import ENERGIES, Channel, Response
from edesign.core.rig import SeriesRig
from edesign.core.springs import ContactSpring, DeterioratingSide, DeterioratingSpring, MultilinearSpring, SpringLaw

__all__ = [
    "ENERGIES",
    "HHT",
    "EffectValues",
    "Analysis",
    "Bilinear",
    "CampaignForces",
    "CampaignTest",
    "Channel",
    "ContactSpring",
    "CoreDamper",
    "CoreError",
    "DeterioratingSide",
    "DeterioratingSpring",
    "Elastic",
    "Fatigue",
    "GeneralisedAlpha",
    "Integrator",
    "LawValues",
    "MenegottoPinto",
    "Model",
    "Modes",
    "campaign_forces",
    "damped_eigenvalue",
    "library_versions",
    "MultilinearSpring",
    "Newmark",
    "Response",
    "SeriesRig",
    "SpringLaw",
    "Steel",
    "SupportMotion",
    "natural_modes",
    "version",
]


def version() -> str:
    """Return the version of the C core."""
    return str(ffi.string(lib.ed_version()).decode())


def library_versions() -> dict[str, str]:
    """Return the versions of the libraries that the core has loaded, by name: SuiteSparse and SUNDIALS."""
    size = 64
    texts = {name: ffi.new("char[]", size) for name in ("SuiteSparse", "SUNDIALS")}
    lib.ed_library_versions(size, *texts.values())
    return {name: str(ffi.string(text).decode()) or "unknown" for name, text in texts.items()}
