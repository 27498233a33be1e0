"""What an archive is of, by its attribute `kind`; that of a project has none."""

STUDY = "study"
BUILDING = "building"
SUBSTRUCTURE = "substructure"
