"""What an archive is of, by its attribute `kind`, which that of a project does not have, and its groups."""

STUDY = "study"
BUILDING = "building"
SUBSTRUCTURE = "substructure"

ANALYSES, DESIGNS, INCREMENTAL, RECORDS, HAZARD = "analyses", "designs", "incremental", "records", "hazard"
"""Groups of an archive: analyses, designs of dampers, incremental studies, records and suites, the seismic action."""
HAZARD_LEVELS = f"{HAZARD}/levels"
"""Below it a group for each level, apart from the variables of the action, whose names a level may have."""

DIRECT = "direct analysis"
"""In the place of a variant, or of the compensator of a substructure test: the structure without laboratory."""
