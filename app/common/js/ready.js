// Once the page is there: the keys of undo and Escape, the theme, and the address.
const all = (root) => [...root.querySelectorAll("*")].flatMap((each) => [each, ...(each.shadowRoot ? all(each.shadowRoot) : [])])
// The server has drawn what a cookie told it, which a first visit has not.
if (!theme.asked) messages.dark = theme.own
theme.show(messages.dark)
messages.properties.dark.change.connect(() => theme.choose(messages.dark))
// The address says what is shown, without a step in the history.
messages.properties.address.change.connect(() => {
  // The opening scene has no query, and the address then no mark of one.
  if (messages.address) history.replaceState(null, "", messages.address === "?" ? location.pathname : messages.address)
})
document.addEventListener("keydown", (event) => {
  const on = event.composedPath()[0]
  // In a field they are those of what is typed; Escape takes back what was typed in a number, and closes what a field is in.
  const typing = on.matches?.("input[type=text], textarea") && (event.key !== "Escape" || on.closest(".number"))
  if (event.altKey || typing) return
  const key = event.key.toLowerCase(), act = (name) => all(document).find((each) => each.matches(`.act[name=${name}]:not([hidden])`))?.click()
  if (event.ctrlKey || event.metaKey) {
    const back = key === "z" && !event.shiftKey, forth = key === "y" || (key === "z" && event.shiftKey)
    if (!(back || forth)) return
    event.preventDefault()
    return void act(back ? "Undo" : "Redo")
  }
  if (on.matches?.("select")) return
  if (event.key === "Escape") {
    const open = all(document).filter((each) => each.matches("[popover='']:popover-open, [data-key=escape][aria-pressed=true], .help[aria-expanded=true]"))
    // The browser closes popovers. What lies over the plots stands first, and is closed before a large plot below it.
    return void (open.some(({ popover }) => popover) || open[0]?.click())
  }
  if (key === "z") act("Undo")
})
// Plots that have become a few pixels less high, as by a note that is opened, are drawn so.
let before = null
new ResizeObserver(([{ contentRect: { height } }]) => {
  if (before !== null) toolkit.figures(messages.document).forEach(toolkit.lay_out)
  before = height
}).observe(all(document).find((each) => each.shadowRoot && each.classList.contains("plots")))
