"""Pages as data, and how they and their figures are written as HTML."""
