// One scene as it came from the server, and the columns that all drawings are made of.
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
    for (const name of ["r", "p"])
      fields[name] = Scene.part(values, places, name).subarray(start, start + count[row])
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
  const join = (a, b) => {
    const all = new Float32Array(a.length + b.length)
    all.set(a)
    all.set(b, a.length)
    return all
  }
  return { x: join(back(x, -1), x), y: join(back(y, 1), y) }
}

function column(x, y, from, to) {
  return to > from ? { x: x.subarray(from, to), y: y.subarray(from, to) } : EMPTY
}
