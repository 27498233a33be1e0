"""How values are written in YAML files: with units, as selections, as names and places."""
