// Bokeh makes the text of a label later, and a change of layout may paint the figure before.
setTimeout(() => figure.change.emit())
