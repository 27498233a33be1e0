"""Studies and their runs: motions, analyses, designs of dampers, the plan, its checks, and its execution.

The rooms from the bottom: `results`, `motions`, `analysis`, `design`, `placement`, `plan`, `check`, `run`; imports go
down only. `run.run` is behind `edesign run`, `check.summary` behind `edesign check`.
"""
