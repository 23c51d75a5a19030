// The pointer reads x = r in springs and pressure at once: the line in both, and the pressure there.
const out = cb_obj.event_name === "mouseleave"
const { xs, ys, row } = lines.data
const k = row.indexOf("−σzz(r)"), n = xs[k].findIndex((x) => x >= cb_obj.x)
const p = n > 0 ? ys[k][n - 1] + ((cb_obj.x - xs[k][n - 1]) * (ys[k][n] - ys[k][n - 1])) / (xs[k][n] - xs[k][n - 1]) : 0
for (const each of spans) each.setv({ location: cb_obj.x, visible: !out }, { sync: false })
read.setv({ x: cb_obj.x, visible: !out, text: ` r = ${cb_obj.x.toPrecision(4)}, −σzz = ${p.toPrecision(4)}` }, { sync: false })
