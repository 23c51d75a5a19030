// Plots as one picture of two pixels a point, each in its place with its title and its legend, and the scene below.
const settled = () => new Promise((done) => setTimeout(done, 250))
async function drawn(figure, { rows, title }, width, height) {
  const { above, renderers, sizing_mode, width: before, height: high } = figure
  const { Legend, LegendItem, Title } = Bokeh.Models
  const some = (part) => (typeof part === "number" ? isFinite(part) : Array.from(part ?? []).some(some))
  const items = renderers.flatMap((renderer) => {
    const { row = [], ys, y } = renderer.data_source.data
    const named = (label, k) => rows.includes(label) && row.indexOf(label) === k && some((ys ?? y)[k])
    return row.flatMap((label, index) => (named(label, index) ? [new LegendItem({ label, renderers: [renderer], index })] : []))
  })
  const color = getComputedStyle(document.documentElement).getPropertyValue("--ink"), ncols = Math.floor(width / 165)
  const legend = new Legend({ items, label_text_color: color, orientation: "horizontal", ncols, location: "left", border_line_color: null, background_fill_color: null })
  const head = new Title({ text: title, text_font_size: "14px", text_font_style: "normal", text_color: color })
  figure.setv({ above: [...above, legend, head] }, { sync: false })
  await settled()
  figure.setv({ sizing_mode: "fixed", width, height }, { sync: false })
  await settled()
  const ratio = Object.getOwnPropertyDescriptor(window, "devicePixelRatio")
  window.devicePixelRatio = 2
  const { canvas } = Bokeh.index.find_one(figure).export("png", true)
  Object.defineProperty(window, "devicePixelRatio", ratio)
  figure.setv({ sizing_mode, width: before, height: high, above }, { sync: false })
  return canvas
}
export async function save(name, scene, plots, [width, height]) {
  const style = getComputedStyle(document.documentElement)
  const pictures = await Promise.all(plots.map(({ figure, look, place: [, , ...size] }) => drawn(figure, look, ...size)))
  // A canvas of Bokeh, empty once it has another size.
  const { canvas, ctx: context } = Bokeh.index.find_one(plots[0].figure).export("png", true)
  Object.assign(canvas, { width: 2 * width, height: 2 * height })
  context.fillStyle = style.getPropertyValue("--paper")
  context.fillRect(0, 0, canvas.width, canvas.height)
  pictures.forEach((picture, k) => context.drawImage(picture, 2 * plots[k].place[0], 2 * plots[k].place[1]))
  context.fillStyle = style.getPropertyValue("--ink")
  context.font = "22px Helvetica, Arial, sans-serif"
  context.fillText(scene, 24, canvas.height - 16, canvas.width - 48)
  const blob = await new Promise((done) => canvas.toBlob(done))
  Object.assign(document.createElement("a"), { href: URL.createObjectURL(blob), download: `${name}.png` }).click()
}
