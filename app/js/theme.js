// Light and dark: what is drawn on canvas is recoloured here, the rest by CSS variables.
const DARK = {
  "#22272e": "#e4e7eb",
  "#ffffff": "#181b20",
  "#e6e8eb": "#2b3036",
  "#c9ced6": "#3a4049",
  "#0072b2": "#56b4e9",
  "#d55e00": "#f0913a",
  "#8a8f98": "#828a95",
  "#aa4499": "#dd8fd0",
  "#009e73": "#35c79b",
  "#b8860b": "#e0c04c",
  "#9aa0a8": "#6d747d",
  "#4a515b": "#a9b1bb",
}
const COLOURED = /(^|_)(color|fill_color|line_color)$/

// Colours as they were declared, model by model.
const declared = new WeakMap()

function shade(colour, dark) {
  return (dark && DARK[colour]) || colour
}

function recolour(figure, dark) {
  const bars = figure.right.concat(figure.below, figure.left)
  const glyphs = figure.renderers.filter((each) => each.name !== "image").map((each) => each.glyph)
  for (const model of [figure, ...bars, ...figure.center, ...glyphs]) {
    if (!declared.has(model)) declared.set(model, colours(model))
    const changed = {}
    for (const [name, { value, wrapped }] of declared.get(model)) {
      const to = shade(value, dark)
      changed[name] = wrapped ? { value: to } : to
    }
    // Layers are drawn by the page: what Bokeh would do about each of them is not needed.
    model.setv(changed, { silent: glyphs.includes(model) })
  }
}

function colours(model) {
  const found = []
  for (const property of model) {
    if (!COLOURED.test(property.attr)) continue
    const value = property.get_value()
    const plain = value?.value ?? value
    if (typeof plain === "string" && plain in DARK)
      found.push([property.attr, { value: plain, wrapped: plain !== value }])
  }
  return found
}
