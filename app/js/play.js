// Moves the slider through the states without the server, which hears where it stops.
cb_obj.label = cb_obj.active ? "❚❚ Pause" : "▶ Play"
if (!cb_obj.active) {
  slider.value_throttled = slider.value
  return
}
let clock = null
let last = performance.now()
const step = (now) => {
  if (cb_obj.active) requestAnimationFrame(step)
  const passed = now - last
  last = now
  // The states of this scene are on their way.
  if (!cb_obj.active || frames.tags[0] !== packet.tags[0]) return
  const times = packet.tags[4]
  clock ??= slider.value >= times.length - 1 ? 0 : times[slider.value]
  // A moment of rest at the end of each round.
  clock = (clock + (passed * Number(pace.value)) / 3000) % 1.12
  const next = times.findIndex((time) => time >= clock)
  slider.setv({ value: next < 0 ? times.length - 1 : next }, { sync: false })
}
requestAnimationFrame(step)
