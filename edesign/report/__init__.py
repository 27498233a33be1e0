"""What people see: tables, figures and pages of archives, calibrations and tests.

A room for each subject; `summary.py` gives an archive as plain data, `archive_tables.py` and `archive_figures.py`
all tables and figures of one. The commands (`cli`) call it, and nothing else does.
"""
