"""Designs of dampers: rounds, sizes over the height, placements, devices to order, isolated bases.

Called by the summary of a study and by the section of designs of the page.
"""
