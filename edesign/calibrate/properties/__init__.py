"""The loop on a table of properties, such as those of Appendix A of the thesis, in place of measured histories.

`run.py` is called by `edesign calibrate` where a campaign names a table.
"""
