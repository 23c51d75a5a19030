// A number: typed with its unit, or dragged. Each value has a number of its own, which its answer names. What is typed is
// sent at once; of a drag one value is under way, and what is dragged meanwhile replaces what waits.
export function render({ model, el }) {
  el.innerHTML = `<div class="row"><label for="text"></label><button class="help" aria-expanded="false">?</button>
    <input id="text" type="text" spellcheck="false" autocomplete="off" aria-describedby="said"></div>
    <input type="range" title="Arrow keys step, double-click resets"><p id="said" aria-live="polite"></p><div class="about" hidden></div>`
  const [text, range] = el.querySelectorAll("input")
  const [label, said, about, help] = ["label", "#said", ".about", ".help"].map((name) => el.querySelector(name))
  let [asked, wish, typing] = [model.answered, null, false]
  const busy = () => model.answered !== asked
  const ask = (what) => {
    ;[wish, asked, typing] = [null, asked + 1, false]
    model.send_msg({ ...what, number: asked })
  }
  const show = () => {
    if (label.innerHTML !== model.label) [label.innerHTML, about.innerHTML] = [model.label, model.about]
    ;[text.ariaLabel, range.ariaLabel, help.ariaLabel] = [model.spoken, `${model.spoken}, slider`, `What is ${model.spoken}?`]
    ;[range.max, range.hidden] = [model.steps, !model.steps]
    // An answer to an earlier value, or another change of the page, does not touch what is being typed.
    if (busy() || typing) return
    // What was refused stays in its field, to be corrected.
    if (!model.refused && text.value !== model.text) {
      text.value = model.text
      if (text.matches(":focus")) text.select()
    }
    text.setAttribute("aria-invalid", String(model.refused !== ""))
    said.textContent = model.refused
    if (wish === null) range.value = model.position
    range.style.setProperty("--share", range.value / range.max)
    range.setAttribute("aria-valuetext", model.text)
  }
  model.on("change:answered", () => {
    show()
    if (wish !== null && !busy()) ask(wish)
  })
  model.on(["text", "position", "refused"].map((what) => `change:${what}`), show)
  range.addEventListener("input", () => {
    range.style.setProperty("--share", range.value / range.max)
    const what = { position: range.valueAsNumber }
    if (busy()) wish = what
    else ask(what)
  })
  range.addEventListener("dblclick", () => ask({ reset: true }))
  text.addEventListener("input", () => { typing = true })
  text.addEventListener("change", () => ask({ text: text.value }))
  text.addEventListener("focus", () => text.select())
  // Typed and left as it was.
  text.addEventListener("blur", () => { typing = false; show() })
  text.addEventListener("keydown", ({ key }) => (key === "Escape" ? ask({ restore: true }) : key === "Enter" && text.select()))
  help.addEventListener("click", () => { help.ariaExpanded = String(!(about.hidden = !about.hidden)) })
  show()
}
