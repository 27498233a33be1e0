"""What `edesign check` says of files that are no project, study, building or substructure test: a summary by labels."""
