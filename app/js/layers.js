// Draws what Bokeh declares. Bokeh styles and maps every glyph five times (as selected, muted, …) and
// measures all axes whenever anything changes, 15 ms a plot; here everything moves with every frame. So
// Bokeh keeps frame, tools and tooltips. The rest is drawn on a sheet of the page's own, once a frame and
// only where it is seen.
class Sheet {
  constructor(view) {
    this.view = view
    this.canvas = make("canvas", { class: "bk-layer", "data-sheet": view.model.name })
    this.canvas.style.pointerEvents = "none"
    this.context = this.canvas.getContext("2d")
    view.canvas_view.primary.el.after(this.canvas)
    const { model } = view
    const views = (parts, type) =>
      parts.filter((part) => !type || part.type === type).map((part) => view.renderer_views.get(part))
    this.layers = views(model.renderers)
    // A logarithmic axis stays Bokeh's.
    this.axes = views([...model.below, ...model.left, ...model.right], "LinearAxis")
    this.grids = this.axes.length > 0 ? views(model.center, "Grid") : []
    const hovers = model.toolbar.tools.filter(({ type }) => type === "HoverTool")
    const pointed = new Set(hovers.flatMap(({ renderers }) => renderers))
    this.pointed = this.layers.filter((layer) => pointed.has(layer.model))
    this.replace(this.grids, paintGrid)
    this.replace(this.layers, paintLayer)
    this.replace(this.axes, paintAxis)
    this.bare = this.axes.length > 0 && !model.right.some(({ type }) => type === "ColorBar")
    this.strip()
    view.repainted.connect(() => {
      this.strip()
      this.paint()
    })
    this.watch()
  }

  // Canvases of Bokeh on which nothing is drawn, which cost with every frame all the same.
  strip() {
    const { canvas_view, model } = this.view
    const shown = (layer, on) => layer.el.style.setProperty("display", on ? "" : "none")
    shown(canvas_view.primary, !this.bare)
    shown(
      canvas_view.overlays,
      model.toolbar.tools.some(({ overlay }) => overlay?.visible),
    )
  }

  // Bokeh paints these only where they are to be saved.
  replace(parts, paint) {
    for (const part of parts) {
      part.paint = (context) => {
        if (this.view.is_forcing_paint) paint(context, part)
        else if (this.pointed.includes(part)) part.map_data()
        part.mark_finished()
      }
    }
  }

  watch() {
    this.seen = true
    new IntersectionObserver(([entry]) => {
      this.seen = entry.isIntersecting
      if (this.seen && this.stale) this.paint()
    }).observe(this.canvas)
  }

  // Shown at the next frame, however often it changes until then.
  change() {
    this.unpointed = true
    this.due ??= requestAnimationFrame(() => this.paint())
  }

  paint() {
    cancelAnimationFrame(this.due)
    this.due = null
    this.stale = !this.seen
    if (!this.seen) return
    const { canvas, context, view } = this
    const { pixel_ratio: ratio, bbox } = view.canvas_view
    const [width, height] = [Math.round(bbox.width * ratio), Math.round(bbox.height * ratio)]
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height })
    context.setTransform(ratio, 0, 0, ratio, 0, 0)
    context.clearRect(0, 0, width, height)
    context.save()
    context.translate(0.5, 0.5)
    for (const grid of this.grids) paintGrid(context, grid)
    context.restore()
    context.save()
    context.beginPath()
    context.rect(...view.frame.bbox.args)
    context.clip()
    context.translate(0.5, 0.5)
    for (const layer of this.layers) paintLayer(context, layer)
    context.restore()
    context.save()
    context.translate(0.5, 0.5)
    for (const axis of this.axes) paintAxis(context, axis)
    context.restore()
  }

  // Lets Bokeh know what its tooltips are to find.
  point() {
    if (this.unpointed) for (const { model } of this.pointed) model.data_source.change.emit()
    this.unpointed = false
  }
}

function paintLayer(context, { model, coordinates, plot_view }) {
  const { glyph, data_source } = model
  const { data } = data_source
  const sx = coordinates.x_scale.v_compute(data.x)
  const sy = data.y ? coordinates.y_scale.v_compute(data.y) : null
  context.save()
  PAINT[glyph.type](context, look(glyph), sx, sy, { data, coordinates, frame: plot_view.frame })
  context.restore()
}

// The properties of a glyph, whether they are values or stand for one.
function look(glyph) {
  const plain = (value) => (typeof value?.value === "undefined" ? value : value.value)
  return new Proxy(glyph, { get: (from, name) => plain(from[name]) })
}

const DASHES = { solid: [], dashed: [6], dotted: [2, 4], dotdash: [2, 4, 6, 4] }

function pen(context, style) {
  context.strokeStyle = style.line_color
  context.globalAlpha = style.line_alpha
  context.lineWidth = style.line_width
  context.lineJoin = "bevel"
  context.setLineDash(DASHES[style.line_dash] ?? style.line_dash)
}

function brush(context, style) {
  context.fillStyle = style.fill_color
  context.globalAlpha = style.fill_alpha
}

// A path through all points, in parts where one is not a number.
function trace(context, sx, sy) {
  let move = true
  context.beginPath()
  for (let k = 0; k < sx.length; k++) {
    if (!Number.isFinite(sx[k] + sy[k])) {
      move = true
    } else if (move) {
      context.moveTo(sx[k], sy[k])
      move = false
    } else {
      context.lineTo(sx[k], sy[k])
    }
  }
}

const HATCHES = new Map()

function hatch(colour, size) {
  const key = `${colour} ${size}`
  if (!HATCHES.has(key)) {
    const canvas = make("canvas", { width: size, height: size })
    const context = canvas.getContext("2d")
    context.strokeStyle = colour
    for (const at of [-0.25, 0.25, 0.75]) {
      context.moveTo(at * size + 0.5, size)
      context.lineTo((at + 0.5) * size + 0.5, 0)
    }
    context.stroke()
    HATCHES.set(key, canvas)
  }
  return HATCHES.get(key)
}

// The outline of each marker around the origin.
const MARKERS = {
  circle: (context, r) => context.arc(0, 0, r, 0, 2 * Math.PI),
  square: (context, r) => context.rect(-r, -r, 2 * r, 2 * r),
  diamond: (context, r) => polygon(context, [0, r], [r / 1.5, 0], [0, -r], [-r / 1.5, 0]),
  triangle: (context, r) => polygon(context, [-r, 0.577 * r], [r, 0.577 * r], [0, -1.155 * r]),
}

function polygon(context, [x, y], ...others) {
  context.moveTo(x, y)
  for (const [u, v] of others) context.lineTo(u, v)
  context.closePath()
}

const PAINT = {
  Line(context, style, sx, sy) {
    trace(context, sx, sy)
    pen(context, style)
    context.stroke()
  },

  Patch(context, style, sx, sy) {
    trace(context, sx, sy)
    context.closePath()
    brush(context, style)
    context.fill("evenodd")
    if (!style.hatch_pattern) return
    context.fillStyle = context.createPattern(hatch(style.hatch_color, style.hatch_scale), "repeat")
    context.globalAlpha = style.hatch_alpha
    context.fill("evenodd")
  },

  VSpan(context, style, sx, _, { frame }) {
    const { top, bottom } = frame.bbox
    context.beginPath()
    for (const at of sx) {
      context.moveTo(Math.round(at), top)
      context.lineTo(Math.round(at), bottom)
    }
    pen(context, style)
    context.stroke()
  },

  Scatter(context, style, sx, sy) {
    pen(context, style)
    for (let k = 0; k < sx.length; k++) {
      if (!Number.isFinite(sx[k] + sy[k])) continue
      context.save()
      context.translate(sx[k], sy[k])
      context.beginPath()
      MARKERS[style.marker](context, style.size / 2)
      brush(context, style)
      context.fill()
      context.globalAlpha = style.line_alpha
      context.stroke()
      context.restore()
    }
  },

  Text(context, style, sx, sy, { data }) {
    const size = Number.parseFloat(style.text_font_size)
    context.font = `${style.text_font_style} ${style.text_font_size} ${style.text_font}`
    context.fillStyle = style.text_color
    context.textAlign = style.text_align
    // On the line of writing, which all viewers of an SVG know.
    const down = { top: 0.9, middle: 0.35, bottom: 0 }[style.text_baseline] * size
    data.text.forEach((text, k) => {
      if (text && Number.isFinite(sx[k] + sy[k])) letter(context, text, sx[k], sy[k] + down, size)
    })
  },

  Image(context, style, sx, sy, { data, coordinates, frame }) {
    if (!data.image) return
    // Around it there is no pressure.
    context.fillStyle = style.color_mapper.palette[0]
    context.fillRect(...frame.bbox.args)
    const [right] = coordinates.x_scale.v_compute([data.x[0] + data.dw[0]])
    const [top] = coordinates.y_scale.v_compute([data.y[0] + data.dh[0]])
    context.imageSmoothingEnabled = false
    context.drawImage(coloured(data.image[0], style.color_mapper), sx[0], top, right - sx[0], sy[0] - top)
  },
}

// An image by the colours of a map, its first row at the top.
function coloured(values, { palette, low, high }) {
  const [height, width] = values.shape
  const canvas = make("canvas", { width, height })
  const context = canvas.getContext("2d")
  const pixels = context.createImageData(width, height)
  const colours = palette.map((colour) => Number.parseInt(colour.slice(1), 16))
  for (let k = 0; k < values.length; k++) {
    const share = Math.floor(((values[k] - low) / (high - low)) * colours.length)
    const colour = colours[Math.min(Math.max(share, 0), colours.length - 1)]
    const row = height - 1 - Math.floor(k / width)
    pixels.data.set([colour >> 16, (colour >> 8) & 255, colour & 255, 255], 4 * (row * width + (k % width)))
  }
  context.putImageData(pixels, 0, 0)
  return canvas
}
