"""Tests of dampers: campaigns that were measured, programmes of a virtual rig, loops, properties, and acceptance."""
