"""The structure in the computer: its matrices and its integration."""
