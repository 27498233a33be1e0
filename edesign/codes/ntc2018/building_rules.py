"""The rules of NTC 2018 for the elastic design of a steel building: chapters 2.5, 7.2, 7.3 and 7.5."""

from __future__ import annotations

from edesign.codes.building_rules import BuildingRules
from edesign.codes.ec8.analysis.regularity import NTC_2018
from edesign.codes.ntc2018.behaviour_factor import largest_section_class, limit_of_q
from edesign.codes.ntc2018.capacity import BASE_AXIAL_LIMIT, FOUNDATIONS, HOLLOW_BRACES
from edesign.codes.ntc2018.parameters import TITLE
from edesign.codes.ntc2018.regularity import setbacks
from edesign.codes.ntc2018.vertical import vertical_component_counts

RULES = BuildingRules(
    code="ntc-2018",
    title=TITLE,
    ductility={"low": "non dissipative", "medium": 'CD"B"', "high": 'CD"A"'},
    largest_q=limit_of_q,
    section_class=largest_section_class,
    modal_mass=0.85,
    every_large_mode=True,
    setbacks=setbacks,
    vertical=vertical_component_counts,
    changes=NTC_2018,
    gravity_apart=True,
    foundations=FOUNDATIONS,
    base_axial=BASE_AXIAL_LIMIT,
    hollow_braces=HOLLOW_BRACES,
    clauses={
        "3.2.2.5(4)P": "3.2.3.5",
        "4.2.3.1(7)": "7.3.1",
        "4.2.3.2(3)": "7.2.1 a",
        "4.2.3.2(5)": "7.2.1 b",
        "4.2.3.2(4)": "7.2.1 c",
        "4.2.3.3(2)": "7.2.1 d",
        "4.2.3.3(3)": "7.2.1 e",
        "4.2.3.3(5)": "7.2.1 g",
        "4.3.2": "7.2.6",
        "4.3.2(1)P": "7.2.6",
        "4.3.3.2.2": "7.3.3.2",
        "4.3.3.3.1(3)": "7.3.3.1",
        "4.3.3.3.2": "7.3.3.1",
        "4.3.3.3.3": "7.2.6",
        "4.3.3.5.1(3)": "7.3.5",
        "4.3.3.5.2": "7.2.2",
        "4.3.4": "7.3.3.3",
        "4.3.4(3)": "7.3.3.3",
        "4.4.2.2(3)": "7.3.1",
        "4.4.2.3(4)": "7.5.4.2",
        "4.4.2.6(4)": "7.2.5",
        "4.4.2.6(5)": "7.2.5",
        "4.4.3.2(1)": "7.3.6.1",
        "6.3.2(1)": "7.3.1",
        "6.5.3(2)": "7.5.3.2",
        "6.5.5": "7.5.3.1",
        "6.6.2(2)": "7.5.4.1",
        "6.6.3(1)P": "7.5.4.2",
        "6.6.3(4)": "7.5.4.2",
        "6.6.3(6)": "7.5.4.4",
        "6.6.4(3)": "7.5.4.3",
        "6.7.3(1)": "7.5.5",
        "6.7.3(2)": "7.5.5",
        "6.7.3(3)": "7.5.5",
        "6.7.3(4)": "7.5.5",
        "6.7.3(8)": "7.5.5",
        "6.7.4(1)": "7.5.5",
        "6.7.4(2)": "7.5.5",
        "6.8.2(4)": "7.5.6",
        "6.8.2(6)": "7.5.6",
        "6.8.2(7)": "7.5.6",
        "6.8.2(8)": "7.5.6",
        "6.8.2(10)": "7.5.6",
        "6.8.4(1)": "7.5.6",
    },
    equations={"6.10": "2.5.1", "6.12b": "2.5.5", "6.14b": "2.5.2"},
    words={
        "Limit of nu d_r/h": "Limit of q d_r/h with q = 1",
        "nu d_r/h": "q d_r/h",
        "EN 1990": TITLE,
        "gamma_Rd Omega": "the factor of the class",
        "Rules for the building, clauses of EN 1998-1 where no other code is named": "Rules for the building",
        "theta_q: with q d_e; factor": "d_r is mu_d d_e; theta_q: with q d_e; factor",
    },
)
