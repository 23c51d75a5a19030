// A picture of a plot: larger than on the page, with its title and its legend, and the inputs below.
const { above, below, sizing_mode, width, height } = figure
const quiet = { sync: false }
const settled = () => new Promise((done) => setTimeout(done, 250))
legend.label_text_color = getComputedStyle(document.documentElement).getPropertyValue("--ink")
figure.setv({ above: [...above, legend, title], below: [...below, inputs] }, quiet)
await settled()
figure.setv({ sizing_mode: "fixed", width: 840, height: 600 }, quiet)
await settled()
const blob = await Bokeh.index.find_one(figure).export(kind, true).to_blob()
figure.setv({ sizing_mode, width, height }, quiet)
figure.setv({ above, below }, quiet)
const link = document.createElement("a")
link.href = URL.createObjectURL(blob)
link.download = `${figure.name}.${kind}`
link.click()
setTimeout(() => URL.revokeObjectURL(link.href), 1000)
