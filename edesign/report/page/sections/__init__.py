"""The sections of the page, each made from an archive, or nothing where it holds nothing for it."""
