"""The page for a measurement, `/app?fit`: a file in, the number to quote out.

`page` has the actions (`actions`), `form` and `results` the two columns, `query` the link. `choices` has
tips, samples and numbers. `analysis` reads and fits in a process. `texts`, `plots`, `export` show and save.
"""
