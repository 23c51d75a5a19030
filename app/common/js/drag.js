// A drag takes the indenter along, or the mark on the curve: to another depth when pressing, else to the nearest state.
const figure = cb_obj.origin, { name, x_range: x, y_range: y, inner_height } = figure
// A box that is drawn to zoom is no drag.
if (figure.toolbar.tools.some(({ type, active }) => type === "BoxZoomTool" && active)) return
const { d, F, unit, pressing } = JSON.parse(dragging.path), wide = (range) => range.end - range.start
const [begin, depth, pixel] = cb_obj.event_name === "panstart" ? [cb_obj.sy, d[player.value] * unit, wide(y) / inner_height] : figure.tags
figure.setv({ tags: [begin, depth, pixel] }, { sync: false })
const wish = Math.max(depth + (cb_obj.sy - begin) * pixel, 1e-3 * wide(y))
const end = cb_obj.event_name === "panend"
// Without a hold the finger scrolls the page, or the browser has cancelled the drag and its place is none.
if (!figure.held && !end) return
if (name === "springs" && pressing) {
  // One request at a time: the server empties it once it has drawn.
  if (figure.held && (end || dragging.depth === null)) dragging.depth = wish
} else if (end) player.rest()
else {
  const near = name === "springs" ? (k) => Math.abs(d[k] * unit - wish) / wide(y)
    : (k) => Math.hypot((d[k] - cb_obj.x) / wide(x), (F[k] - cb_obj.y) / wide(y))
  const away = d.map((_, k) => near(k) + 1e-4 * Math.abs(k - player.value))
  player.go(away.indexOf(Math.min(...away)))
}
