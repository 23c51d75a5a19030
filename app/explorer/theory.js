// The theory: goes to the place that its address names.
const all = (root) => [...root.querySelectorAll("*")].flatMap((each) => [each, ...(each.shadowRoot ? all(each.shadowRoot) : [])])
setTimeout(() => all(document).find(({ id }) => id === place)?.scrollIntoView(), 100)
