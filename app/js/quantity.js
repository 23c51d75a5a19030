// A number: typed with its unit, or dragged. One request is under way; what is dragged meanwhile replaces what waits.
export function render({ model, el }) {
  el.innerHTML = `<div class="row"><label for="text"></label><button class="help" aria-expanded="false">?</button>
    <input id="text" type="text" spellcheck="false" autocomplete="off" aria-describedby="said"></div>
    <input type="range" title="Arrow keys step, double-click resets"><p id="said" aria-live="polite"></p><div class="about" hidden></div>`
  const [text, range] = el.querySelectorAll("input")
  const [label, said, about, help] = ["label", "#said", ".about", ".help"].map((name) => el.querySelector(name))
  let [busy, wish] = [false, null]
  const ask = (what) => {
    if (busy) wish = what
    else model.send_msg(what)
    busy = true
  }
  const show = () => {
    if (label.innerHTML !== model.label) [label.innerHTML, about.innerHTML] = [model.label, model.about]
    ;[text.ariaLabel, range.ariaLabel, help.ariaLabel] = [model.spoken, `${model.spoken}, slider`, `What is ${model.spoken}?`]
    ;[range.max, range.hidden] = [model.steps, !model.steps]
    // What was refused stays in its field, to be corrected.
    if (!model.refused) text.value = model.text
    text.setAttribute("aria-invalid", String(model.refused !== ""))
    said.textContent = model.refused
    if (wish === null) range.value = model.position
    range.style.setProperty("--share", range.value / range.max)
    range.setAttribute("aria-valuetext", model.text)
  }
  model.on("change:answered", () => {
    const next = wish
    ;[busy, wish] = [false, null]
    show(next && ask(next))
  })
  model.on(["text", "position", "refused"].map((what) => `change:${what}`), () => busy || show())
  range.addEventListener("input", () => {
    range.style.setProperty("--share", range.value / range.max)
    ask({ position: range.valueAsNumber })
  })
  range.addEventListener("dblclick", () => ask({ reset: true }))
  text.addEventListener("change", () => ask({ text: text.value }))
  text.addEventListener("focus", () => text.select())
  text.addEventListener("keydown", ({ key }) => (key === "Escape" ? ask({ restore: true }) : key === "Enter" && text.blur()))
  help.addEventListener("click", () => { help.ariaExpanded = String(!(about.hidden = !about.hidden)) })
  show()
}
