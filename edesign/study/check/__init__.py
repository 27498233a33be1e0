"""What is checked before anything runs: errors, and warnings of what is allowed but may not be meant.

Called by `edesign check` and at the beginning of every run.
"""
