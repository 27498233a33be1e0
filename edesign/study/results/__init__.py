"""What analyses record, and the groups of the archive that come of it.

`study.analysis` and `study.design` write by it; names, units and meanings of the quantities stand here. So do the
warnings of an analysis, the validity of its results, and their provenance.
"""
