// Lead to the first field of what has a class, once it is there: a fold may have to open before.
const all = (root) => [...root.querySelectorAll("*")].flatMap((each) => [each, ...(each.shadowRoot ? all(each.shadowRoot) : [])])
const [name] = source.value.split(" ")
const lead = (tries) => {
  const place = all(document).find((each) => each.classList.contains(name) && each.getClientRects().length)
  const field = place && all(place.shadowRoot ?? place).find((each) => each.matches("input:not([type=checkbox]), select"))
  if (field) field.focus()
  else if (tries > 0) requestAnimationFrame(() => lead(tries - 1))
}
lead(120)
