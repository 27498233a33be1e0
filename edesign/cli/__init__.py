"""The command line: a file for each command of `edesign`, which reads options, calls the package below, and prints.

`main.py` gathers the commands. Nothing is computed here.
"""
