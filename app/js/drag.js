// A drag in the plot of force against depth goes to the state next to the pointer; the server hears where it ends.
const { x_range, y_range } = figure
if (cb_obj.event_name === "panend") return void (slider.value_throttled = slider.value)
const [d, F] = packet.tags[5]
const [dx, dy] = [(each) => (each - cb_obj.x) / (x_range.end - x_range.start), (each) => (each - cb_obj.y) / (y_range.end - y_range.start)]
// Of two states at one place the one nearer to the present.
const away = d.map((each, k) => Math.hypot(dx(each), dy(F[k])) + 1e-4 * Math.abs(k - slider.value))
play.active = false
const value = away.indexOf(Math.min(...away))
// The first move asks for the states that are to be shown.
slider.setv({ value }, { sync: frames.tags[0] !== packet.tags[0] })
