// Once the page is there: a name for the slider, which has none of its own, the keys Space and Z, and the theme of the system.
const all = (root) => [...root.querySelectorAll("*")].flatMap((each) => [each, ...(each.shadowRoot ? all(each.shadowRoot) : [])])
const hosts = (name) => all(document).filter((each) => each.shadowRoot && each.classList.contains(name))
for (const { shadowRoot } of hosts("slider"))
  for (const each of shadowRoot.querySelectorAll("input, [role=slider]")) each.ariaLabel = "State along the path"
document.documentElement.lang = "en"
document.documentElement.classList.toggle("dark", messages.dark)
document.addEventListener("keydown", (event) => {
  const on = event.composedPath()[0]
  if (event.ctrlKey || event.altKey || event.metaKey || on.matches?.("input[type=text], textarea, select")) return
  const key = event.key === " " ? "space" : event.key.toLowerCase()
  const host = key === "space" ? hosts("key-space")[0]?.shadowRoot : document
  const target = all(host).find((each) => each.matches(key === "space" ? "button" : `button[data-key="${key}"]`))
  if (!target || !["z", "space"].includes(key) || (key === "space" && on.matches?.("button, summary, input"))) return
  event.preventDefault()
  target.click()
})
if (matchMedia("(prefers-color-scheme: dark)").matches && !location.search.includes("dark=")) messages.dark = true
