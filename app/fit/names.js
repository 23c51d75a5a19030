// Fields and boxes have the names that stand beside them, and both ends of the range have theirs.
const all = (root) => [...root.querySelectorAll("*")].flatMap((each) => [each, ...(each.shadowRoot ? all(each.shadowRoot) : [])])
const with_class = (name) => all(document).filter((each) => each.classList.contains(name))
for (const row of with_class("typed-number")) {
  // A name begins with its symbol.
  const parts = all(row.shadowRoot), name = parts.find((each) => each.matches("i")).parentElement.textContent
  for (const input of parts.filter((each) => each.matches("input"))) {
    input.ariaLabel = input.type === "checkbox" ? `free: ${name}` : name
  }
}
for (const slider of with_class("ends")) toolkit.name_handles(slider, ["First sample of the fit", "Last sample of the fit"])
