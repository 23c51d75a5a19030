// The figures of the page: finds layers and axes by name, and puts what is drawn into them.
const DRAW = {
  springs: drawSprings,
  force: drawForce,
  pressure: drawPressure,
  radii: drawRadii,
  motion: drawMotion,
  energy: drawEnergy,
}
const PIXELS = 72

// Bokeh is not told, so that it does not paint: the sheets do.
function quietly(model, values) {
  model.setv(values, { silent: true })
}

class Plots {
  constructor(described, documents) {
    Object.assign(this, { described, documents })
    this.figures = new Map()
    this.sheets = new Map()
    this.shown = new Set()
    this.limits = new Map()
  }

  figure(name) {
    return this.figures.get(name)
  }

  view(name) {
    return Bokeh.index.find_one(this.figure(name))
  }

  // Makes the figures that are to be seen and are not there yet, each in its place.
  async build(place) {
    const missing = this.documents.filter(({ names }) => names.some((name) => this.shown.has(name)))
    this.documents = this.documents.filter((each) => !missing.includes(each))
    for (const { names, document } of missing) {
      const ids = document.roots.map((root) => root.id)
      const roots = Object.fromEntries(ids.map((id, k) => [id, place(names[k])]))
      await Bokeh.embed.embed_items({ plots: document }, [{ docid: "plots", roots, root_ids: ids }])
      const found = Bokeh.documents.find((each) => each.get_model_by_id(ids[0]) !== null)
      names.forEach((name, k) => {
        this.figures.set(name, found.get_model_by_id(ids[k]))
        this.sheets.set(name, new Sheet(this.view(name)))
      })
    }
    return missing.length > 0
  }

  // The names of the plots that are seen, as far as they are there.
  get seen() {
    return [...this.shown].filter((name) => this.figures.has(name))
  }

  layer(name, label) {
    return this.figure(name).renderers.find((renderer) => renderer.name === label)
  }

  // Everything of a scene at one of its states.
  draw(scene, i) {
    for (const plot of this.described) {
      if (this.seen.includes(plot.name)) this.fit(plot, scene.meta.axes)
    }
    this.frame(scene, i)
  }

  // One state in every plot that is seen.
  frame(scene, i) {
    for (const name of this.seen) {
      if (name === "map") {
        this.map(scene, i)
        continue
      }
      const drawn = DRAW[name]?.(scene, i) ?? {}
      for (const [label, data] of Object.entries(drawn)) this.put(name, label, data)
    }
  }

  put(name, label, data) {
    quietly(this.layer(name, label).data_source, { data })
    this.sheets.get(name).change()
  }

  // Lets tooltips find what is drawn.
  point() {
    for (const name of this.seen) this.sheets.get(name).point()
  }

  fit({ name, axes }, all) {
    if (axes.length === 0) return
    const figure = this.figure(name)
    const [x, y, right] = axes.map((key) => all[key])
    const label = name === "pressure" || name === "map" ? x.other : x.label
    const limits = JSON.stringify([x, y, right])
    if (this.limits.get(name) === limits) return
    this.limits.set(name, limits)
    const set = (range, { start, end }) =>
      quietly(range, { start, end, reset_start: start, reset_end: end })
    set(figure.x_range, x)
    set(figure.y_range, y)
    quietly(figure.below[0], { axis_label: label })
    quietly(figure.left[0], { axis_label: name === "map" ? "" : y.label })
    if (right) {
      set(figure.extra_y_ranges.right ?? figure.extra_y_ranges.get("right"), right)
      quietly(figure.right[0], { axis_label: right.label })
    }
    if (name === "map") this.square({ meta: { axes: all } })
    const tooltips = [
      [label.split(",")[0], `$x ${x.unit}`],
      [y.label.split(",")[0], `$y ${y.unit}`],
    ]
    for (const tool of figure.toolbar.tools) {
      if ("tooltips" in tool && "mode" in tool) tool.setv({ tooltips })
    }
  }

  // Equal scales on both axes of the map, whatever the shape of its frame.
  square(scene) {
    const { width, height } = this.view("map")?.frame.bbox ?? {}
    const half = scene.meta.axes.x.end
    if (!(width > 0) || !(height > 0)) return
    const across = half * Math.max(1, width / height)
    const set = (range, end) => quietly(range, { start: -end, end, reset_start: -end, reset_end: end })
    set(this.figure("map").x_range, across)
    set(this.figure("map").y_range, (across * height) / width)
    this.sheets.get("map").change()
  }

  // Pressure over the plane, from the pressure over the radius.
  map(scene, i) {
    const { axes } = scene.meta
    const fields = scene.fields(i)
    const half = axes.x.end
    if (fields) {
      const along = ray(fields, half, axes.p.end)
      const image = Object.assign(new Float32Array(PIXELS * PIXELS), {
        shape: [PIXELS, PIXELS],
        dimension: 2,
      })
      for (let k = 0; k < image.length; k++) {
        const [x, y] = [k % PIXELS, Math.floor(k / PIXELS)].map((pixel) => (pixel + 0.5) / PIXELS - 0.5)
        image[k] = along[Math.round(Math.hypot(x, y) * 2 * RAY)] ?? 0
      }
      const glyph = this.layer("map", "image").glyph
      glyph.color_mapper.setv({ low: 0, high: axes.p.end })
      this.figure("map").right[0]?.setv({ title: `−σ_zz (${axes.p.unit})` })
      this.put("map", "image", { image: [image], x: [-half], y: [-half], dw: [2 * half], dh: [2 * half] })
    }
    const k = axes.a.factor / axes.x.factor
    for (const [label, name] of [
      ["a ring", "a"],
      ["c ring", "c"],
    ]) {
      const r = scene.get(name)[i] * k
      const turn = Float32Array.from({ length: 73 }, (_, j) => (j * Math.PI) / 36)
      this.put("map", label, { x: turn.map((t) => r * Math.cos(t)), y: turn.map((t) => r * Math.sin(t)) })
    }
  }
}

const RAY = 400

// Pressure at equal steps of the radius from 0 to the end of the axis, clipped to its picture.
function ray({ r, p }, half, most) {
  const values = new Float32Array(RAY + 1)
  let k = 0
  for (let j = 0; j <= RAY; j++) {
    const at = (j / RAY) * half
    while (k < r.length - 2 && r[k + 1] < at) k++
    const share = Math.min(Math.max((at - r[k]) / (r[k + 1] - r[k]), 0), 1)
    const [low, high] = [Math.min(p[k], most), Math.min(p[k + 1], most)]
    values[j] = low + (high - low) * share
  }
  return values
}
