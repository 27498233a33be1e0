"""The report on paper: the page of a report laid out as a PDF."""
