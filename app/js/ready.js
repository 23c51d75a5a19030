// Once the page is there: the keys Z and Escape, and the theme of the system.
const all = (root) => [...root.querySelectorAll("*")].flatMap((each) => [each, ...(each.shadowRoot ? all(each.shadowRoot) : [])])
document.documentElement.lang = "en"
// Dark or light: as a link asks, else as was chosen in this browser, else as the system is. A browser may refuse to keep it.
const kept = (act) => { try { return act() } catch { return null } }
const shade = () => document.documentElement.classList.toggle("dark", messages.dark)
shade()
const chosen = kept(() => localStorage.getItem("dark")), system = matchMedia("(prefers-color-scheme: dark)").matches
if (!new URLSearchParams(location.search).has("dark")) messages.dark = chosen === null ? system : chosen === "1"
shade()
messages.properties.dark.change.connect(() => {
  shade()
  kept(() => localStorage.setItem("dark", messages.dark ? "1" : "0"))
})
// The address says what is shown, without a step in the history.
messages.properties.address.change.connect(() => {
  if (messages.address) history.replaceState(null, "", messages.address)
})
document.addEventListener("keydown", (event) => {
  const on = event.composedPath()[0]
  if (event.ctrlKey || event.altKey || event.metaKey || on.matches?.("input[type=text], textarea, select")) return
  if (event.key === "Escape") {
    const open = all(document).filter((each) => each.matches("[popover='']:popover-open, [data-key=escape][aria-pressed=true], .help[aria-expanded=true]"))
    // The browser closes popovers.
    return void (open.some(({ popover }) => popover) || open.at(-1)?.click())
  }
  if (event.key.toLowerCase() === "z") all(document).find((each) => each.matches("button[data-key=z]"))?.click()
})
// Bokeh does not see that a plot has become a few pixels less high, as by a note that is opened.
let before = null
new ResizeObserver(([{ contentRect: { height } }]) => {
  const figures = [...messages.document.all_models].filter(({ type }) => type === "Figure")
  if (before !== null) for (const figure of figures) Bokeh.index.find_one(figure)?.invalidate_layout?.()
  before = height
}).observe(all(document).find((each) => each.shadowRoot && each.classList.contains("plots")))
