"""The page for a measurement, `/app?fit`, from a file to the number to quote.

`page` has the actions (`actions`), `form` and `results` the two columns, `query` the link. `choices` has
tips, samples and numbers. `analysis` reads and fits in a process. `texts`, `plots`, `export` show and save.
"""
