"""Buildings as linear elastic space frames: geometry and loads, response spectrum analysis, design checks."""
