"""Records and spectra as tables and figures: origin, fit to the spectrum, criteria of the code.

Called by `edesign spectrum`, `edesign match`, summaries and the page.
"""
