"""What all figures share: style, axes, captions and names of files, the drawing of a frame.

Called by every module that draws.
"""
