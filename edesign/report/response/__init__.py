"""Responses of frames: histories, profiles, hinges, braces, loops of dampers, energy.

Called by the sections of the page, and by `edesign show --figures` for single figures.
"""
