from . import closed_forms as closed_forms  # registers the closed forms of the shapes
