"""Residuals of a campaign read: noise, cycles, what the error depends on, its shape.

The verdict says it in words (`shape.py`), and the report draws it.
"""
