"""What commands share: options, progress, completions, standard streams."""
