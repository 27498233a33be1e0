"""Studies and their runs: variants of a frame, designs of their dampers, the plan of analyses, and its execution.

`run.run` is behind `edesign run`, `check.summary` behind `edesign check`; `building.py` runs a building, and
`variants.py` puts the dampers of a variant into the frame.
"""
