// From the states of a scene to what each layer of each plot shows, all in the units of the axes.
function drawForce(scene, i) {
  const { axes, peak, onset, impact, tau } = scene.meta
  const [d, F, dp] = ["d", "F", "dp"].map((name) => scene.get(name))
  const fields = scene.fields(i)
  const first = firstYielded(dp, peak)
  const shown = {
    ...curves(scene, d, F, first),
    // With dashpots the curve does not pass there.
    onset:
      onset && !(impact && tau > 0)
        ? { x: [onset[0] / axes.d.factor], y: [onset[1] / axes.F.factor] }
        : EMPTY,
    now: { x: [d[i]], y: [F[i]] },
    names: forceNames(scene, dp[i], dp[0]),
    held: scene.meta.held ? { x: scene.get("held d"), y: scene.get("held F") } : EMPTY,
  }
  if (fields) {
    const [back, out] = [fields["out d"], fields["out F"]]
    shown.dissipated =
      first <= Math.min(i, peak) || scene.meta.tau > 0
        ? // From the axis up: on an imprint, or a flat face, dashpots push at once.
          { x: [d[0], ...d.subarray(0, i + 1), ...back], y: [0, ...F.subarray(0, i + 1), ...out] }
        : EMPTY
    shown.recoverable = { x: [back[0], ...back], y: [0, ...out] }
  }
  return shown
}

// The first state that has yielded further than it was before.
function firstYielded(dp, peak) {
  const first = dp.findIndex((depth) => depth > dp[0])
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

function forceNames(scene, dp, before) {
  const { axes, onset, impact, tau } = scene.meta
  const [right, up] = [0.02 * axes.d.end, 0.045 * axes.F.end]
  const names = { x: [], y: [], text: [] }
  const add = (x, y, text) => {
    names.x.push(x)
    names.y.push(y)
    names.text.push(text)
  }
  if (onset && before === 0 && !(impact && tau > 0)) {
    const x = onset[0] / axes.d.factor
    // To the left of its point where the picture ends on the right.
    const y = Math.max(onset[1] / axes.F.factor - up, up)
    add(x + (x < 0.85 * axes.d.end ? right : -8.5 * right), y, "(d_c, F_c)")
  }
  // Beside the axis on the left, never over it.
  if (dp > 0) add(dp > 5 * right ? dp - 3 * right : Math.max(dp, 0) + right, up, "d_p")
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
    held: scene.meta.held
      ? mirrored(
          scene.get("held r"),
          scene.get("held p").map((p) => Math.min(p, 2 * end)),
        )
      : EMPTY,
  }
  const fields = scene.fields(i)
  if (fields) {
    const both = mirrored(
      fields.r,
      fields.p.map((p) => Math.min(p, 2 * end)),
    )
    shown["−σ_zz(r)"] = shown.area = both
    const infinite = fields.p.findIndex((p) => !Number.isFinite(p))
    const where = infinite === 0 ? "at the axis" : "at the rim r = a"
    shown.note = {
      x: [0],
      y: [0.9 * end],
      text: [infinite < 0 ? "" : `picture clipped: −σ_zz → ∞ ${where}`],
    }
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
  const [d, a, c, dp] = ["d", "a", "c", "dp"].map((name) => scene.get(name))
  // An imprint from before is a plastic zone from the beginning.
  const first = c[0] > 0 ? 0 : firstYielded(dp, peak)
  const yielded = first <= peak
  const zone = column(d, c, Math.max(first - 1, 0), yielded ? peak + 1 : 0)
  const held = (name) => (scene.meta.held ? { x: scene.get("held d"), y: scene.get(name) } : EMPTY)
  return {
    zone: yielded ? { x: [...zone.x, d[peak], zone.x[0]], y: [...zone.y, 0, 0] } : EMPTY,
    "contact radius a": column(d, a, 0, peak + 1),
    "plastic zone c": zone,
    unloading: {
      x: [...d.subarray(peak), NaN, 0, d[peak]],
      y: [...a.subarray(peak), NaN, ...(yielded ? [c[peak], c[peak]] : [NaN, NaN])],
    },
    now: { x: c[i] > 0 ? [d[i], d[i]] : [d[i]], y: c[i] > 0 ? [a[i], c[i]] : [a[i]] },
    "held a": held("held a"),
    "held c": held("held c"),
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
  for (const [layer, name] of [
    ["plastic", "W"],
    ["viscous", "V"],
    ["stored", "U"],
    ["kinetic", "K"],
  ]) {
    const part = scene.get(name)
    const above = below.map((value, j) => value + part[j])
    shown[layer] = { x: [...t, ...back], y: [...above, ...below.reverse()] }
    below = above
  }
  return shown
}
