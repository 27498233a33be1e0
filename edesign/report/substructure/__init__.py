"""Tables and figures of substructure tests."""
