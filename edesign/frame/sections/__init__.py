"""Cross sections of members: the catalogue of rolled sections, hollow sections, plates; their fibres and classes.

`data` holds the tables of rolled sections.
"""
