// A picture of a plot: larger than on the page, with its title and its legend, and the scene below.
export async function save(figure, { rows, title, scene }) {
  const { above, below, renderers, sizing_mode, width, height } = figure
  const { Legend, LegendItem, Title } = Bokeh.Models
  const settled = () => new Promise((done) => setTimeout(done, 250))
  const some = (part) => (typeof part === "number" ? isFinite(part) : Array.from(part ?? []).some(some))
  const items = renderers.flatMap((renderer) => {
    const { row = [], ys, y } = renderer.data_source.data
    const named = (label, k) => rows.includes(label) && row.indexOf(label) === k && some((ys ?? y)[k])
    return row.flatMap((label, index) => (named(label, index) ? [new LegendItem({ label, renderers: [renderer], index })] : []))
  })
  const label_text_color = getComputedStyle(document.documentElement).getPropertyValue("--ink")
  const legend = new Legend({ items, label_text_color, orientation: "horizontal", ncols: 5, location: "left", border_line_color: null, background_fill_color: null })
  const words = (text, size) => new Title({ text, text_font_size: size, text_font_style: "normal", text_color: label_text_color })
  figure.setv({ above: [...above, legend, words(title, "14px")], below: [...below, words(scene, "11px")] }, { sync: false })
  await settled()
  figure.setv({ sizing_mode: "fixed", width: 840, height: 600 }, { sync: false })
  await settled()
  const blob = await Bokeh.index.find_one(figure).export("png", true).to_blob()
  figure.setv({ sizing_mode, width, height, above, below }, { sync: false })
  Object.assign(document.createElement("a"), { href: URL.createObjectURL(blob), download: `${figure.name}.png` }).click()
}
