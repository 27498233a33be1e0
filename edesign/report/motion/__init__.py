"""The motion of frames and buildings over time as the report shows it: what moves, as read, packed, and one still."""
