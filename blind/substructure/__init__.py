"""Blind campaigns of virtual substructure tests: the displacement is the target, and the specimen follows it late."""
