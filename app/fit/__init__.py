"""The page for a measurement, `/app?fit`: a file in, the number to quote out.

`setting` is what a person asks, `measurement` the curve and its fit, `worker` the process that reads and
fits, `words` and `files` what is said and saved of a fit, `plots` its figures, `source` the file of a page,
`form` and `results` its columns, and `page` the page.
"""
