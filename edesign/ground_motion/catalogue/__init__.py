"""Candidates out of which records are chosen: what lies in folders, packages and suites, and what is known of it."""
