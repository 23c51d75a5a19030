// From the states of a scene to what each layer of each plot shows, all in the units of the axes.
const BENDS = 5
const SPRING_REST = 1.5

// One scene: texts, arrays end to end, and the fields of all its states once they are there.
class Scene {
  constructor(meta, values) {
    Object.assign(this, { meta, values: Scene.plain(values), frames: null })
  }

  get(name) {
    return Scene.part(this.values, this.meta.places, name)
  }

  // Arrays as they come know their shape, which their parts must not.
  static plain(array) {
    return new Float32Array(array.buffer, array.byteOffset, array.length)
  }

  static part(values, places, name) {
    if (!(name in places)) return null
    const [start, length] = places[name]
    return values.subarray(start, start + length)
  }

  // Pressure over the radius and unloading curve of a state; null where they are not known yet.
  fields(index) {
    const all = this.frames?.seq === this.meta.seq ? this.frames : null
    if (all === null && index !== this.meta.now) return null
    const [values, places] = all ? [all.values, all.places] : [this.values, this.meta.places]
    const row = all ? index : 0
    const count = Scene.part(values, places, "count")
    const start = count.subarray(0, row).reduce((sum, each) => sum + each, 0)
    const fields = {}
    for (const name of ["r", "p"]) fields[name] = Scene.part(values, places, name).subarray(start, start + count[row])
    for (const name of ["out d", "out F"]) {
      const part = Scene.part(values, places, name)
      const length = part.length / count.length
      fields[name] = part.subarray(row * length, (row + 1) * length)
    }
    return fields
  }
}

const EMPTY = { x: [NaN, NaN], y: [NaN, NaN] }

function mirrored(x, y) {
  const back = (values, sign) => Float32Array.from(values, (value) => sign * value).reverse()
  const join = (a, b) => { const all = new Float32Array(a.length + b.length); all.set(a); all.set(b, a.length); return all }
  return { x: join(back(x, -1), x), y: join(back(y, 1), y) }
}

function column(x, y, from, to) {
  return to > from ? { x: x.subarray(from, to), y: y.subarray(from, to) } : EMPTY
}

function drawSprings(scene, i) {
  const { axes } = scene.meta
  const k = axes.d.factor / axes.z.factor
  const [d, dp, live] = ["d", "dp", "live"].map((name) => scene.get(name)[i] * k)
  const [spot, g] = [scene.get("spot"), scene.get("spot g")]
  const rest = -SPRING_REST * axes.z.end
  const width = axes.x.end / (2 * spot.length)
  const rows = [[], [], []].map(() => ({ x: [], y: [] }))
  spot.forEach((at, j) => {
    const imprint = g[j] < dp ? dp - g[j] : 0
    const contact = live > 0 && g[j] < dp + live
    const top = contact ? g[j] - d : -imprint - stillRelaxing(scene, i, g[j], imprint, k)
    const row = rows[imprint > 0 ? 2 : contact ? 1 : 0]
    for (const side of [-at, at]) zigzag(row, side, top, rest, width)
  })
  const far = 3 * axes.z.end
  const outline = profile(scene, (value) => Math.min(value - d, far))
  const imprint = profile(scene, (value) => -Math.max(dp - value, 0))
  const body = { x: [...outline.x], y: [...outline.y] }
  body.y[0] = body.y[body.y.length - 1] = far
  return {
    indenter: body,
    base: { x: [-axes.x.end, axes.x.end], y: [rest, rest] },
    free: rows[0],
    elastic: rows[1],
    yielded: rows[2],
    "residual imprint": dp > 0 ? imprint : EMPTY,
    "profile g(x)": outline,
    ...radiiLines(scene, i, 0.97 * axes.z.end),
  }
}

// An element that let go of a viscous rebound creeps back: what is left of its elastic compression.
function stillRelaxing(scene, i, g, imprint, k) {
  const { tau, impact, axes } = scene.meta
  if (!impact || !(tau > 0)) return 0
  const [d, dp, live, t] = ["d", "dp", "live", "t"].map((name) => scene.get(name))
  for (let m = i; m >= 0; m--) {
    if (live[m] > 0 && g < (dp[m] + live[m]) * k) {
      const left = Math.max(d[m] * k - g - imprint, 0)
      return left * Math.exp((-(t[i] - t[m]) * axes.t.factor) / tau)
    }
  }
  return 0
}

function zigzag(row, x, top, base, width) {
  const push = (along, across) => { row.x.push(x + across * width); row.y.push(base + (top - base) * along) }
  push(0, 0)
  push(0.12, 0)
  for (let k = 0; k < BENDS; k++) push(0.12 + (0.76 * (k + 0.5)) / BENDS, k % 2 ? 0.8 : -0.8)
  push(0.88, 0)
  push(1, 0)
  row.x.push(NaN)
  row.y.push(NaN)
}

// The known part of the profile on both sides, its heights mapped.
function profile(scene, map) {
  const [x, g] = [scene.get("fine"), scene.get("fine g")]
  const known = Array.from(g.keys()).filter((j) => !Number.isNaN(g[j]))
  return mirrored(known.map((j) => x[j]), known.map((j) => map(g[j])))
}

// Lines at a and c, and their names at a height.
function radiiLines(scene, i, top) {
  const { axes } = scene.meta
  const k = axes.a.factor / axes.x.factor
  const [a, c] = [scene.get("a")[i] * k, scene.get("c")[i] * k]
  const width = axes.x.end
  const found = [[a, "a"], [c, "c"]].filter(([r]) => r > 0)
  // Too close to stand side by side: each on the outside of its line.
  const close = found.length === 2 && a - c < 0.06 * width
  const places = found.map(([r, name]) => r + (close && name === "c" ? -0.025 : 0.025) * width)
  return {
    "a line": { x: a > 0 ? [-a, a] : [] },
    "c line": { x: c > 0 ? [-c, c] : [] },
    names: { x: places, y: places.map(() => top), text: found.map(([, name]) => name) },
  }
}

function drawForce(scene, i) {
  const { axes, peak, onset } = scene.meta
  const [d, F, c, dp] = ["d", "F", "c", "dp"].map((name) => scene.get(name))
  const fields = scene.fields(i)
  const first = firstYielded(c, peak)
  const shown = {
    ...curves(scene, d, F, first),
    onset: onset ? { x: [onset[0] / axes.d.factor], y: [onset[1] / axes.F.factor] } : EMPTY,
    now: { x: [d[i]], y: [F[i]] },
    names: forceNames(scene, first <= peak ? dp[i] : 0),
    held: scene.meta.held ? { x: scene.get("held d"), y: scene.get("held F") } : EMPTY,
  }
  if (fields) {
    const [back, out] = [fields["out d"], fields["out F"]]
    shown.dissipated = first <= Math.min(i, peak) || scene.meta.tau > 0
      ? { x: [...d.subarray(0, i + 1), ...back], y: [...F.subarray(0, i + 1), ...out] } : EMPTY
    shown.recoverable = { x: [back[0], ...back], y: [0, ...out] }
  }
  return shown
}

function firstYielded(c, peak) {
  const first = c.findIndex((radius) => radius > 0)
  return first < 0 ? peak + 1 : first
}

function curves(scene, x, y, first) {
  const { peak } = scene.meta
  return {
    elastic: column(x, y, 0, Math.min(first, peak) + 1),
    yielding: column(x, y, Math.min(first, peak), first > peak ? 0 : peak + 1),
    unloading: column(x, y, peak, x.length),
  }
}

function forceNames(scene, dp) {
  const { axes, onset } = scene.meta
  const [right, up] = [0.02 * axes.d.end, 0.035 * axes.F.end]
  const names = { x: [], y: [], text: [] }
  const add = (x, y, text) => { names.x.push(x); names.y.push(y); names.text.push(text) }
  if (onset) {
    const x = onset[0] / axes.d.factor
    // To the left of its point where the picture ends on the right.
    add(x + (x < 0.85 * axes.d.end ? right : -8.5 * right), onset[1] / axes.F.factor - up, "(d_c, F_c)")
  }
  if (dp > 0) add(dp - 2.2 * right, up, "d_p")
  return names
}

function drawPressure(scene, i) {
  const { axes } = scene.meta
  const lines = radiiLines(scene, i, 0.97 * axes.p.end)
  const k = axes.a.factor / axes.x.factor
  const [a, c] = [scene.get("a")[i] * k, scene.get("c")[i] * k]
  const end = axes.p.end
  const mean = a > 0 ? meanPressure(scene, i) / axes.p.factor : NaN
  const shown = {
    ...lines,
    "plastic zone r < c": c > 0 ? { x: [-c, c, c, -c], y: [0, 0, 2 * end, 2 * end] } : EMPTY,
    "mean, F/(πa²)": { x: [-a, a], y: [mean, mean] },
    held: scene.meta.held ? mirrored(scene.get("held r"), scene.get("held p").map((p) => Math.min(p, 2 * end))) : EMPTY,
  }
  const fields = scene.fields(i)
  if (fields) {
    const both = mirrored(fields.r, fields.p.map((p) => Math.min(p, 2 * end)))
    shown["−σ_zz(r)"] = shown.area = both
    const infinite = fields.p.findIndex((p) => !Number.isFinite(p))
    const where = infinite === 0 ? "at the axis" : "at the rim r = a"
    shown.note = { x: [0], y: [0.9 * end], text: [infinite < 0 ? "" : `picture clipped: −σ_zz → ∞ ${where}`] }
  }
  return shown
}

function meanPressure(scene, i) {
  const { axes } = scene.meta
  const a = scene.get("a")[i] * axes.a.factor
  return a > 0 ? (scene.get("F")[i] * axes.F.factor) / (Math.PI * a * a) : 0
}

function drawRadii(scene, i) {
  const { peak } = scene.meta
  const [d, a, c] = ["d", "a", "c"].map((name) => scene.get(name))
  const first = firstYielded(c, peak)
  const yielded = first <= peak
  const zone = column(d, c, Math.max(first - 1, 0), yielded ? peak + 1 : 0)
  const held = scene.meta.held
    ? { x: [...scene.get("held d"), NaN, ...scene.get("held d")], y: [...scene.get("held a"), NaN, ...scene.get("held c")] } : EMPTY
  return {
    zone: yielded ? { x: [...zone.x, d[peak]], y: [...zone.y, 0] } : EMPTY,
    "contact radius a": column(d, a, 0, peak + 1),
    "plastic zone c": zone,
    unloading: { x: [...d.subarray(peak), NaN, 0, d[peak]], y: [...a.subarray(peak), NaN, ...(yielded ? [c[peak], c[peak]] : [NaN, NaN])] },
    now: { x: c[i] > 0 ? [d[i], d[i]] : [d[i]], y: c[i] > 0 ? [a[i], c[i]] : [a[i]] },
    held,
  }
}

function drawMotion(scene, i) {
  const [t, d, F] = ["t", "d", "F"].map((name) => scene.get(name))
  const heldTime = scene.get("held t")
  return {
    "depth d": { x: t, y: d },
    "force F": { x: t, y: F },
    "time line": { x: [t[i]] },
    now: { x: [t[i]], y: [d[i]] },
    "force now": { x: [t[i]], y: [F[i]] },
    held: heldTime ? { x: heldTime, y: scene.get("held F") } : EMPTY,
  }
}

function drawEnergy(scene, i) {
  const t = scene.get("t")
  const back = Float32Array.from(t).reverse()
  let below = new Float32Array(t.length)
  const shown = { "time line": { x: [t[i]] } }
  for (const [layer, name] of [["plastic", "W"], ["viscous", "V"], ["stored", "U"], ["kinetic", "K"]]) {
    const part = scene.get(name)
    const above = below.map((value, j) => value + part[j])
    shown[layer] = { x: [...t, ...back], y: [...above, ...below.reverse()] }
    below = above
  }
  return shown
}
