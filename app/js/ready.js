// Once the page is there: a name for the slider, which has none of its own, the keys Space, Z and Escape, and the theme of the system.
const all = (root) => [...root.querySelectorAll("*")].flatMap((each) => [each, ...(each.shadowRoot ? all(each.shadowRoot) : [])])
const hosts = (name) => all(document).filter((each) => each.shadowRoot && each.classList.contains(name))
const find = (name) => messages.document.get_model_by_name(name)
const handle = all(hosts("slider")[0].shadowRoot).find((each) => each.role === "slider")
handle.ariaLabel = "State along the path"
// What is seen is told in words: the state at once, the plots once they rest.
const told = (count) => [...messages.words.matchAll(/data-name="(\w+)">([^<]*)/g)].slice(0, count)
  .map(([, name, value]) => `${name.replaceAll("_", " ")} ${value}`).join(", ")
const rests = () => ["springs", "pressure", "force"].forEach((name) => { Bokeh.index.find_one(find(name)).el.ariaDescription = told() })
let wait
const tell = () => {
  handle.ariaValueText = told(2)
  clearTimeout(wait)
  wait = setTimeout(rests, 300)
}
for (const each of [find("state").properties.value, messages.properties.words]) each.change.connect(tell)
tell()
document.documentElement.lang = "en"
document.documentElement.classList.toggle("dark", messages.dark)
document.addEventListener("keydown", (event) => {
  const on = event.composedPath()[0]
  if (event.ctrlKey || event.altKey || event.metaKey || on.matches?.("input[type=text], textarea, select")) return
  const key = event.key === " " ? "space" : event.key.toLowerCase()
  if (key === "escape") {
    const open = all(document).filter((each) => each.matches("[popover='']:popover-open, [data-key=escape][aria-pressed=true], .help[aria-expanded=true]"))
    // The browser closes popovers.
    return void (open.some(({ popover }) => popover) || open.at(-1)?.click())
  }
  const host = key === "space" ? hosts("key-space")[0]?.shadowRoot : document
  const target = all(host).find((each) => each.matches(key === "space" ? "button" : `button[data-key="${key}"]`))
  if (!target || !["z", "space"].includes(key) || (key === "space" && on.matches?.("button, summary, input"))) return
  event.preventDefault()
  target.click()
})
if (matchMedia("(prefers-color-scheme: dark)").matches && !location.search.includes("dark=")) messages.dark = true
// Bokeh does not see that a plot has become a few pixels less high, as by a note that is opened.
let before = null
new ResizeObserver(([{ contentRect: { height } }]) => {
  const figures = [...messages.document.all_models].filter(({ type }) => type === "Figure")
  if (before !== null) for (const figure of figures) Bokeh.index.find_one(figure)?.invalidate_layout()
  before = height
}).observe(hosts("plots")[0])
