"""A plain page of Panel's, to compare the cost of opening with: three figures of four lines, 32 widgets."""

import numpy as np
import panel as pn
from bokeh.models import ColumnDataSource, HoverTool
from bokeh.plotting import figure

pn.extension(notifications=True)
x = np.linspace(0, 1, 200)


def plot():
    picture = figure(width=400, height=300, tools="pan,wheel_zoom,reset,save")
    picture.add_tools(HoverTool())
    for power in range(4):
        picture.line("x", "y", source=ColumnDataSource({"x": x, "y": x**power}))
    return pn.pane.Bokeh(picture)


numbers = [
    pn.Column(pn.widgets.FloatSlider(start=0, end=1, value=0.5), pn.widgets.TextInput(value="1"))
    for _ in range(10)
]
choices = [pn.widgets.Select(options=["a", "b", "c"]) for _ in range(6)]
buttons = [pn.widgets.Button(label=str(k)) for k in range(6)]
pn.Row(pn.Column(*numbers, *choices, *buttons), pn.Column(plot(), plot(), plot())).servable()
