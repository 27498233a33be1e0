"""Ground motions in a project file: where they come from, how they are processed and chosen."""
