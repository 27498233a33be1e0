"""What a run is made of, before it starts: chosen records, frames of the variants, and the list of analyses.

`plan.py` lists the analyses of a project, `study_plan.py` those of a study; `check` checks a plan, `run` carries it
out.
"""
