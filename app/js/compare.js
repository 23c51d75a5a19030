// Speed against error: every model that can solve the scene, and chains of ever more elements.
const EXACT = 1e-16
const EMPTY_TEXT = { x: [], y: [], text: [] }

class Comparison {
  constructor(units, report) {
    this.units = units
    this.words = make("p", { class: "note", "aria-live": "polite" })
    this.table = make("table", { "aria-label": "Time and error of each model" })
    const alt = "Time against relative error of every method; lower left is better"
    const title = make("summary", {}, "Measured on problems of all kinds, beside other programs")
    const measured = make("details", {}, title, make("img", { src: report, alt }))
    this.node = make("div", { class: "compared" }, this.words, make("div", {}, this.table), measured)
  }

  // The scene has changed: what is shown is no longer about it.
  wait() {
    this.node.classList.add("stale")
  }

  show(message, plots) {
    this.message = message
    this.node.classList.remove("stale")
    this.words.replaceChildren(...sentence("p", {}, this.said(message)).childNodes)
    this.tabulate(message)
    this.draw(message, plots)
  }

  // The figure has been made after the first rows came.
  again(plots) {
    if (this.message) this.draw(this.message, plots)
  }

  said({ used, reason, rows, impact, cap, done, failed }) {
    if (failed) return "The models could not be compared for this scene."
    const largest = rows.findLast(([, n]) => n !== null)?.[1]
    const what = impact ? "Error of e" : "Relative error of F at the largest depth"
    const end = !done
      ? "measuring …"
      : largest < 4096
        ? `chains beyond n = ${largest} would take more than ${cap} s in all`
        : "n elements in the chain"
    return `Used on this page: ${used}, the cheapest exact one: ${reason}. ${what} against it; ${end}.`
  }

  tabulate({ rows, used }) {
    const row = (head, cells) =>
      make(
        "tr",
        {},
        make("th", { scope: "row" }, head),
        ...cells.map((text, k) => make("td", rows[k][0] === used ? { class: "used" } : {}, text)),
      )
    const time = ([, , seconds]) => written(this.units.time, seconds, 2).join(" ")
    const error = ([, , , value]) => {
      if (value === null) return "exact"
      return value < EXACT ? "< 10⁻¹⁶" : digits(value, 2)
    }
    this.table.replaceChildren(
      row(
        "model",
        rows.map(([model]) => model),
      ),
      row(
        "n",
        rows.map(([, n]) => (n === null ? "–" : String(n))),
      ),
      row("time", rows.map(time)),
      row("error", rows.map(error)),
    )
  }

  draw({ rows, used, impact }, plots) {
    if (rows.length === 0 || !plots.figure("speed")) return
    const place = ([, , seconds, error]) => [seconds, Math.max(error ?? EXACT, EXACT)]
    const at = (some) => {
      const places = some.map(place)
      return { x: places.map(([x]) => x), y: places.map(([, y]) => y) }
    }
    for (const model of ["closed form", "scalar ODE", "chain"])
      plots.put("speed", model, at(rows.filter(([name]) => name === model)))
    plots.put("speed", "chain line", at(rows.filter(([name]) => name === "chain")))
    plots.put("speed", "used on this page", at(rows.filter(([name, n]) => name === used && n === null)))
    plots.put("speed", "names", this.named(rows, at))
    const seconds = rows.map(([, , value]) => Math.log10(value))
    const figure = plots.figure("speed")
    const [start, end] = [Math.min(...seconds) - 0.3, Math.max(...seconds) + 0.7]
    const set = (range, from, to) =>
      range.setv({ start: from, end: to, reset_start: from, reset_end: to })
    set(figure.x_range, 10 ** Math.floor(start), 10 ** Math.ceil(end))
    set(figure.y_range, EXACT / 30, 1)
    figure.below[0].setv({ axis_label: "time to solve (s)" })
    figure.left[0].setv({ axis_label: impact ? "error of e" : "relative error of F" })
  }

  // Models by their names, chains by the first and the last number of elements.
  named(rows, at) {
    const chains = rows.filter(([, n]) => n !== null)
    const some = rows.filter((row) => row[1] === null || row === chains[0] || row === chains.at(-1))
    if (some.length === 0) return EMPTY_TEXT
    const { x, y } = at(some)
    const text = some.map(([model, n]) => (n === null ? model : `n = ${n}`))
    return { x: x.map((value) => value * 1.12), y, text }
  }
}
