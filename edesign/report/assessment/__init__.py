"""Measures, statistics, verdicts and performance levels as tables, and figures over values that a study varies.

Called by the summary of a run, `edesign show` and the sections of the page.
"""
