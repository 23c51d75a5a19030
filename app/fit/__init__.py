"""The page for a measurement, `/app?fit`: a file in, the number to quote out.

`page` has the actions, `form` and `results` the two columns with their widgets, `choices` tips, samples and
numbers, `analysis` the jobs that read and fit in a process, `texts` and `export` what is shown and saved.
"""
