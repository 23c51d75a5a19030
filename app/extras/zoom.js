// A box that is drawn with Shift is zoomed to; a double click shows the whole plot again.
const band = Object.assign(document.createElement("div"), { className: "band", hidden: true })
document.body.append(band)
let from = null
const plot = (event) => {
  const figures = toolkit.figures(zoom.document).filter(({ name }) => name)
  return figures.find((figure) => event.composedPath().includes(toolkit.element(figure) ?? null))
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
  const [[left, right], [top, bottom]] = corners(event), { found } = from, frame = toolkit.frame(found)
  band.hidden = true
  from = null
  if (!frame) return
  const within = (value, low, high) => Math.min(Math.max(value, low), high)
  const across = [left, right].map((place) => within(place, frame.left, frame.right))
  const up = [bottom, top].map((place) => within(place, frame.top, frame.bottom))
  // A click is no box.
  if (across[1] - across[0] < 8 || up[0] - up[1] < 8) return
  const scales = [[frame.x, across], [frame.y, up], ...(frame.y_right ? [[frame.y_right, up]] : [])]
  ask(found.name, scales.map(([scale, places]) => places.map((place) => scale.invert(place))))
}, true)
document.addEventListener("pointercancel", () => { band.hidden = !(from = null) }, true)
document.addEventListener("dblclick", (event) => {
  const found = plot(event)
  if (found) ask(found.name, null)
})
