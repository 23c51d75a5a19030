// Ticks, their numbers, grid and title of a linear axis, in the colours and fonts of its declaration.
const TICK = 5

// Round numbers within a range, at most so many.
function ticks(start, end, most) {
  const least = (end - start) / Math.max(most, 2)
  const power = 10 ** Math.floor(Math.log10(least))
  const step = [1, 2, 5, 10].map((factor) => factor * power).find((size) => size >= least * (1 - 1e-9))
  if (!(step > 0)) return { step: 1, values: [] }
  const first = Math.ceil(start / step - 1e-9)
  const count = Math.floor(end / step + 1e-9) - first + 1
  return { step, values: Array.from({ length: count }, (_, k) => (first + k) * step) }
}

// All numbers of an axis with the same number of places.
function tickTexts({ step, values }) {
  const places = Math.max(0, -Math.floor(Math.log10(step) + 1e-9))
  const long = places > 5 || values.some((value) => Math.abs(value) >= 1e5)
  const text = (value) => (long ? digits(value, 3) : value.toFixed(places).replace("-", "−"))
  return values.map((value) => (value === 0 ? "0" : text(value)))
}

// Which way an axis goes, and its ticks with their places on the screen.
function laidOut(frame, model, across) {
  const scale = across ? frame.x_scale : frame.y_scales.get(model.y_range_name)
  const { start, end } = scale.source_range
  const room = across ? frame.bbox.width / 52 : frame.bbox.height / 36
  const found = ticks(Math.min(start, end), Math.max(start, end), Math.min(room, 8))
  return { ...found, places: Array.from(scale.v_compute(found.values), Math.round) }
}

function paintGrid(context, { model, plot_view }) {
  const across = model.dimension === 0
  const { left, right, top, bottom } = plot_view.frame.bbox
  context.beginPath()
  for (const at of laidOut(plot_view.frame, model, across).places) {
    context.moveTo(across ? at : left, across ? top : at)
    context.lineTo(across ? at : right, across ? bottom : at)
  }
  pen(context, { line_color: model.grid_line_color, line_alpha: 1, line_width: 1, line_dash: [] })
  context.stroke()
}

function paintAxis(context, { model, plot_view }) {
  const { frame } = plot_view
  const { left, right, top, bottom } = frame.bbox
  const { below, right: beside } = plot_view.model
  const across = below.includes(model)
  const side = beside.includes(model) ? 1 : -1
  const edge = across ? bottom : side > 0 ? right : left
  const line = { line_alpha: 1, line_width: 1, line_dash: [] }
  const laid = laidOut(frame, model, across)
  context.beginPath()
  for (const at of laid.places) {
    context.moveTo(across ? at : edge, across ? edge : at)
    context.lineTo(across ? at : edge + side * TICK, across ? edge + TICK : at)
  }
  context.moveTo(across ? left : edge, across ? edge : top)
  context.lineTo(across ? right : edge, across ? edge : bottom)
  pen(context, { ...line, line_color: model.axis_line_color })
  context.stroke()
  numbered(context, model, laid, { across, side, edge })
  titled(context, model, { across, side, edge, x: (left + right) / 2, y: (top + bottom) / 2 })
}

function numbered(context, model, laid, { across, side, edge }) {
  const size = write(context, model, "major_label_text_")
  context.textAlign = across ? "center" : side > 0 ? "left" : "right"
  tickTexts(laid).forEach((text, k) => {
    const at = laid.places[k]
    if (across) context.fillText(text, at, edge + TICK + 3 + 0.8 * size)
    else context.fillText(text, edge + side * (TICK + 3), at + 0.35 * size)
  })
}

function titled(context, model, { across, side, edge, x, y }) {
  if (!model.axis_label) return
  const size = write(context, model, "axis_label_text_")
  context.textAlign = "center"
  if (across) {
    letter(context, model.axis_label, x, edge + 24 + size, size)
    return
  }
  context.save()
  context.translate(edge + side * (46 + 0.35 * size), y)
  context.rotate((side * Math.PI) / 2)
  letter(context, model.axis_label, 0, 0, size)
  context.restore()
}

// A text on one line, its indices small and low.
function letter(context, text, x, y, size) {
  if (!text.includes("_")) {
    context.fillText(text, x, y)
    return
  }
  const { font, textAlign } = context
  const fonts = [font, font.replace(/[\d.]+px/, `${0.75 * size}px`)]
  const parts = indexed(text).map((part, k) => {
    context.font = fonts[k % 2]
    return { part, width: context.measureText(part).width }
  })
  const length = parts.reduce((sum, { width }) => sum + width, 0)
  let at = x - { left: 0, center: 0.5, right: 1 }[textAlign] * length
  context.textAlign = "left"
  parts.forEach(({ part, width }, k) => {
    context.font = fonts[k % 2]
    context.fillText(part, at, y + (k % 2 ? 0.25 * size : 0))
    at += width
  })
  Object.assign(context, { font, textAlign })
}

// The font and the colour of a text of a model; the size of the font in pixels.
function write(context, model, prefix) {
  const [style, size, font, colour] = ["font_style", "font_size", "font", "color"].map(
    (name) => model[prefix + name],
  )
  context.font = `${style} ${size} ${font}`
  context.fillStyle = colour
  context.globalAlpha = 1
  return Number.parseFloat(size)
}
