"""Tables of an archive as workbooks, CSV and Parquet files, and data frames."""
