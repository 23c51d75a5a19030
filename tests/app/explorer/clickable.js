// All that can be clicked or focused and is seen, nothing opened: its kind and its name.
() => {
  const all = (root) => [...root.querySelectorAll("*")].flatMap((each) => [each, ...(each.shadowRoot ? all(each.shadowRoot) : [])])
  const listens = (each) => each.matches(`button, input, select, textarea, a[href], area[href], summary, iframe, audio, video, [contenteditable], [tabindex],
    [onclick], [role=button], [role=slider], [role=link], [role=tab], [role=radio], [role=checkbox], [role=option], [role=menuitem]`) || each.onclick !== null
  const points = (each) => getComputedStyle(each).cursor === "pointer" && getComputedStyle(each.parentElement ?? each).cursor !== "pointer"
  const seen = (each) => {
    const { left, top, right, bottom, width, height } = each.getBoundingClientRect()
    if (!(width > 0 && height > 0 && right > 0 && bottom > 0 && left < innerWidth && top < innerHeight)) return false
    // Also what is cut off by a part that scrolls.
    for (let up = each; up; up = up.assignedSlot ?? up.parentElement ?? up.getRootNode().host) {
      const { overflowX, overflowY } = getComputedStyle(up), box = up.getBoundingClientRect()
      if (up !== each && (overflowX !== "visible" || overflowY !== "visible") &&
          (box.bottom <= top || box.top >= bottom || box.right <= left || box.left >= right)) return false
    }
    return each.checkVisibility({ opacityProperty: true, visibilityProperty: true })
  }
  const name = (each) => `${each.tagName.toLowerCase()} ${each.type ?? ""} ${(each.ariaLabel || each.labels?.[0]?.textContent || each.textContent || each.className).trim().slice(0, 50)}`
  return all(document).filter((each) => seen(each) && (listens(each) || (points(each) && !each.matches("label, label *"))) && !each.disabled).map(name)
}
