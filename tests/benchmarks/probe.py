"""A page of its own, served beside the explorer: says how many Documents are alive besides its own."""

import gc

import panel as pn
from bokeh.document import Document

gc.collect()
alive = [each for each in gc.get_objects() if isinstance(each, Document) and each.session_context]
print(f"live Documents: {len(alive) - 1}", flush=True)
pn.pane.Str("counted").servable()
