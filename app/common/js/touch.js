// A finger drags a plot by its mark alone, within 24 pixels of it; elsewhere it scrolls the page. A mouse drags anywhere.
window.dragging = dragging
for (const figure of figures) {
  const at_mark = ({ clientX, clientY }) => {
    const frame = toolkit.frame(figure)
    const away = (x, y) => Math.hypot(clientX - frame.x.compute(x), clientY - frame.y.compute(y))
    return frame && figure.renderers.some(({ data_source: { data } }) => data.row?.some(
      (row, k) => ["handle", "now"].includes(row) && away(data.x[k], data.y[k]) < 24))
  }
  const el = toolkit.element(figure)
  el?.addEventListener("pointerdown", (event) => { figure.held = event.pointerType === "mouse" || at_mark(event) }, true)
  el?.addEventListener("pointercancel", () => { figure.held = false }, true)
  el?.addEventListener("touchstart", (event) => figure.held && event.preventDefault(), { passive: false })
}
