"""Buildings as models of the core that yields and is shaken: nodes and loads are those of the elastic design."""

from edesign.space.nonlinear.build import build_building

__all__ = ["build_building"]
