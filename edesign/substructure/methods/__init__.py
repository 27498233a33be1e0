"""Other methods of testing as virtual experiments: pseudo-dynamic, effective force, shaking table (thesis 6.1)."""

from __future__ import annotations

from edesign.substructure.methods.comparison import MethodRecord
from edesign.substructure.methods.effective_force import EffectiveForceRecord, Forcing, effective_force_test
from edesign.substructure.methods.pseudo_dynamic import ControlError, PseudoDynamicRecord, pseudo_dynamic_test
from edesign.substructure.methods.rate import RateEffect, steady_stiffness
from edesign.substructure.methods.shaking_table import ShakingTable, ShakingTableRecord, shaking_table_test

__all__ = [
    "ControlError",
    "EffectiveForceRecord",
    "Forcing",
    "MethodRecord",
    "PseudoDynamicRecord",
    "RateEffect",
    "ShakingTable",
    "ShakingTableRecord",
    "effective_force_test",
    "pseudo_dynamic_test",
    "shaking_table_test",
    "steady_stiffness",
]
