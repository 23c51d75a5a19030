// The springs of the 1D foundation under the 1D profile, each by its state.
const BENDS = 4
const SPRING_REST = 1.5

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
  const push = (along, across) => {
    row.x.push(x + across * width)
    row.y.push(base + (top - base) * along)
  }
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
  return mirrored(
    known.map((j) => x[j]),
    known.map((j) => map(g[j])),
  )
}

// Lines at a and c, and their names at a height.
function radiiLines(scene, i, top) {
  const { axes } = scene.meta
  const k = axes.a.factor / axes.x.factor
  const [a, c] = [scene.get("a")[i] * k, scene.get("c")[i] * k]
  const width = axes.x.end
  const found = [
    [a, "a"],
    [c, "c"],
  ].filter(([r]) => r > 0)
  // Too close to stand side by side: each on the outside of its line, or one name for both.
  const close = found.length === 2 && a - c < 0.11 * width
  if (close && a - c < 0.03 * width) found.splice(0, 2, [a + 0.08 * width, "c ≈ a"])
  const places = found.map(([r, name]) => r + (close && name === "c" ? -0.05 : 0.05) * width)
  return {
    "a line": { x: a > 0 ? [-a, a] : [] },
    "c line": { x: c > 0 ? [-c, c] : [] },
    names: { x: places, y: places.map(() => top), text: found.map(([, name]) => name) },
  }
}
