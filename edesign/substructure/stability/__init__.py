"""Stability of a substructure test and the error it leaves in the response, from transfer functions."""
