// Parts of the page. `payload` has the number of answered messages and the looks of the visible parts. The browser sends the
// name of a part and the user's action. A maker in KINDS returns an element and a function that shows later looks.
import { make_player } from "./player.js"
import { save } from "./save.js"

const made = (tag, className, innerHTML = "") => Object.assign(document.createElement(tag), { className, innerHTML })
// Scales of a slider: from values to places along it, linear or logarithmic, and back.
const SCALES = { linear: [Number, Number], logarithmic: [Math.log, Math.exp] }
// A number, typed with its unit or dragged. Typed text is sent at once. A drag sends one value at a time; the latest value
// waits as a wish until the answer. Rejected text stays in the field for correction.
class NumberPart {
  constructor({ label, spoken, about, span, id }, send) {
    this.send = send
    // The last look from the server, the numbers of answered and sent messages, the wish, and whether the user types.
    Object.assign(this, { now: null, answered: 0, asked: 0, wish: null, typing: false })
    this.scale = span > 0 ? "logarithmic" : "linear"
    this.el = made("div", "number", `<div class="row"><label for="text-${id}">${label}</label>
      <button class="help" aria-expanded="false" aria-label="What is ${spoken}?">?</button>
      <input id="text-${id}" type="text" spellcheck="false" autocomplete="off" aria-describedby="said-${id}" aria-label="${spoken}"></div>
      <input type="range" max="400" title="Arrow keys step, double-click resets" aria-label="${spoken}, slider">
      <div class="ends" aria-hidden="true"><span></span><span>${this.scale}</span><span></span></div>
      <p class="said" id="said-${id}" aria-live="polite"></p><div class="about" hidden>${about}</div>`);
    [this.text, this.range] = this.el.querySelectorAll("input");
    [this.said, this.about, this.help, this.ends] = [".said", ".about", ".help", ".ends"].map((name) => this.el.querySelector(name))
    this.range.hidden = this.ends.hidden = span < 0
    this.listen()
  }
  listen() {
    const { text, range, help, about } = this
    range.addEventListener("input", () => this.drag())
    // Send the wish when the user releases the slider: an answer may have been lost.
    range.addEventListener("change", () => this.askWish())
    range.addEventListener("dblclick", () => this.ask({ value: this.now.middle }))
    text.addEventListener("input", () => { this.typing = true })
    text.addEventListener("change", () => this.ask({ text: text.value }))
    text.addEventListener("focus", () => text.select())
    // The user has typed but not changed the text.
    text.addEventListener("blur", () => { this.typing = false; this.show() })
    text.addEventListener("keydown", ({ key }) => (key === "Escape" ? this.ask({}) : key === "Enter" && text.select()))
    help.addEventListener("click", () => { help.ariaExpanded = String(!(about.hidden = !about.hidden)) })
  }
  get busy() { return this.answered < this.asked }
  ask(what) {
    this.asked = this.send(what)
    Object.assign(this, { wish: null, typing: false })
  }
  askWish() { if (this.wish !== null) this.ask(this.wish) }
  drag() {
    this.share()
    const what = { value: this.dragged(), dragged: true }
    if (this.busy) this.wish = what
    else this.ask(what)
  }
  // The answer to some messages, or another change of the page.
  take(now, answered) {
    Object.assign(this, { now, answered })
    this.show()
    if (!this.busy) this.askWish()
  }
  // The step of the slider for the present value; and the value for its step, with three digits except at the ends.
  step() {
    const [scaled] = SCALES[this.scale], { value, low, high } = this.now
    return this.range.max * (scaled(value) - scaled(low)) / (scaled(high) - scaled(low))
  }
  dragged() {
    const [scaled, back] = SCALES[this.scale], { low, high } = this.now, share = this.range.value / this.range.max
    if (share === 0 || share === 1) return share ? high : low
    const value = back(scaled(low) + share * (scaled(high) - scaled(low)))
    return Math.min(Math.max(Number(value.toPrecision(3)), low), high)
  }
  share() { this.range.style.setProperty("--share", this.range.value / this.range.max) }
  show() {
    // An answer to an earlier value, or another change of the page, does not replace text while the user types.
    if (this.busy || this.typing) return
    this.showText()
    this.showSlider()
  }
  showText() {
    const { text, said, now } = this
    if (!now.refused && text.value !== now.text) {
      text.value = now.text
      if (text.matches(":focus")) text.select()
    }
    text.setAttribute("aria-invalid", String(now.refused !== ""))
    said.textContent = now.refused
  }
  showSlider() {
    const { range, now, ends: { children: [low, , high] } } = this
    if (this.wish === null) range.value = this.step()
    for (const [end, text] of [[low, now.ends[0]], [high, now.ends[1]]]) if (end.textContent !== text) end.textContent = text
    this.share()
    range.setAttribute("aria-valuetext", now.text)
  }
}
const KINDS = {
  text({ classes }) {
    const el = made("div", classes)
    let text = ""
    return [el, ({ object }) => { if (text !== object) el.innerHTML = text = object }]
  },
  words(_, send, named) {
    const el = made("div", "words"), messages = named("messages")
    const show = () => { el.innerHTML = messages.words }
    messages.properties.words.change.connect(show)
    return [el, show]
  },
  button({ key, opens }, send) {
    const el = made("button", "act")
    Object.assign(el, { onclick: () => send(null) }).dataset.key = key
    return [el, ({ label, pressed, disabled }) => {
      // The unfolded part may be below the window.
      const opened = pressed && el.ariaPressed === "false" && el.matches(":focus")
      if (opened && key === "fold") requestAnimationFrame(() => el.scrollIntoView())
      if (opened && opens) pages.reveal(opens)
      Object.assign(el, { textContent: label, name: label, disabled, ariaPressed: pressed })
    }]
  },
  // Save plots as a picture in the browser; each plot has its figure and its place.
  save({ plots, size }, send, named) {
    const [el, show] = KINDS.button({ key: "" })
    let [looks, scene, file] = [[], "", ""]
    el.onclick = () => save(file, scene, plots.map(({ figure, place }, k) => ({ figure: named(figure), place, look: looks[k] })), size)
    return [el, (look) => { ({ looks, scene, file } = look); show(look) }]
  },
  // Radio buttons or a list, with an explanation in a popover.
  choice({ classes, label, about, radio, id }, send) {
    const popover = `<div popover id="about-${id}">${about}</div>`
    const help = about && `<button class="help" aria-label="What is ${label}?" popovertarget="about-${id}">?</button>${popover}`
    const el = made("div", `choice ${classes}`, radio
      ? `<div class="radio"><button class="word" popovertarget="about-${id}">${label}</button>${popover}<div class="options"></div></div>`
      : `<div class="list"><label for="list-${id}">${label}</label><select id="list-${id}" title="${label}"></select>${help}</div>`)
    const list = el.querySelector(radio ? ".options" : "select")
    // An option chosen before the last answer waits, and replaces an option that waits.
    let [asked, done, wish, offered] = [0, 0, null, ""]
    const choose = (option) => {
      if (done < asked) wish = option
      else [asked, wish] = [send(option), null]
    }
    const filled = (options) => list.replaceChildren(...options.map(([option, text]) => {
      if (!radio) return new Option(text, option)
      const label = made("label", "", `<input type="radio" name="of-${id}">`)
      label.append(text)
      Object.assign(label.firstChild, { value: option, onchange: () => choose(option) })
      return label
    }))
    if (!radio) list.onchange = () => choose(list.value)
    return [el, ({ options, value }, answered) => {
      if (offered !== JSON.stringify(options)) filled(options)
      offered = JSON.stringify(options)
      // The answer to a rejected option restores the present option. Answers to earlier options change nothing.
      done = answered
      if (done < asked) return
      if (wish !== null) return choose(wish)
      if (radio) for (const { firstChild } of list.children) firstChild.checked = firstChild.value === value
      else list.value = value
    }]
  },
  number(look, send) {
    const part = new NumberPart(look, send)
    return [part.el, (now, answered) => part.take(now, answered)]
  },
  player(_, send, named) {
    let asked = 0
    const figures = ["springs", "pressure", "force"].map(named), ask = (what) => { asked = send(what) }
    const { el, show } = make_player({ messages: named("messages"), figures, ask })
    return [el, (look, answered) => show(look, answered < asked)]
  },
  // A chosen or dropped file. Check its size first: a message that is too large ends the session.
  file({ label, accept, most, id }, send) {
    const el = made("div", "file", `<label for="file-${id}">${label}</label><input id="file-${id}" type="file" accept="${accept}" aria-describedby="said-${id}">
      <p class="said" id="said-${id}" aria-live="polite"></p>`)
    const input = el.querySelector("input"), said = el.querySelector(".said")
    input.addEventListener("change", async () => {
      const [file] = input.files
      if (!file) return
      const data = file.size > most ? null : await file.arrayBuffer()
      send({ name: file.name, size: file.size, data })
      // Otherwise a file of the same name is not read again.
      input.value = ""
    })
    return [el, ({ refused, busy }) => {
      if (said.textContent !== (refused || busy)) said.textContent = refused || busy
      input.setAttribute("aria-invalid", String(refused !== ""))
    }]
  },
}
const ACTED = new WeakMap()
export function render({ model, el, view }) {
  el.classList.add("parts")
  const parts = new Map(), named = (name) => view.model.document.get_model_by_name(name)
  let [asked] = JSON.parse(model.payload)
  // Name and place of the part of the last action. The answer may remove the focus, because a button disappears or a plot gets
  // a new layout. Then this part, or the part at its place, gets the focus; otherwise it would go to the top of the page. The
  // model is the key, because a new layout renders everything again.
  const focus = (names, seen) => {
    const { name, place } = ACTED.get(view.model)
    ACTED.delete(view.model)
    if (document.activeElement !== document.body && names.includes(name)) return
    const part = seen[names.indexOf(name)] ?? seen[Math.min(place, seen.length - 1)]
    const found = part?.matches("button") ? part : part?.querySelector("button, select, input")
    found?.focus()
  }
  const sender = (name) => (what) => {
    const seen = [...el.children].filter((part) => !part.hidden), [part] = parts.get(name)
    // An action by a key from elsewhere, such as Ctrl+Z, leaves the focus unchanged.
    if (part.contains(part.getRootNode().activeElement)) ACTED.set(view.model, { name, place: seen.indexOf(part) })
    model.send_msg([name, what])
    return asked += 1
  }
  const show = () => {
    const [answered, looks] = JSON.parse(model.payload)
    const seen = looks.map(({ kind, name, ...look }, k) => {
      if (!parts.has(name)) parts.set(name, KINDS[kind]({ ...look, id: parts.size }, sender(name), named))
      const [part, shown] = parts.get(name)
      if (el.children[k] !== part) el.insertBefore(part, el.children[k] ?? null)
      shown(look, answered)
      return part
    })
    for (const part of el.children) part.hidden = !seen.includes(part)
    if (ACTED.has(view.model) && answered >= asked) focus(looks.map(({ name }) => name), seen)
  }
  model.on("change:payload", show)
  show()
}
