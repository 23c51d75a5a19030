// A number: typed with its unit, or dragged. One request is under way; what is dragged meanwhile replaces what waits.
export function render({ model, el }) {
  el.innerHTML = `<div class="row"><label for="text">${model.label}</label>
    <button class="help" aria-expanded="false" aria-label="What is ${model.spoken}?">?</button>
    <input id="text" type="text" spellcheck="false" autocomplete="off" aria-describedby="said">
    </div><input type="range" max="${model.steps}" title="Arrow keys step, double-click resets">
    <p id="said" aria-live="polite"></p><div class="about" hidden>${model.about}</div>`
  const [text, range] = el.querySelectorAll("input")
  const [said, about, help] = ["#said", ".about", ".help"].map((name) => el.querySelector(name))
  text.ariaLabel = model.spoken
  range.hidden = !model.steps
  range.ariaLabel = `${model.spoken}, slider`
  let busy = false
  let wish = null
  const ask = (what) => {
    if (busy) wish = what
    else model.send_msg(what)
    busy = true
  }
  const show = () => {
    // What was refused stays in its field, to be mended.
    if (!model.refused) text.value = model.text
    text.setAttribute("aria-invalid", String(model.refused))
    said.textContent = model.said
    if (wish === null) range.value = model.position
    range.style.setProperty("--share", range.value / range.max)
    range.setAttribute("aria-valuetext", model.text)
  }
  model.on("change:answered", () => {
    busy = false
    const next = wish
    wish = null
    if (next) ask(next)
    show()
  })
  model.on(["text", "position", "refused", "said"].map((what) => `change:${what}`), () => busy || show())
  range.addEventListener("input", () => {
    range.style.setProperty("--share", range.value / range.max)
    ask({ position: range.valueAsNumber })
  })
  range.addEventListener("dblclick", () => ask({ reset: true }))
  text.addEventListener("change", () => ask({ text: text.value }))
  text.addEventListener("focus", () => text.select())
  text.addEventListener("keydown", ({ key }) => {
    if (key === "Escape") ask({ restore: true })
    else if (key === "Enter") text.blur()
  })
  help.addEventListener("click", () => {
    about.hidden = !about.hidden
    help.ariaExpanded = String(!about.hidden)
  })
  show()
}
