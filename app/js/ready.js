// Once the page is there: names for widgets that have none of their own, keys, and the theme that the system has.
const all = (root) => [...root.querySelectorAll("*")].flatMap((each) => [each, ...(each.shadowRoot ? all(each.shadowRoot) : [])])
const hosts = (name) => all(document).filter((each) => each.shadowRoot && each.classList.contains(name))
for (const [name, spoken] of Object.entries(named)) for (const host of hosts(name))
  for (const each of host.shadowRoot.querySelectorAll("input, select, textarea, [role=slider]")) each.ariaLabel = spoken
document.documentElement.lang = "en"
document.documentElement.classList.toggle("dark", theme.tags[0])
document.addEventListener("keydown", (event) => {
  const on = event.composedPath()[0]
  if (event.ctrlKey || event.altKey || event.metaKey || on.matches?.("input[type=text], textarea, select")) return
  const key = event.key === " " ? "space" : event.key.toLowerCase()
  const host = /^([a-z]|space)$/.test(key) && hosts(`key-${key}`)[0]
  if (!host || (key === "space" && on.matches?.("button, summary, input"))) return
  event.preventDefault()
  host.shadowRoot.querySelector("button").click()
})
if (matchMedia("(prefers-color-scheme: dark)").matches && !location.search.includes("dark=")) hosts("key-d")[0].shadowRoot.querySelector("button").click()
