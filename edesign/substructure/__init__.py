"""Virtual real-time substructure tests: a damper in the laboratory, the structure in the computer."""
