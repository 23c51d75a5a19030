// Once the page is there: the keys Z and Escape, and the theme of the system.
const all = (root) => [...root.querySelectorAll("*")].flatMap((each) => [each, ...(each.shadowRoot ? all(each.shadowRoot) : [])])
document.documentElement.lang = "en"
// What the page is coloured by, and what it is of the system if nobody has chosen.
const system = matchMedia("(prefers-color-scheme: dark)").matches
const shade = () => document.documentElement.classList.toggle("dark", messages.dark)
messages.properties.dark.change.connect(shade)
shade()
if (system && !location.search.includes("dark=")) messages.dark = true
// The address says what is shown, without a step in the history.
messages.properties.address.change.connect(() => {
  const light = system && !messages.dark ? "&dark=0" : ""
  if (messages.address) history.replaceState(null, "", messages.address + light)
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
  if (before !== null) for (const figure of figures) Bokeh.index.find_one(figure)?.invalidate_layout()
  before = height
}).observe(all(document).find((each) => each.shadowRoot && each.classList.contains("plots")))
