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
for (const { source, rows, kind, looks, moving, tips } of layers) {
  if (playing && !moving) continue
  const [x, y] = [[], []]
  for (const _ of rows) {
    x.push(take())
    y.push(take())
  }
  const { data } = source
  // As many points as a row has, each with what the row has.
  const flat = (list) => list.flatMap((row) => [...row])
  const told = (list) => x.flatMap((row, k) => Array(row.length).fill(list[k]))
  if (kind === "image") {
    const [[left, right], [bottom, top]] = [x[0], y[0]]
    data.image[0].set(take())
    source.data = { ...data, x: [left], y: [bottom], dw: [right - left], dh: [top - bottom] }
  } else if ("xs" in data) {
    const wrap = (row) => (kind === "areas" ? [[row]] : row)
    source.data = { ...data, xs: x.map(wrap), ys: y.map(wrap) }
    if (!tips || playing) continue
    // The points of all lines that answer to the pointer.
    const points = [flat(x), flat(y), told(rows), told(looks.symbol)]
    const [xs, ys, row, symbol] = points.map((list) => list.filter((_, k) => points[3][k]))
    tips.data = { x: xs, y: ys, row, symbol }
  } else {
    const styled = kind === "labels" ? [["Label", texts.splice(0, rows.length)]] : Object.entries(looks).map(([key, list]) => [key, told(list)])
    source.data = { ...data, x: flat(x), y: flat(y), ...Object.fromEntries(styled) }
  }
}
// Only texts change: a new text of the model would lay the whole page out again.
const [phase, ...values] = words[state].split("|")
const within = (model, what) => [...(Bokeh.index.find_one(model)?.el.shadowRoot.querySelectorAll(what) ?? [])]
within(readout, "dd").forEach((cell, k) => { cell.textContent = values[k] })
within(standing, "output").forEach((output) => { output.textContent = phase })
