// One quantity: a field to type in and a slider under it, both native, so that keys and screen readers work.
export function render({ model, el }) {
  const field = document.createElement("input")
  field.type = "text"
  field.spellcheck = false
  field.autocomplete = "off"
  const slider = document.createElement("input")
  slider.type = "range"
  slider.min = 0
  slider.max = model.steps
  slider.step = 1
  const name = document.createElement("span")
  const symbol = document.createElement("i")
  const [head, index] = model.symbol.split("_")
  symbol.textContent = head
  if (index) symbol.append(Object.assign(document.createElement("sub"), { textContent: index }))
  name.append(symbol, document.createTextNode(` ${model.label}`))
  const row = document.createElement("label")
  row.append(name, field)

  const show = () => {
    if (document.activeElement !== field && field.getRootNode().activeElement !== field) field.value = model.text
    slider.setAttribute("aria-valuetext", model.text)
  }
  // One move is under way at a time; when it is answered, only the latest position follows.
  let sent = null
  let timer = null
  const send = () => {
    const position = Number(slider.value)
    if (timer !== null || position === model.position) return
    timer = setTimeout(answered, 1000)
    sent = position
    model.position = position
  }
  const answered = () => {
    clearTimeout(timer)
    timer = null
    send()
  }
  const place = () => {
    if (timer === null || Number(slider.value) === sent) slider.value = model.position
  }
  field.setAttribute("aria-label", `${model.symbol}, ${model.label}`)
  slider.setAttribute("aria-label", `${model.symbol}, ${model.label}, slider`)
  slider.title = "Arrow keys step, double-click resets"

  slider.addEventListener("input", send)
  slider.addEventListener("dblclick", () => model.send_msg({ reset: true }))
  field.addEventListener("change", () => {
    model.send_msg({ typed: field.value })
    field.value = model.text
  })
  field.addEventListener("keydown", (event) => {
    if (event.key === "Enter") field.blur()
    if (event.key === "Escape") { field.value = model.text; field.blur() }
  })
  field.addEventListener("focus", () => field.select())
  model.on("text", show)
  model.on("position", place)
  model.on("answers", answered)
  place()
  show()
  el.append(row, slider)
}
