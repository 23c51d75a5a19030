// A picture of a plot: larger than on the page, with its title and its legend, and the inputs below.
const { above, sizing_mode, width, height } = figure
const notes = [figure.title, ...figure.below.filter(({ name }) => name === "inputs")]
const quiet = { sync: false }
const settled = () => new Promise((done) => setTimeout(done, 250))
legend.label_text_color = notes[0].text_color
figure.setv({ above: [...above, legend] }, quiet)
for (const note of notes) note.visible = true
await settled()
figure.setv({ sizing_mode: "fixed", width: 840, height: 600 }, quiet)
await settled()
const blob = await Bokeh.index.find_one(figure).export(kind, true).to_blob()
for (const note of notes) note.visible = false
figure.setv({ sizing_mode, width, height }, quiet)
figure.setv({ above }, quiet)
const link = document.createElement("a")
link.href = URL.createObjectURL(blob)
link.download = `${figure.name}.${kind}`
link.click()
setTimeout(() => URL.revokeObjectURL(link.href), 1000)
