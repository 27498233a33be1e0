"""Residuals of a campaign read: noise, lag, harmonics, maps over what the error may depend on, its shape.

The verdict says it in words (`shape.py`), and the report draws it.
"""
