"""One analysis of a frame: gravity, modes, pushover, history; and what belongs to it, from footings to collapse.

Called by `study.run` for each line of the plan, and by designs.
"""
