"""Archives as a whole: the tables, figures, sections of the report and plain data of each kind (`kinds.py`).

A file for each kind: `project.py`, `study.py`, `building.py`, `substructure.py`.
"""
