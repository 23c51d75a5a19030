// Lays a state out in the columns of the layers: the present one, or one of those that were sent to be played.
const playing = cb_obj !== packet
if (playing && frames.tags[0] !== packet.tags[0]) return
const [, starts, labels, words] = (playing ? frames : packet).tags
const state = playing ? slider.value : 0
const sent = (playing ? frames : packet).data.values
const all = new Float32Array(sent.buffer, sent.byteOffset, sent.length)
const texts = [...labels[state]]
let at = starts[state]
const take = () => {
  const length = all[at]
  at += 1 + length
  return all.subarray(at - length, at)
}
for (const { source, rows, nested, image, labels, moving, tips } of layers) {
  if (playing && !moving) continue
  const [x, y] = [[], []]
  for (let k = 0; k < rows; k++) {
    x.push(take())
    y.push(take())
  }
  const { data } = source
  if (image) {
    const [left, side] = [[x[0][0]], [-2 * x[0][0]]]
    data.image[0].set(y[0])
    source.data = { ...data, x: left, y: left, dw: side, dh: side }
  } else if ("xs" in data) {
    const wrap = (row) => (nested ? [[row]] : row)
    source.data = { ...data, xs: x.map(wrap), ys: y.map(wrap) }
    if (tips && !playing) {
      // The points of all lines that answer to the pointer, each with what it is.
      const points = (list) => list.flatMap((row, k) => (data.symbol[k] ? [...row] : []))
      const told = (key) => x.flatMap((row, k) => (data.symbol[k] ? Array(row.length).fill(data[key][k]) : []))
      tips.data = { x: points(x), y: points(y), row: told("row"), symbol: told("symbol"), unit: told("unit") }
    }
  } else {
    const named = labels ? { Label: texts.splice(0, rows) } : {}
    source.data = { ...data, x: x.map(([each]) => each), y: y.map(([each]) => each), ...named }
  }
}
// Only texts change: a new text of the model would lay the whole page out again.
const [phase, ...values] = words[state].split("|")
const within = (model, what) => [...(Bokeh.index.find_one(model)?.el.shadowRoot.querySelectorAll(what) ?? [])]
within(readout, "dd").forEach((cell, k) => { cell.textContent = values[k] })
within(standing, "output").forEach((output) => { output.textContent = phase })
