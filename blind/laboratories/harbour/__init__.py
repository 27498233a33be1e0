"""A laboratory of a harbour, for rubber and building dampers. See summary.md."""
