// Both ends of the range have their names.
const all = (root) => [...root.querySelectorAll("*")].flatMap((each) => [each, ...(each.shadowRoot ? all(each.shadowRoot) : [])])
for (const slider of all(document).filter((each) => each.classList.contains("ends")))
  toolkit.name_handles(slider, ["First sample of the fit", "Last sample of the fit"])
