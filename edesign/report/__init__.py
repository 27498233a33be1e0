"""What people see: tables, figures and pages of archives, calibrations and tests.

A room for each subject; `archive` has all tables, figures and the report of an archive. The commands (`cli`) call it,
and nothing else does.
"""
