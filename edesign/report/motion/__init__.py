"""The motion of frames over time as the report shows it: what moves, read from the archive, packed, and one still."""
