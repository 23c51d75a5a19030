"""Configuration of the documentation; the README has the command that builds it."""

import os
import sys
from pathlib import Path

from docutils import nodes
from latex2mathml.converter import convert
from sphinx import addnodes

import mdr_core
from app.explorer.extras.scene_file import scene_file
from app.explorer.page import Page
from mdr_core.base.remark import KINDS
from mdr_explorer import static

sys.path.insert(0, str(Path(__file__).parent))

project = "mdr-core"
author = "The mdr-core authors"
copyright = author
release = version = mdr_core.__version__

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "numpydoc",
    "sphinx_gallery.gen_gallery",
    "names",
    "thumbnails",
]
exclude_patterns = ["examples"]
html_theme = "pydata_sphinx_theme"
html_theme_options = {
    "show_prev_next": False,
    "header_links_before_dropdown": 5,
    "logo": {"text": f"{project} {version}"},
}
html_static_path = ["static"]
html_css_files = ["site.css"]
html_context = {"default_mode": "auto"}
html_sidebars = {"index": [], "install": [], "**": ["sidebar-nav-bs"]}
html_title = project
html_show_sourcelink = False
html_math_renderer = "mathml"

myst_enable_extensions = ["dollarmath", "substitution"]
# The one list of kinds is in the code.
_KINDS = "\n".join(f"| {kind} | {says} |" for kind, says in KINDS.items())
myst_substitutions = {"kinds_of_remarks": f"| kind | says |\n| --- | --- |\n{_KINDS}"}
myst_fence_as_directive = ["math"]
myst_heading_anchors = 3

default_role = "autolink"
autodoc_default_options = {"members": True, "show-inheritance": True}
autodoc_member_order = "bysource"
autodoc_typehints = "none"
autosummary_generate = False
numpydoc_show_class_members = False

sphinx_gallery_conf = {
    "examples_dirs": "examples",
    "gallery_dirs": "gallery",
    "filename_pattern": r"\.py$",
    "within_subsection_order": "FileNameSortKey",
    "show_signature": False,
    "capture_repr": (),
    "image_scrapers": ("thumbnails.scraper",),
    "min_reported_time": float("inf"),
    "write_computation_times": False,
    "abort_on_example_error": True,
}


def mathml(writer, node):
    """Write a formula as MathML, which browsers show without a script or a network."""
    display = "block" if isinstance(node, nodes.math_block) else "inline"
    writer.body.append(convert(node.astext(), display=display))
    raise nodes.SkipNode


#: Pages of files that the README links: texts by their path in the tree, a script by
#: its path in this folder.
PAGES = {
    "assets/theory.md": "theory",
    "assets/accuracy.md": "accuracy",
    "assets/benchmarks.md": "speed",
    "examples/first_hour.py": "gallery/first_hour",
    "CONTRIBUTING.md": "contributing",
    "CHANGELOG.md": "changelog",
}


def drop_download_notes(app, doctree):
    """Remove the box on top of each example, a link to the end of a short page."""
    for note in list(doctree.findall(nodes.note)):
        if "sphx-glr-download-link-note" in note["classes"]:
            note.parent.remove(note)


def link_pages(app, doctree):
    """Replace links to files of the tree by links to their pages."""
    for link in doctree.findall(addnodes.pending_xref):
        file, _, anchor = link["reftarget"].partition("#")
        if file in PAGES:
            link.update_all_atts(
                {"refdomain": "doc", "reftarget": PAGES[file], "reftargetid": anchor},
                replace=True,
            )
    # A script of the gallery would be a file to download.
    for link in list(doctree.findall(addnodes.download_reference)):
        page = PAGES.get(link["reftarget"])
        if page:
            told = {
                "refdomain": "std",
                "reftype": "doc",
                "reftarget": f"/{page}",
                "refexplicit": True,
            }
            link.replace_self(
                addnodes.pending_xref("", *link.children, refdoc=link["refdoc"], **told)
            )


def save_scene(app, error):
    """Write the scene of the first page."""
    Path(app.outdir, "scene.html").write_text(scene_file(Page().view), encoding="utf-8")


def write_explorer(app, error):
    """Write the explorer that runs in the browser with `-t explorer`; it is large."""
    if app.tags.has("explorer") and error is None:
        static.write(Path(app.outdir, "explorer"), os.environ.get("MDR_PYODIDE", ""))


def setup(app):
    app.add_html_math_renderer("mathml", (mathml, None), (mathml, None))
    app.connect("doctree-read", link_pages)
    app.connect("doctree-read", drop_download_notes)
    app.connect("build-finished", save_scene)
    app.connect("build-finished", write_explorer)
