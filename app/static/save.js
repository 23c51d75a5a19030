// Save plots as one picture of two pixels per point, each in its place with title and legend, and the scene below.
// Bokeh draws only the plot: it measures its legend at one pixel per point, and misplaces it at two.
// Wait until a plot has its new size, which takes seconds on a busy machine. The browser then paints the rest within two
// frames.
const pause = (ms) => new Promise((done) => setTimeout(done, ms))
async function settled(figure, width, height) {
  for (let waited = 0; waited < 10_000; waited += 20) {
    await pause(20)
    const size = toolkit.size(figure)
    if (!size) await pause(1000)
    if (!size || (size[0] === width && size[1] === height)) break
  }
  await pause(50)
}
const FONT = "Helvetica, Arial, sans-serif"
// In points: widths of a swatch and a mark, gaps to the word and to the next item, heights of a line and a title; and size of
// the letters of an axis, which scales title and legend.
const [SWATCH, MARK, BESIDE, BETWEEN, LINE, HEAD, LETTERS] = [28, 14, 8, 18, 18, 32, 12]
const SHAPES = {
  circle: (context, x, y, r) => context.arc(x, y, r, 0, 2 * Math.PI),
  square: (context, x, y, r) => context.rect(x - r, y - r, 2 * r, 2 * r),
  diamond: (context, x, y, r) => {
    for (const [u, v] of [[0, -1], [0.67, 0], [0, 1], [-0.67, 0]]) context.lineTo(x + u * r, y + v * r)
    context.closePath()
  },
}
const DRAWN = {
  Patches(context, { fill_color, fill_alpha, hatch_pattern, hatch_alpha }, x, y) {
    context.rect(x, y - 5, SWATCH, 10)
    Object.assign(context, { fillStyle: fill_color, globalAlpha: fill_alpha, lineWidth: 1 })
    context.fill()
    context.globalAlpha = 1
    context.stroke()
    if (hatch_pattern !== "/") return
    context.clip()
    context.beginPath()
    for (let k = -10; k < SWATCH; k += 5) {
      context.moveTo(x + k, y + 5)
      context.lineTo(x + k + 10, y - 5)
    }
    context.globalAlpha = 2 * hatch_alpha
    context.stroke()
  },
  MultiLine(context, { line_width, line_dash }, x, y) {
    context.lineWidth = line_width
    context.setLineDash(typeof line_dash === "string" ? line_dash.split(" ").map(Number).filter(isFinite) : line_dash)
    context.moveTo(x, y)
    context.lineTo(x + SWATCH, y)
    context.stroke()
  },
  Scatter(context, { fill_color, line_width, marker, size }, x, y) {
    SHAPES[marker](context, x + MARK / 2, y, size / 2)
    Object.assign(context, { fillStyle: fill_color, lineWidth: line_width })
    context.fill()
    context.stroke()
  },
}
DRAWN.Line = DRAWN.MultiLine
// Whether two colours, #rrggbb, are nearly equal.
const parts = (colour) => [1, 3, 5].map((k) => parseInt(colour.slice(k, k + 2), 16))
const alike = (one, other) => parts(one).every((part, k) => Math.abs(part - parts(other)[k]) < 16)
// The common look of all data of a glyph.
const look_of = ({ attributes }) => {
  const plain = (look) => (look?.value === undefined ? look : look.value)
  return Object.fromEntries(Object.entries(attributes).map(([name, look]) => [name, plain(look)]))
}
// Items of the legend of a plot: the visible rows, each with its kind and its look.
function items_of({ renderers }, rows) {
  const some = (part) => (typeof part === "number" ? isFinite(part) : Array.from(part ?? []).some(some))
  return renderers.flatMap(({ name, glyph, data_source: { data } }) => {
    const { row, ys, y } = data
    // Without rows in its data, a renderer is a single row with its name.
    if (!row) return rows.includes(name) && some(y) ? [{ label: name, kind: glyph.type, look: look_of(glyph) }] : []
    const named = (label, k) => rows.includes(label) && row.indexOf(label) === k && some((ys ?? y)[k])
    const look = (k) => Object.fromEntries(Object.entries(data).map(([name, column]) => [name, column[k]]))
    return row.flatMap((label, k) => (named(label, k) ? [{ label, kind: glyph.type, look: look(k) }] : []))
  })
}
// Items with their places, in lines between the left and a width; and the height of title and legend. `scale` is the
// size of letters relative to the usual size.
function laid(context, items, left, width, scale) {
  let [x, y] = [left, scale * (HEAD + LINE / 2)]
  const places = items.map((item) => {
    const word = (item.kind === "Scatter" ? MARK : SWATCH) + scale * BESIDE
    const end = word + context.measureText(item.label).width
    if (x > left && x + end > width) [x, y] = [left, y + scale * LINE]
    const place = { ...item, x, y, word: x + word }
    x += end + scale * BETWEEN
    return place
  })
  return [places, items.length ? y + scale * LINE / 2 : scale * HEAD]
}
async function drawn(context, figure, { rows, title }, [left, top, width, height], paper, ink) {
  context.save()
  context.translate(left, top)
  // A large plot has larger letters.
  const scale = parseFloat(figure.below[0].axis_label_text_font_size) / LETTERS, edge = figure.min_border_left
  Object.assign(context, { fillStyle: ink, textBaseline: "middle", font: `${14 * scale}px ${FONT}` })
  context.fillText(title, edge, scale * HEAD / 2, width - edge)
  context.font = `${12 * scale}px ${FONT}`
  const [places, head] = laid(context, items_of(figure, rows), edge, width, scale)
  for (const { label, kind, look, x, y, word } of places) {
    context.fillText(label, word, y, width - word)
    context.save()
    // A white line on an image has the colour of the paper.
    context.strokeStyle = kind === "MultiLine" && alike(look.line_color, paper) ? ink : look.line_color ?? look.fill_color
    context.beginPath()
    DRAWN[kind](context, look, x, y)
    context.restore()
  }
  const { sizing_mode, width: before, height: high } = figure
  figure.setv({ sizing_mode: "fixed", width, height: height - head }, { sync: false })
  await settled(figure, width, height - head)
  const ratio = Object.getOwnPropertyDescriptor(window, "devicePixelRatio")
  window.devicePixelRatio = 2
  const canvas = toolkit.picture(figure)
  Object.defineProperty(window, "devicePixelRatio", ratio)
  figure.setv({ sizing_mode, width: before, height: high }, { sync: false })
  if (canvas) context.drawImage(canvas, 0, head, width, height - head)
  context.restore()
}
export async function save(name, scene, plots, [width, height]) {
  const style = getComputedStyle(document.documentElement)
  const [paper, ink] = ["--paper", "--ink"].map((each) => style.getPropertyValue(each))
  const canvas = Object.assign(document.createElement("canvas"), { width: 2 * width, height: 2 * height })
  const context = canvas.getContext("2d")
  context.scale(2, 2)
  context.fillStyle = paper
  context.fillRect(0, 0, width, height)
  // The canvas returns the colour with all six digits.
  const full = context.fillStyle
  for (const { figure, look, place } of plots) await drawn(context, figure, look, place, full, ink)
  Object.assign(context, { fillStyle: ink, font: `11px ${FONT}` })
  context.fillText(scene, 12, height - 8, width - 24)
  const blob = await new Promise((done) => canvas.toBlob(done))
  Object.assign(document.createElement("a"), { href: URL.createObjectURL(blob), download: `${name}.png` }).click()
}
