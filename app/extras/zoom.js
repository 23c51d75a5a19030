// A box that is drawn with Shift is zoomed to; a double click shows the whole plot again.
const band = Object.assign(document.createElement("div"), { className: "band", hidden: true })
document.body.append(band)
let from = null
const plot = (event) => {
  const figures = [...zoom.document.all_models].filter(({ type, name }) => type === "Figure" && name)
  return figures.map((figure) => [figure, Bokeh.index.find_one(figure)]).find(([, view]) => view && event.composedPath().includes(view.el))
}
const ask = (name, box) => { zoom.asked = [name, box, (zoom.asked[2] ?? 0) + 1] }
const corners = ({ clientX, clientY }) => [[from.x, clientX].sort((a, b) => a - b), [from.y, clientY].sort((a, b) => a - b)]
document.addEventListener("pointerdown", (event) => {
  const found = event.shiftKey && event.button === 0 && plot(event)
  if (!found) return
  // Bokeh does not hear of it, and drags nothing.
  event.stopPropagation()
  event.preventDefault()
  from = { x: event.clientX, y: event.clientY, found }
}, true)
document.addEventListener("pointermove", (event) => {
  if (!from) return
  event.stopPropagation()
  const [[left, right], [top, bottom]] = corners(event)
  band.hidden = false
  Object.assign(band.style, { left: `${left}px`, top: `${top}px`, width: `${right - left}px`, height: `${bottom - top}px` })
}, true)
document.addEventListener("pointerup", (event) => {
  if (!from) return
  event.stopPropagation()
  const [[left, right], [top, bottom]] = corners(event), [figure, { el, frame }] = from.found
  const { left: x, top: y } = el.getBoundingClientRect(), { bbox } = frame
  band.hidden = true
  from = null
  const within = (value, low, high) => Math.min(Math.max(value, low), high)
  const across = [left - x, right - x].map((place) => within(place, bbox.left, bbox.right))
  const up = [bottom - y, top - y].map((place) => within(place, bbox.top, bbox.bottom))
  // A click is no box.
  if (across[1] - across[0] < 8 || up[0] - up[1] < 8) return
  const right_scale = frame.y_scales.get("right")
  const scales = [[frame.x_scale, across], [frame.y_scale, up], ...(right_scale ? [[right_scale, up]] : [])]
  ask(figure.name, scales.map(([scale, places]) => places.map((place) => scale.invert(place))))
}, true)
document.addEventListener("pointercancel", () => { band.hidden = !(from = null) }, true)
document.addEventListener("dblclick", (event) => {
  const found = plot(event)
  if (found) ask(found[0].name, null)
})
