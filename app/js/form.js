// The controls: native fields, sliders and lists, so that keys and screen readers work.
function make(tag, attributes = {}, ...children) {
  const node = document.createElement(tag)
  for (const [name, value] of Object.entries(attributes)) {
    if (name in node && typeof value !== "string") node[name] = value
    else node.setAttribute(name, value)
  }
  node.append(...children)
  return node
}

// A symbol with its index: q_c as q with a small c.
function symbol(text) {
  const [head, index] = text.split("_")
  const node = make("i", {}, head)
  if (index) node.append(make("sub", {}, index))
  return node
}

// A sentence in which every symbol such as d_c has its index.
function sentence(tag, attributes, text) {
  const node = make(tag, attributes)
  text.split(/(\b[a-zA-Zσ]_[a-z0-9]+)/).forEach((part, i) => node.append(i % 2 ? symbol(part) : part))
  return node
}

// A selector that finds the same control again after the form was built anew.
function nameOf(control) {
  if (control?.type === "radio") return `input[name="${control.name}"][value="${control.value}"]`
  const label = control?.getAttribute?.("aria-label")
  return label ? `[aria-label="${CSS.escape(label)}"]` : null
}

class Form {
  constructor(ask) {
    this.ask = ask
    this.node = make("div", { class: "form" })
    this.kinds = ""
    this.rows = new Map()
  }

  show(meta) {
    const { form } = meta
    this.steps = form.steps
    const kinds = JSON.stringify(
      form.groups.map(({ rows }) =>
        rows.map((row) => [row.number, row.choice, row.options, row.sketch, row.act, "note" in row]),
      ),
    )
    if (kinds !== this.kinds) {
      this.kinds = kinds
      this.build(form)
    }
    if (!this.ask.pending("load")) this.preset.value = form.preset.value
    const origin = "Where the preset's numbers come from"
    this.origin.textContent = form.preset.altered ? `Altered. ${origin}` : origin
    form.groups.forEach(({ rows }, g) => rows.forEach((row, r) => this.rows.get(`${g}.${r}`)(row, meta)))
    this.sources(meta.sources)
  }

  build(form) {
    const focused = nameOf(this.node.getRootNode().activeElement)
    this.preset = list(
      form.preset.label,
      form.preset.options.map((label) => [label, label]),
    )
    this.preset.addEventListener("change", () => this.ask({ do: "load", label: this.preset.value }))
    this.origin = make("summary")
    this.where = make("dl")
    const parts = [
      field("Preset", this.preset),
      make("details", {}, this.origin, this.where),
    ]
    form.groups.forEach(({ title, rows }, g) => {
      parts.push(make("h2", {}, title))
      rows.forEach((row, r) => {
        const [node, show] = this.row(row)
        this.rows.set(`${g}.${r}`, show)
        parts.push(node)
      })
    })
    this.node.replaceChildren(...parts)
    if (focused) this.node.querySelector(focused)?.focus()
  }

  row(row) {
    if ("number" in row) return numberRow(row, this.ask, this.steps)
    if ("choice" in row) return choiceRow(row, this.ask)
    if ("sketch" in row) return sketchRow()
    if ("act" in row) return actRow(row, this.ask)
    const node = make("p", { class: "note" })
    return [node, ({ note }) => node.replaceChildren(...sentence("p", {}, note).childNodes)]
  }

  sources(rows) {
    const text = JSON.stringify(rows)
    if (text === this.told) return
    this.told = text
    this.where.replaceChildren(
      ...rows.flatMap(([what, value, source]) => [
        sentence("dt", {}, `${what} = ${value}`),
        make("dd", {}, source),
      ]),
    )
  }
}

function list(label, options) {
  return make(
    "select",
    { "aria-label": label },
    ...options.map(([value, text]) => make("option", { value }, text)),
  )
}

function field(label, control) {
  return make("label", { class: "list" }, make("span", {}, label), control)
}

function choiceRow(row, ask) {
  const options = Object.entries(row.options)
  if (options.length > 3) {
    const select = list(row.label, options)
    select.addEventListener("change", () => ask({ do: "choose", name: row.choice, option: select.value }))
    return [
      field(row.label, select),
      ({ value }) => {
        if (!ask.pending("choose", row.choice)) select.value = value
      },
    ]
  }
  const buttons = options.map(([value, text]) => {
    const button = make("input", { type: "radio", name: row.choice, value })
    button.addEventListener("change", () => ask({ do: "choose", name: row.choice, option: value }))
    return make("label", {}, button, sentence("span", {}, text))
  })
  const node = make(
    "fieldset",
    { class: "choice" },
    make("legend", {}, row.label),
    make("div", {}, ...buttons),
  )
  return [
    node,
    ({ value }) => {
      // What was picked stays picked while the answer is on its way.
      if (ask.pending("choose", row.choice)) return
      for (const { firstChild } of buttons) firstChild.checked = firstChild.value === value
    },
  ]
}

function numberRow(row, ask, steps) {
  const name = `${row.symbol}, ${row.label}`
  const text = make("input", { type: "text", spellcheck: false, autocomplete: "off", "aria-label": name })
  const slider = make("input", {
    type: "range",
    min: "0",
    max: String(steps),
    step: "1",
    "aria-label": `${name}, slider`,
    title: "Arrow keys step, double-click resets",
  })
  let shown = row
  slider.addEventListener("input", () =>
    ask({ do: "move", name: row.number, position: Number(slider.value) }),
  )
  slider.addEventListener("dblclick", () => ask({ do: "double", name: row.number }))
  text.addEventListener("change", () => {
    ask({ do: "type", name: row.number, text: text.value })
    text.value = shown.text
  })
  text.addEventListener("keydown", (event) => {
    if (event.key === "Escape") text.value = shown.text
    if (event.key === "Enter" || event.key === "Escape") text.blur()
  })
  text.addEventListener("focus", () => text.select())
  const node = make(
    "div",
    { class: "quantity" },
    make("label", {}, make("span", {}, symbol(row.symbol), ` ${row.label}`), text),
    slider,
  )
  const show = (next) => {
    shown = next
    if (text.getRootNode().activeElement !== text) text.value = next.text
    // While moves are on their way, the slider stands where it was put.
    if (!ask.pending("move", row.number)) slider.value = next.position
    slider.setAttribute("aria-valuetext", next.text)
  }
  return [node, show]
}

function actRow({ act, text, title }, ask) {
  const button = make("button", { type: "button", title }, text)
  button.addEventListener("click", () => ask({ do: act }))
  return [make("p", { class: "act" }, button), () => {}]
}

function sketchRow() {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg")
  for (const [name, value] of [
    ["width", 132],
    ["height", 64],
    ["role", "img"],
  ])
    svg.setAttribute(name, value)
  const ground = document.createElementNS(svg.namespaceURI, "line")
  for (const [name, value] of [
    ["x1", 0],
    ["x2", 132],
    ["y1", 57],
    ["y2", 57],
  ])
    ground.setAttribute(name, value)
  const body = document.createElementNS(svg.namespaceURI, "polygon")
  svg.append(ground, body)
  const caption = make("figcaption")
  const show = (_, { sketch }) => {
    body.setAttribute("points", sketch.points)
    svg.setAttribute("aria-label", `Profile of the indenter: ${sketch.shape}`)
    caption.replaceChildren(...sketch.lines.map((line) => make("div", {}, line)))
  }
  return [make("figure", { class: "sketch" }, svg, caption), show]
}
