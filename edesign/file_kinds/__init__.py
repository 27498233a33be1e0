"""Kinds of files: which there are, and of which one a file is."""
