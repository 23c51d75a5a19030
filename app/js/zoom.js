// What is zoomed into is drawn on the canvas that clips; all of a plot on the one above, which is quicker.
const { x_range, y_range, renderers } = cb_obj.origin
const part = [x_range, y_range].some(({ start, end, reset_start, reset_end }) => start !== reset_start || end !== reset_end)
for (const each of renderers) each.setv({ level: part ? "glyph" : "overlay" }, { sync: false })
