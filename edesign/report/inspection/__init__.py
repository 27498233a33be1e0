"""What a table of numbers is read as: its account, and the YAML that reads it."""
