// The page: builds what is seen, sends what a person does, and shows what the server answers.
const BASE = ["springs", "force", "pressure", "radii"]
const IN_TIME = ["motion", "energy"]
const SETTLED = 300
const MOST_NOTICES = 12
const [FIRST_TRY, LAST_TRY] = [500, 8000]

class Explorer {
  constructor(model) {
    this.model = model
    this.given = JSON.parse(model.static)
    this.units = this.given.units
    this.plots = new Plots(this.given.plots, this.given.documents)
    this.compared = null
    this.ask = asker(
      (message) => model.send_msg(message),
      () => this.notify("The server does not answer."),
      (busy) => this.node.setAttribute("aria-busy", String(busy)),
    )
    this.form = new Form(this.ask)
    this.player = new Player({
      show: (index) => this.frame(index),
      settled: (at) => this.ask({ do: "stand", at }),
      need: () => this.need(),
    })
    this.player.units = this.units
    this.extra = new Set()
    this.dark =
      stored("theme", matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light") === "dark"
    this.build()
  }

  build() {
    const { help, equations } = this.given
    this.readouts = new Readouts(this.units)
    this.lights = make("ul", { class: "lights", "aria-label": "Validity" })
    this.notices = make("div", { class: "notices", role: "alert" })
    const rows = Object.values(equations).map(([number, math, what]) => {
      const formula = make("dd")
      formula.innerHTML = math
      formula.append(make("small", {}, what))
      return [make("dt", {}, number), formula]
    })
    const about = make(
      "details",
      {},
      make("summary", {}, "Equations and help"),
      ...help.map((text) => make("p", {}, text)),
      make("dl", { class: "equations" }, ...rows.flat()),
    )
    const subtitle = "non-local yield, solved by dimensionality reduction"
    const head = [make("h1", {}, "Indentation explorer"), make("p", { class: "note" }, subtitle)]
    this.tiles = new Map(this.given.plots.map((plot) => [plot.name, tile(this, plot)]))
    this.comparison = new Comparison(this.units, this.given.report)
    this.tiles.get("speed").append(this.comparison.node)
    const grid = make("div", { class: "plots" }, ...this.tiles.values())
    this.grid = grid
    const results = make(
      "section",
      { class: "results" },
      toolbar(this),
      this.readouts.node,
      this.lights,
      this.player.node,
      grid,
    )
    this.node = make(
      "main",
      { class: "explorer" },
      make("aside", {}, ...head, this.form.node, about),
      results,
      this.notices,
    )
  }

  // A new scene from the server.
  load(text, values) {
    const meta = JSON.parse(text)
    const again = this.scene?.meta.seq === meta.seq
    const frames = again ? this.scene.frames : null
    this.scene = new Scene(meta, values)
    this.scene.frames = frames
    this.node.dataset.scene = meta.seq
    if (!again) this.comparison.wait()
    this.ask.answered(meta.answered)
    this.arrange(meta)
    this.player.load(this.scene)
    this.plots.draw(this.scene, this.player.at)
    this.readouts.read(this.scene, this.player.at)
    this.form.show(meta)
    this.around(meta)
    clearTimeout(this.rest)
    this.rest = setTimeout(() => this.settle(), SETTLED)
  }

  frame(index) {
    this.plots.frame(this.scene, index)
    this.readouts.read(this.scene, index)
  }

  // Which plots are seen.
  arrange({ impact }) {
    const names = [...BASE, ...(impact ? IN_TIME : []), ...this.extra]
    if (names.join() === [...this.plots.shown].join()) return
    this.plots.shown = new Set(names)
    this.plots.limits.clear()
    for (const [name, tile] of this.tiles) tile.hidden = !this.plots.shown.has(name)
    this.grid.classList.toggle("wide", names.filter((name) => name !== "speed").length > 4)
    this.grid.classList.toggle("more", this.extra.has("speed"))
    this.grid.classList.toggle("impact", impact)
    this.draw()
  }

  // Draws all that is seen, in figures that may have to be made first.
  async draw() {
    const fresh = await this.plots.build((name) => this.tiles.get(name).querySelector(".plot"))
    if (!fresh) return
    if (this.plots.seen.includes("force") && !this.grabbed) {
      this.grabbed = true
      this.player.grab(this.plots.view("force"))
    }
    this.plots.draw(this.scene, this.player.at)
    this.comparison.again(this.plots)
    this.paint()
    this.squareMap()
    this.node.dataset.drawn = this.plots.seen.join(" ")
  }

  around(meta) {
    const lights = JSON.stringify(meta.lights)
    if (lights !== this.lit) {
      this.lit = lights
      this.lights.replaceChildren(
        ...meta.lights.map(([good, text]) => sentence("li", { class: good ? "good" : "beyond" }, text)),
      )
    }
    this.buttons.undo.disabled = !meta.undo[0]
    this.buttons.redo.disabled = !meta.undo[1]
    this.buttons.hold.setAttribute("aria-pressed", String(Boolean(meta.held)))
    this.heldNote.replaceChildren(...sentence("p", {}, meta.held ? `held: ${meta.held}` : "").childNodes)
    for (const tile of this.tiles.values())
      for (const entry of tile.querySelectorAll('[data-layer^="held"]')) entry.hidden = !meta.held
    if (meta.notice) this.notify(meta.notice)
  }

  // The input is still: the link follows, and the fields of all states are fetched.
  settle() {
    const { query } = this.scene.meta
    const url = query ? `?${query}` : location.pathname
    if (location.search !== `?${query}`) history.replaceState(null, "", url)
    this.need()
    this.compare()
    this.plots.point()
  }

  // Has the models compared on this scene, if that is looked at.
  compare() {
    const wanted = this.extra.has("speed") ? this.scene.meta.seq : null
    if (wanted === this.compared) return
    this.compared = wanted
    this.ask({ do: "compare", on: wanted !== null })
  }

  need() {
    const { seq } = this.scene.meta
    if (this.scene.frames?.seq === seq || this.needed === seq) return
    this.needed = seq
    this.ask({ do: "frames" })
  }

  // What the server sends once.
  hear(message) {
    if (message.meta !== undefined) {
      this.load(message.meta, message.values)
    } else if (message.frames !== undefined) {
      this.scene.frames = {
        seq: message.frames,
        places: JSON.parse(message.places),
        values: Scene.plain(message.values),
      }
      this.node.dataset.frames = message.frames
      if (this.player.at !== this.scene.meta.now) this.frame(this.player.at)
    } else if (message.compared !== undefined) {
      if (message.compared === this.scene.meta.seq) this.comparison.show(message, this.plots)
    } else if (message.what === "python") {
      this.dialog("This state with mdr_core", message.text)
    } else if (message.file) {
      save(message.file, message.text, "text/plain")
    }
  }

  // Asks for something of the state that is seen, which the server may not have heard of yet.
  askHere(message) {
    this.ask({ ...message, at: this.player.stand() })
  }

  showLink() {
    if (this.scene.meta.query)
      this.dialog("Link to this page", new URL(`?${this.scene.meta.query}`, location.href).href)
    else this.notify("This tip has too many samples for a link: save the scene as JSON.")
  }

  dialog(title, text) {
    const dialog = textDialog(title, text)
    this.node.append(dialog)
    dialog.showModal()
  }

  notify(text) {
    const note = make("div", { class: "notice" }, text)
    this.notices.append(note)
    if (this.notices.childElementCount > MOST_NOTICES) this.notices.firstChild.remove()
    setTimeout(() => note.remove(), 7000)
  }

  // Without its server the page can only wait, and come back as the address says it was.
  async lost() {
    if (this.waiting) return
    this.waiting = true
    this.node.dataset.lost = ""
    this.settle()
    const text = "The connection is lost. The page comes back as it is when the server answers."
    this.notices.append(make("div", { class: "notice" }, text))
    for (let wait = FIRST_TRY; ; wait = Math.min(1.5 * wait, LAST_TRY)) {
      await new Promise((resolve) => setTimeout(resolve, wait))
      // A script of the page: to ask for the page itself would begin a session.
      const { src } = document.querySelector("script[src]")
      const answer = await fetch(src, { method: "HEAD", cache: "no-store" }).catch(() => null)
      if (answer?.ok) location.reload()
    }
  }

  // Shows or hides a plot that is seen on request.
  toggle(name) {
    const on = !this.extra.delete(name)
    if (on) this.extra.add(name)
    this.buttons[name].setAttribute("aria-pressed", String(on))
    this.arrange(this.scene.meta)
    this.plots.draw(this.scene, this.player.at)
    this.paint()
    this.squareMap()
    this.compare()
    if (on) this.tiles.get(name).scrollIntoView({ block: "nearest" })
  }

  // Once it has its place on the page, the map can be as wide as high.
  squareMap() {
    if (this.plots.seen.includes("map")) setTimeout(() => this.plots.square(this.scene), 60)
  }

  toggleTheme() {
    this.dark = !this.dark
    store("theme", this.dark ? "dark" : "light")
    this.paint()
  }

  paint() {
    this.node.classList.toggle("dark", this.dark)
    document.documentElement.style.background = this.dark ? "#121418" : "#f5f6f8"
    this.buttons.theme.textContent = this.dark ? "Light" : "Dark"
    for (const plot of this.given.plots) {
      if (this.plots.figure(plot.name)) recolour(this.plots.figure(plot.name), this.dark)
      const marks = this.tiles.get(plot.name).querySelectorAll(".legend svg")
      plot.legend.forEach((entry, k) => {
        marks[k].innerHTML = swatch(entry, this.dark)
      })
    }
  }

  key(event) {
    const on = event.composedPath()[0]
    const typing =
      on.matches?.("input[type=text], textarea, select") || event.ctrlKey || event.altKey || event.metaKey
    const acts = {
      " ": () => !on.matches?.("button, summary, input[type=radio]") && (this.player.toggle(), true),
      h: () => (this.askHere({ do: "hold" }), true),
      r: () => (this.ask({ do: "reset" }), true),
      z: () => (this.ask({ do: "undo" }), true),
      y: () => (this.ask({ do: "redo" }), true),
      m: () => (this.toggle("map"), true),
      s: () => (this.toggle("speed"), true),
      d: () => (this.toggleTheme(), true),
    }
    if (!typing && acts[event.key.toLowerCase()]?.()) event.preventDefault()
  }
}

export function render({ model }) {
  const explorer = new Explorer(model)
  model.on("msg:custom", (message) => explorer.hear(message))
  const key = (event) => explorer.key(event)
  document.addEventListener("keydown", key)
  for (const each of Bokeh.documents) each.on_event("connection_lost", () => explorer.lost())
  model.on("remove", () => document.removeEventListener("keydown", key))
  explorer.load(model.meta, model.values)
  explorer.paint()
  return explorer.node
}
