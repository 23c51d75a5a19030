// Buttons in a row: the server hears the number of the one that is pressed.
export function fill(row, looks, press) {
  looks.forEach(([label, pressed, disabled, visible, key], k) => {
    const button = row.children[k] ?? row.appendChild(document.createElement("button"))
    Object.assign(button, { textContent: label, disabled, hidden: !visible, ariaPressed: pressed, onclick: () => press(k) })
    button.dataset.key = key
  })
}
export function render({ model, el }) {
  el.classList.add("row")
  const show = () => fill(el, model.shown, (k) => model.send_msg(k))
  model.on("change:shown", show)
  show()
}
