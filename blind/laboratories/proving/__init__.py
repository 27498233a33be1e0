"""The proving ground of a manufacturer of dampers. See summary.md."""
