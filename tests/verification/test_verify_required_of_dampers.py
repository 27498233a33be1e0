"""What histories ask of dampers is one number in orders, connections and braces; by hand.

References: means of given forces; a bilinear law at its factored stroke, Fy + b k (u - Fy / k); statics of a chevron;
T_adj = omega R_y F_ysc A_sc, C_adj = beta T_adj (AISC 341-16, F4.2a), which connections hold (F4.6).
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest

from edesign.archive.dataset import Group
from edesign.assess.judged_designs import brace_forces
from edesign.assess.raised_devices import RaisedDevices
from edesign.assess.sets import history_sets
from edesign.codes.device_factors import DeviceFactors
from edesign.core import LawValues
from edesign.frame.devices import DeviceLaw
from edesign.frame.frame_model import FrameModel
from edesign.frame.sections.profiles import profile_names
from edesign.ground_motion.hazard import rules_in_force
from edesign.project import parse_project
from edesign.project.dampers.dampers import GivenFactors
from edesign.project.study.study import Study
from edesign.report.design.device_order import devices_tables
from edesign.report.inputs.connections import connection_tables
from edesign.report.inputs.damper_demand import demands_of, factored_ratio
from edesign.report.inputs.variant_frames import VariantFrames
from edesign.report.tables.table import Table
from edesign.study.analysis.structure import make_frame

FRAME = """\
edesign: 1
title: Two bays of 4.8 m, one storey of 3.2 m
frame:
  bays: [4.8 m, 4.8 m]
  storeys: [3.2 m]
  columns: [{storeys: all, section: HEB200, material: S355}]
  beams: [{floors: all, section: IPE300, material: S355}]
  diaphragms: all
materials:
  S355: {law: bilinear, E: 210 GPa, fy: 355 MPa}
masses: {given: [{lines: all, floors: all, mass: 10 t}]}
dampers:
  laws:
    slip: {type: elastic_plastic, parameters: {k: 100 kN/mm, Fy: 200 kN, b: 0.02}}
    brb:
      type: buckling_restrained
      parameters: {A_sc: 1000 mm^2, F_ysc: 262 MPa, E: 200 GPa, L_wp: 6.5 m, L_y: 4.4 m, KF: 1.35, alpha: 0.4 %,
                   R_y: 1.1, strain: [1 %, 2 %], omega: [1.28, 1.46], beta: [1.06, 1.12]}
  devices: [{kind: @kind@, law: @law@, bays: all, storeys: all}]
analyses: [{name: modes, kind: modal, modes: 1}]
"""
FACTORS = GivenFactors(stroke=1.2, velocity=1.5, overstrength=1.1)
RULES = rules_in_force(None)


def frame(kind: str, law: str) -> FrameModel:
    text = FRAME.replace("@kind@", kind).replace("@law@", law)
    return make_frame(parse_project(text, Path("project.yaml"), profile_names()), dampers=True)


def shaken(names: Sequence[str], tension: Sequence[float], compression: Sequence[float], **more: float) -> Group:
    """A history with the largest forces of its dampers, N, which have one stroke and velocity."""
    group = Group(attributes={"kind": "history", "variant": "damped", "level": "MCE", "status": "completed"})
    group.add("damper", ("damper",), list(names), "", "damper")
    group.coords["damper"] = group.variables.pop("damper")
    group.add("damper_storey", ("damper",), [1] * len(names), "1", "storey")
    group.add("damper_force_max", ("damper",), list(tension), "N", "force")
    group.add("damper_force_min", ("damper",), [-force for force in compression], "N", "force")
    for name, value in more.items():
        group.add(f"{name}_max", ("damper",), [value] * len(names), "", name)
        group.add(f"{name}_min", ("damper",), [-0.5 * value] * len(names), "", name)
    return group


def frames_of(made: FrameModel) -> VariantFrames:
    found: Any = SimpleNamespace(variants=("damped",), hazard=None, frame=lambda *_: made, first_period=lambda *_: 1.0)
    return cast(VariantFrames, found)


def connections(made: FrameModel, histories: dict[str, Group], governing: bool = False) -> Table:
    study: Any = SimpleNamespace(device_factors=FACTORS, derived={}, variants={})
    found = (frames_of(made), cast(Study, study), history_sets(histories), histories.__getitem__)
    (table,) = connection_tables(*found, governing)
    return table


def column(table: Table, header: str) -> list[float]:
    return [float(row[table.headers.index(header)]) for row in table.texts]


def test_connections_hold_the_force_that_the_damper_has_to_have() -> None:
    """Seven motions, of each the larger of both directions and places 200 kN: 1.1 x 244/236 x 200 = 227.5 kN.

    The mean of tension is (4 x 200 + 3 x 120) / 7 = 165.7 kN, of compression (4 x 120 + 3 x 200) / 7 = 154.3 kN: both
    are told, and neither is what the connection is for. A brace has F / (2 cos) = F / 1.2 = 189.6 kN.
    """
    made = frame("chevron", "slip")
    names = [device.name for device in made.devices]
    motions = [((200e3, 120e3), (120e3, 90e3))] * 4 + [((120e3, 90e3), (200e3, 120e3))] * 3
    histories = {
        f"damped.MCE.{i}": shaken(names, *forces, damper_deformation=0.020) for i, forces in enumerate(motions)
    }
    table = connections(made, histories)
    force = 1.1 * 244.0 / 236.0 * 200.0
    on = {row[2]: (row[table.headers.index("N [kN]")]) for row in table.texts}
    assert float(on["apex, to the damper"]) == pytest.approx(force, abs=0.06) and len(table.rows) == 8
    assert float(on["lower gusset"]) == pytest.approx(force / 1.2, abs=0.06)
    assert column(table, "T [kN]")[2] == pytest.approx(165.7) and column(table, "C [kN]")[2] == pytest.approx(154.3)
    assert "T_adj [kN]" not in table.headers
    short = connections(made, histories, governing=True)
    assert {row[1] for row in short.texts} == {"chevron, bay 1"}  # its damper has more than that of bay 2


def test_connections_of_restrained_braces_hold_adjusted_strengths() -> None:
    """A_sc = 1000 mm2: 1.46 x 1.1 x 262 = 420.8 kN, x 1.12 = 471.3 kN; histories ask for 300 kN."""
    made = frame("rising", "brb")
    names = [device.name for device in made.devices]
    few = {"damped.MCE.0": shaken(names, (300e3, 300e3), (280e3, 280e3), damper_deformation=0.02, damper_velocity=0.1)}
    table = connections(made, few)
    tension = 1.46 * 1.1 * 262.0
    assert column(table, "T_adj [kN]") == pytest.approx([tension] * 4, abs=0.05)
    assert column(table, "C_adj [kN]") == column(table, "N [kN]") == pytest.approx([1.12 * tension] * 4, abs=0.05)
    assert column(table, "H [kN]") == pytest.approx([1.12 * tension * 4.8 / np.hypot(4.8, 3.2)] * 4, abs=0.05)
    assert any("AISC 341-16, F4.6" in note for note in table.notes)
    beyond = {"damped.MCE.0": shaken(names, (500e3,) * 2, (500e3,) * 2, damper_deformation=0.02, damper_velocity=0.1)}
    assert min(column(connections(made, beyond), "N [kN]")) > 1.1 * 500.0


def design(method: str, **more: float) -> Group:
    """A design of one storey, a damper in each of both bays."""
    group = Group(attributes={"method": method, "name": "d", "number": 1, "status": "completed", "hardening": 0.02})
    group.add("storey", ("storey",), [1], "1", "storey")
    group.coords["storey"] = group.variables.pop("storey")
    for name, value in {"device_count": 2.0, **more}.items():
        group.add(name, ("storey",), [value], "1", name)
    return group


def test_devices_to_order_have_the_force_of_the_required_ones() -> None:
    """The braces are 5.77 m long, that of the law 6.5 m: at one stroke they are further beyond their yielding."""
    made = frame("rising", "brb")
    device, names = made.devices[0], [device.name for device in made.devices]
    assert device.restrained is not None and device.deformation_scale == pytest.approx(6.5 / np.hypot(4.8, 3.2))
    more = {"damper_deformation": 0.03, "damper_velocity": 0.2, "core_strain": 0.006}
    histories = {"damped.MCE.0": shaken(names, (350e3, 300e3), (340e3, 300e3), **more)}
    for group in histories.values():
        group.add("cumulative_ductility_final", ("damper",), [40.0, 40.0], "1", "")
    sets, factors = history_sets(histories), DeviceFactors("", **FACTORS.model_dump())
    demands = demands_of(made.devices, sets[0], frames_of(made), histories.__getitem__)
    ratio = factored_ratio(device, demands["damper_deformation"], demands["velocity"], factors, RULES)
    sized = design(
        "hysteretic",
        device_core_area=1e-3,
        device_yield_force=262e3,
        device_stiffness=device.restrained.stiffness,
        device_yield_deformation=device.restrained.yield_deformation,
        device_adjusted_tension=device.restrained.adjusted_tension,
        device_adjusted_compression=device.restrained.adjusted_compression,
    )
    raised = RaisedDevices(factors, DeviceLaw(device.values), "Factors.")
    order, _ = devices_tables(sized, sets, {"damped": 1.0}, RULES, raised)
    assert ratio > 1.0 and column(order, "force [kN]") == pytest.approx([350.0 * ratio], abs=0.05)
    of_law = RaisedDevices(factors, DeviceLaw(LawValues("elastic_plastic", (1e8, 2e5, 0.02))))
    assert of_law.ratio(sized, 0, {"stroke": 0.02}) == pytest.approx(244.0 / 236.0)


def test_braces_of_a_design_have_the_factor_of_their_histories() -> None:
    """Estimated 1.02 at a small stroke; of histories at 20 mm 1.1 x 244 / 236: N_Ed = 0.8 x 1.1373 x 230 kN."""
    sized = design(
        "hysteretic", brace_share=0.8, brace_force_factor=1.02, brace_resistance=1e6, device_yield_force=200e3
    )
    sized.attributes["brace_overstrength"] = 1.1
    group = shaken(["a", "b"], (230e3, 210e3), (200e3, 200e3), damper_deformation=0.020)
    group.add("damper_work_final", ("damper",), [1e4, 1e4], "J", "")
    (found,) = history_sets({"damped.MCE.0": group})
    law = DeviceLaw(LawValues("elastic_plastic", (100e6, 200e3, 0.02)))
    raised = RaisedDevices(DeviceFactors("", stroke=1.2, velocity=1.5, overstrength=1.1), law)
    force = brace_forces(sized, found, RULES, raised)
    assert force == pytest.approx([0.8 * 1.1 * 244.0 / 236.0 * 230e3], rel=1e-6)
    assert brace_forces(sized, found, RULES) == pytest.approx([0.8 * 1.02 * 230e3])  # what the law is, is not known


def test_dampers_of_elastomer_to_order() -> None:
    """k = 1 kN/mm, c = 0.1 kN s/mm of layers of 60 mm, ordered with 120 mm: 40 mm are 20 mm, 0.4 m/s are 0.2 m/s there.

    By hand F = |k u + i c v|: sqrt(24^2 + 30^2) / sqrt(20^2 + 20^2) at 1.2 u and 1.5 v, times 100 kN.
    """
    law = DeviceLaw(LawValues("kelvin_voigt", (1e6, 1e5)), 2, 0.1, 0.060)
    raised = RaisedDevices(DeviceFactors("", stroke=1.2, velocity=1.5, overstrength=1.1), law, "Factors.")
    sized = design("strain_energy", layer_area=0.15, estimated_damper_force=90e3, estimated_damper_strain=0.3)
    of_layers = {"layer_thickness_m": 0.12, "layers": 2, "frequency_Hz": 1.5, "strain": 0.3}
    sized.attributes |= {**of_layers, "G_storage_Pa": 1e6, "loss_factor": 0.35}
    sets = history_sets(
        {"damped.MCE.0": shaken(["a", "b"], (100e3, 80e3), (90e3,) * 2, damper_deformation=0.040, damper_velocity=0.4)}
    )
    order, largest = devices_tables(sized, sets, {"damped": 1.0}, RULES, raised)
    (row,) = order.texts
    assert row[:5] == ["1", "2", "2", "0.1500", "120.0"]
    force = 100.0 * np.hypot(24.0, 30.0) / np.hypot(20.0, 20.0)
    assert column(order, "force [kN]") == pytest.approx([force], rel=1e-3)  # the peak lies between points of the cycle
    assert column(order, "stroke [mm]") == [48.0] and column(order, "velocity [m/s]") == pytest.approx([0.6])
    assert column(order, "strain [%]") == pytest.approx([1.2 * 100.0 * 40.0 / 120.0])
    assert column(largest, "mean velocity [m/s]") == pytest.approx([2 * np.pi * 1.5 * 0.3 * 0.12, 0.4], abs=1e-4)
    unread, _ = devices_tables(sized, sets, {"damped": 1.0}, RULES, RaisedDevices(raised.factors, None, "Factors."))
    assert "force [kN]" not in unread.headers  # without the law none with factors is known
