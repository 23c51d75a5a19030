// Light or dark, for all that the sheet colours.
document.documentElement.classList.toggle("dark", cb_obj.tags[0])
