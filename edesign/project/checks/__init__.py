"""Cross checks that need a whole project, one file a subject: names exist, places are there, keys go together."""
