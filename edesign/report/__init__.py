"""What people see: tables, figures and pages of archives, calibrations and tests.

A room for each subject. Below these stand what tables, figures and pages are made of (`tables`, `drawing`, `html`) and
what reads an archive (`archived.py`, `archive_view.py`); above them the sections of reports (`page`), what each kind of
archive has of all this (`archive`), and PDF and export. The commands (`cli`) call it, and nothing else does.
"""
