// Moves through the states of a scene: frames are what `source.data` becomes in each of them, sent once.
// Gaps in a line; text has no NaN, and a null would be drawn as zero.
const gap = (_, value) => value ?? NaN
const sent = () => {
  if (frames.read !== frames.tags) [frames.read, frames.sent] = [frames.tags, JSON.parse(frames.tags[1], gap)]
  return frames.sent
}
const stand = (k) => {
  const { pictures, words } = sent()
  frames.tags[0].forEach((source, n) => { source.data = { ...source.data, ...pictures[k][n] } })
  readout.setv({ text: words[k] }, { sync: false })
}
if (cb_obj !== play) return void (frames.tags.length && stand(state.value))
play.label = play.active ? "❚❚ Pause" : "▶ Play"
if (!play.active) return void (state.value_throttled = state.value)
let [clock, last] = [null, performance.now()]
const step = (now) => {
  if (!play.active) return
  requestAnimationFrame(step)
  const passed = now - last
  last = now
  if (!frames.tags.length) return
  const { times } = sent()
  clock ??= state.value >= times.length - 1 ? 0 : times[state.value]
  clock = (clock + passed / 3000) % 1.12
  const next = times.findIndex((time) => time >= clock)
  state.setv({ value: next < 0 ? times.length - 1 : next }, { sync: false })
}
requestAnimationFrame(step)
