"""Thumbnails of the gallery: one panel of a figure, drawn again for its small size."""

import pickle
from pathlib import Path

import matplotlib.pyplot as plt
from matplotlib.gridspec import GridSpec
from matplotlib.ticker import NullFormatter
from sphinx_gallery.scrapers import matplotlib_scraper

#: Number of the figure and of the panel in it; the first ones of other examples.
PANELS = {"00_the_idea": (0, 1), "first_hour": (1, 0)}
#: Size (inches) and resolution of a thumbnail; 400 × 280 pixels.
_SIZE, _DPI = (2.9, 2.03), 138


def scraper(block, block_vars, gallery_conf):
    """Run the scraper of sphinx-gallery, and draw the panel of the thumbnail."""
    image = Path(str(block_vars["image_path_iterator"].image_path))
    file = image.parent / "panels" / f"{Path(block_vars['src_file']).stem}.png"
    wanted, panel = PANELS.get(file.stem, (0, 0))
    drawn = len(block_vars["image_path_iterator"])
    numbers = plt.get_fignums()
    if drawn <= wanted < drawn + len(numbers):
        file.parent.mkdir(parents=True, exist_ok=True)
        _draw(plt.figure(numbers[wanted - drawn]), panel, file)
    return matplotlib_scraper(block, block_vars, gallery_conf)


def _draw(figure, panel, file):
    """Save a panel of a copy of a figure, without the others and without its legend."""
    copy = pickle.loads(pickle.dumps(figure))
    axes = copy.axes[panel]
    below = axes.get_shared_x_axes().get_siblings(axes)
    label = axes.get_xlabel() or next(
        (each.get_xlabel() for each in below if each.get_xlabel()), ""
    )
    for other in copy.axes:
        if other is not axes:
            other.remove()
    copy.set_layout_engine("constrained")
    copy.set_size_inches(*_SIZE)
    axes.set_subplotspec(GridSpec(1, 1, figure=copy)[0])
    axes.set_xlabel(label)
    height = axes.get_ylabel().partition(",")[0]
    axes.set_ylabel(height, fontsize=10 if len(height) < 22 else 7.5)
    axes.xaxis.set_minor_formatter(NullFormatter())
    axes.tick_params(labelbottom=bool(label), labelleft=bool(height))
    axes.set_title("")
    if legend := axes.get_legend():
        legend.remove()
    copy.savefig(file, dpi=_DPI)
    plt.close(copy)


def _use_panels(app):
    """Replace sphinx-gallery's thumbnails by the panels."""
    for panel in Path(app.srcdir, "gallery").rglob("panels/*.png"):
        thumbnail = panel.parents[1] / "thumb" / f"sphx_glr_{panel.stem}_thumb.png"
        thumbnail.write_bytes(panel.read_bytes())


def setup(app):
    # After the gallery is made, at the usual priority of 500.
    app.connect("builder-inited", _use_panels, priority=900)
    return {"parallel_read_safe": True}
