// The strip of numbers above the plots.
class Readouts {
  constructor(units) {
    this.units = units
    this.node = make("dl", { class: "readouts", "aria-label": "Results" })
  }

  // The numbers of one state, and those of the whole scene.
  read(scene, i) {
    const { meta } = scene
    const si = (name, factor) => scene.get(name)[i] * factor
    const { axes } = meta
    const cells = [
      ["F", "force", "force", si("F", axes.F.factor)],
      ["d", "depth", "length", si("d", axes.d.factor)],
      ["a", "contact radius", "length", si("a", axes.a.factor)],
      ["c", "plastic radius", "length", si("c", axes.a.factor)],
      ["p_m", "mean pressure", "pressure", meanPressure(scene, i)],
      ["U", "stored energy", "energy", si("U", meta.energy)],
      ["W_p", "plastic work", "energy", si("W", meta.energy)],
    ]
    if (meta.impact)
      cells.push(
        ["t", "time", "time", si("t", axes.t.factor)],
        ["v", "speed", "speed", si("v", meta.speed)],
      )
    const critical = meta.numbers[0][3]
    if (critical !== null)
      cells.splice(2, 0, ["d/d_c", "relative depth", "number", si("d", axes.d.factor) / critical])
    const all = [
      ...cells,
      ...meta.numbers.map(([name, label, kind, value]) => [name, label, kind, value ?? Infinity]),
    ]
    this.cells(all)
  }

  cells(all) {
    const labels = all.map(([name, label]) => name + label).join()
    if (labels !== this.labels) {
      this.labels = labels
      this.shownCells = all.map(([name, label]) => {
        const [number, unit] = [make("span"), make("small")]
        const [head, below] = name.split("/")
        const title = below ? [symbol(head), "/", symbol(below)] : [symbol(name)]
        const cell = make(
          "div",
          { title: label, "data-symbol": name },
          make("dt", {}, ...title, ` ${label}`),
          make("dd", {}, number, unit),
        )
        return { cell, number, unit }
      })
      this.node.replaceChildren(...this.shownCells.map(({ cell }) => cell))
    }
    all.forEach(([, , kind, value], k) => {
      const [number, unit] = written(this.units[kind], value)
      const cell = this.shownCells[k]
      if (cell.number.textContent !== number) cell.number.textContent = number
      if (cell.unit.textContent !== ` ${unit}`) cell.unit.textContent = ` ${unit}`
    })
  }
}
