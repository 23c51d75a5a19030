"""Files of instruments: units, tables as text, workbooks, AFM files, and what a column is."""
