"""Archives as a whole: their tables, figures, summary and report."""
