"""Carrying out a plan: order, calls, back ends, progress, interruption, and going on where a run stopped.

`run.py` is behind `edesign run`, `match.py` behind `edesign match`; `building.py` runs a building. `study_designs.py`
makes the designs of a study, `incremental.py` the histories of its incremental studies.
"""
