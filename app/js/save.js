// A picture of a plot: larger than on the page, with its title and its legend, and the inputs below.
const { above, below, renderers, sizing_mode, width, height } = figure
const { Legend, LegendItem, Title } = Bokeh.Models
const settled = () => new Promise((done) => setTimeout(done, 250))
const some = (part) => (typeof part === "number" ? isFinite(part) : Array.from(part ?? []).some(some))
const items = renderers.filter(({ name }) => !name.startsWith("tips")).flatMap((renderer) => {
  const { row = [], ys, y } = renderer.data_source.data
  const first = (label, index) => named.includes(label) && row.indexOf(label) === index && some((ys ?? y)[index])
  return row.flatMap((label, index) => (first(label, index) ? [new LegendItem({ label, renderers: [renderer], index })] : []))
})
const label_text_color = getComputedStyle(document.documentElement).getPropertyValue("--ink")
const head = new Title({ text: title, text_font_size: "14px", text_font: look.label_text_font })
figure.setv({ above: [...above, new Legend({ ...look, items, label_text_color }), head], below: [...below, inputs] }, { sync: false })
await settled()
figure.setv({ sizing_mode: "fixed", width: 840, height: 600 }, { sync: false })
await settled()
const blob = await Bokeh.index.find_one(figure).export(kind, true).to_blob()
figure.setv({ sizing_mode, width, height, above, below }, { sync: false })
const link = document.createElement("a")
Object.assign(link, { href: URL.createObjectURL(blob), download: `${figure.name}.${kind}` }).click()
setTimeout(() => URL.revokeObjectURL(link.href), 1000)
