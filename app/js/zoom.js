// What is zoomed into is drawn on the canvas that clips; all of a plot on the one above, which is quicker.
const part = [figure.x_range, figure.y_range].some(({ start, end, reset_start, reset_end }) => start !== reset_start || end !== reset_end)
for (const each of figure.renderers) each.setv({ level: part ? "glyph" : "overlay" }, { sync: false })
