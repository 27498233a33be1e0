"""What went into a study, as tables: assumptions, variants, masses, parameters of laws, and the damper schedule.

`variant_frames.py` builds the frames again from the texts of an archive. Called by sections of the page.
"""
