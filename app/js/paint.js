// In the next frame: all that an answer has drawn, or a whole figure whose title Bokeh may have painted before it was made.
const paint = (figure) => (cb_obj.axis_label ? figure.change.emit() : Bokeh.index.find_one(figure)?.repaint())
requestAnimationFrame(() => figures.forEach(paint))
