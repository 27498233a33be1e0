"""A university laboratory with old equipment. See summary.md."""
