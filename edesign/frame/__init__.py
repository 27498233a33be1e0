"""From a project to the model of a plane frame: sections, members, masses, loads, supports, dampers in place.

`frame.py` is the way in; `study` calls it for every variant. `sections` holds the catalogue.
"""
