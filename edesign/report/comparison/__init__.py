"""An archive beside reference values, cell by cell: what `edesign compare` prints and writes."""
