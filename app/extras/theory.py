"""Links from equations and sections in texts to the page of the theory."""

import re

from ..extra import Extra


def linked(html):
    """A text with links from equations, (11), and sections, § 9, to the theory."""
    led = r'<a href="?theory={}-\1" target="theory">\g<0></a>'
    text = re.sub(r"\(([1-9]\d?)\)", led.format("eq"), html)
    return re.sub(r"§ (\d+)", led.format("section"), text)


EXTRA = Extra("theory", linked=linked)
