// Moves through the states of a scene: frames are what `source.data` becomes in each of them, sent once.
// A gap in a line is null in a text, which would be drawn as zero.
const read = (text) => JSON.parse(text, (_, value) => value ?? NaN)
const stand = (k) => {
  const [sources, places, words] = messages.frames
  sources.forEach((source, n) => { source.data = { ...source.data, ...read(places[n][k]) } })
  messages.setv({ words: words[k] }, { sync: false })
  // By itself Bokeh paints at most every second frame.
  setTimeout(() => figures.forEach((figure) => Bokeh.index.find_one(figure).repaint()))
}
if (cb_obj !== play) return void (messages.frames.length && stand(state.value))
play.label = play.active ? "❚❚ Pause" : "▶ Play"
if (!play.active) return void (state.value_throttled = state.value)
let begin = null
const step = (now) => {
  if (!play.active) return
  requestAnimationFrame(step)
  if (!messages.frames.length) return
  const times = messages.frames[3]
  begin ??= now - 3000 * (state.value >= times.length - 1 ? 0 : times[state.value])
  const clock = ((now - begin) / 3000) % 1.12
  const next = times.findIndex((time) => time >= clock)
  state.setv({ value: next < 0 ? times.length - 1 : next }, { sync: false })
}
requestAnimationFrame(step)
