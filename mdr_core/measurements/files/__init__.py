"""Files of instruments: units, tables as text, workbooks, AFM files, and the meaning of columns."""
