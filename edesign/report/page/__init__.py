"""The report of an archive as one HTML page that needs nothing beside it."""
