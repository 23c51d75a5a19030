// Tooltip of a spring: its place, its compression and its load, each with its limit.
const told = Object.assign(document.createElement("div"), { className: "told", hidden: true })
told.setAttribute("role", "status")
document.body.append(told)
const el = toolkit.element(figure), STATES = ["free", "elastic", "yielded", "stretched", "sticks", "slips"], VERTICES = 9
const row = (name) => {
  for (const { data_source: { data } } of figure.renderers) {
    const k = data.row?.indexOf(name) ?? -1
    if (k >= 0 && data.xs) return [data.xs[k], data.ys[k]]
  }
  return [[], []]
}
// End of a spring without load: at the imprint, else at the surface.
const rest = (x) => {
  const [xs, ys] = row("residual imprint"), k = Array.from(xs).findIndex((each) => each >= x)
  return k > 0 ? ys[k - 1] + (ys[k] - ys[k - 1]) * (x - xs[k - 1]) / (xs[k] - xs[k - 1]) || 0 : 0
}
const nearest = (x) => {
  let found = null
  for (const state of STATES) {
    const [xs, ys] = row(state)
    for (let k = 0; k + VERTICES <= xs.length; k += VERTICES) {
      const away = Math.abs(xs[k] - x)
      if (!found || away < found.away) found = { state, away, x: xs[k], top: ys[k + 7] }
    }
  }
  return found
}
const digits = (value) => String(Number(value.toPrecision(3))).replace("-", "−")
const sentence = ({ state, x, top }) => {
  const { unit, load, load_unit, caps, cap, named } = pointed.springs
  const u = state === "free" ? 0 : rest(x) - top, limit = caps.length ? caps[Math.min(player.value, caps.length - 1)] : null
  const beside = (value) => limit === null ? "" : ` of at most ${digits(value)}`
  // The plastic part stays after unloading.
  const imprint = -rest(x), plastic = imprint > 0 ? `<br>plastic part ${digits(imprint)} ${unit}` : ""
  return `<b>${state} spring</b> at <i>x</i> = ${digits(x)} ${unit}<br>elastic part <i>u</i> = ${digits(u)}${beside(limit)} ${unit}${limit === null ? "" : ` = ${cap}`}${plastic}
    <br>${named} = ${digits(u * load)}${beside(limit * load)} ${load_unit}`
}
el?.addEventListener("pointermove", (event) => {
  const { clientX: x, clientY: y } = event, frame = toolkit.frame(figure)
  const inside = frame && x > frame.left && x < frame.right && y > frame.top && y < frame.bottom
  const found = inside && !event.buttons && nearest(frame.x.invert(x))
  // No tooltip on the indenter above the springs, which the user drags.
  told.hidden = !found || frame.y.invert(y) > Math.max(found.top, 0)
  if (told.hidden) return
  told.innerHTML = sentence(found)
  Object.assign(told.style, { left: `${Math.min(x + 14, innerWidth - 250)}px`, top: `${y + 14}px` })
})
el?.addEventListener("pointerleave", () => { told.hidden = true })
el?.addEventListener("pointerdown", () => { told.hidden = true }, true)
