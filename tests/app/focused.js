// Of what has the focus: its ring, and how much of it is cut (pixels), and by what.
() => {
  let on = document.activeElement
  while (on?.shadowRoot?.activeElement) on = on.shadowRoot.activeElement
  if (on === document.body) return null
  const name = `${on.tagName.toLowerCase()} ${on.type ?? ""} ${(on.ariaLabel || on.labels?.[0]?.textContent || on.title || on.textContent || on.className).trim().slice(0, 40)}`
  const style = getComputedStyle(on), box = on.getBoundingClientRect()
  const wide = style.outlineStyle === "none" ? 0 : parseFloat(style.outlineWidth), reach = wide + parseFloat(style.outlineOffset)
  const ring = { left: box.left - reach, top: box.top - reach, right: box.right + reach, bottom: box.bottom + reach }
  let [cut, by] = [0, ""]
  const within = (edges, who) => {
    const most = Math.max(edges.left - ring.left, edges.top - ring.top, ring.right - edges.right, ring.bottom - edges.bottom)
    if (most > cut) [cut, by] = [most, who]
  }
  within({ left: 0, top: 0, right: innerWidth, bottom: innerHeight }, "window")
  for (let up = on.assignedSlot ?? on.parentElement ?? on.getRootNode().host; up; up = up.assignedSlot ?? up.parentElement ?? up.getRootNode().host) {
    const { overflowX, overflowY, display, borderLeftWidth: edge } = getComputedStyle(up)
    if (display === "contents" || up === document.documentElement || up === document.body) continue
    const r = up.getBoundingClientRect(), b = parseFloat(edge), far = 1e6
    const x = overflowX !== "visible", y = overflowY !== "visible"
    within({ left: x ? r.left + b : -far, right: x ? r.right - b : far, top: y ? r.top + b : -far, bottom: y ? r.bottom - b : far }, `${up.tagName.toLowerCase()}.${up.className}`)
    if (getComputedStyle(up).position === "fixed") break
  }
  return { name, wide, colour: style.outlineColor, cut: Math.round(10 * cut) / 10, by }
}
