"""What an archive is of, by its attribute `kind`; that of a project has none."""

STUDY = "study"
BUILDING = "building"
SUBSTRUCTURE = "substructure"

DIRECT = "direct analysis"
"""In the place of a variant, or of the compensator of a substructure test: the structure without laboratory."""
