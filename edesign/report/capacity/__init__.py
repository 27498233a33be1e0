"""Pushovers and incremental dynamic analyses: capacity curves, target displacements, fragilities.

Called by the summary of a run and by the sections of the page.
"""
