"""What responses mean: measures, statistics over records, performance levels, criteria, fragility.

It takes results as plain groups of an archive and knows neither files nor figures. `study` judges designs by it,
and `report` its tables.
"""
