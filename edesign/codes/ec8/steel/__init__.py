"""Steel buildings of EN 1998-1:2004, chapter 6: behaviour factors, moment frames, braced frames."""
