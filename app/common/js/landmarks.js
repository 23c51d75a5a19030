// Landmarks of a page, each with its class, role and name; as the first tab stop a link to what has the class `to`.
const all = (root) => [...root.querySelectorAll("*")].flatMap((each) => [each, ...(each.shadowRoot ? all(each.shadowRoot) : [])])
const found = (name) => all(document).find((each) => each.classList.contains(name))
const mark = () => {
  for (const [name, role, ariaLabel] of landmarks) {
    const el = found(name)
    if (el) Object.assign(el, { role, ariaLabel })
  }
}
mark()
document.documentElement.lang = "en"
// What is opened later is a part of the page.
const page = found(landmarks[0][0])?.getRootNode()
if (page && page !== document) new MutationObserver(mark).observe(page, { childList: true })
if (to) {
  const skip = Object.assign(document.createElement("nav"), { className: "skip", innerHTML: `<a href="#">${label}</a>` })
  skip.firstChild.onclick = (event) => {
    event.preventDefault()
    const target = found(to)
    target.tabIndex = -1
    target.focus()
  }
  document.body.prepend(skip)
}
