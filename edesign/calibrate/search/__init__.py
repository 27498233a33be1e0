"""The search for effects: screening, forms side by side, pairs, look-alikes, and when to stop.

It knows effects and errors only, so dampers and structures share it; `loop.py` is the way in.
"""
