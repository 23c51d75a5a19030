// Light or dark: another palette of the roles, and other variables of the style sheet.
const root = document.documentElement.classList
if ("active" in cb_obj) root.toggle("dark", cb_obj.active)
const colours = root.contains("dark") ? dark : light
for (const figure of figures) {
  for (const { name, glyph } of figure.renderers) {
    if (name === "labels") glyph.setv({ text_color: { value: colours.ink }, background_fill_color: { value: colours.paper } })
    const { transform } = glyph.fill_color ?? glyph.line_color ?? {}
    if (transform?.factors) transform.palette = transform.factors.map((role) => colours[role])
  }
  figure.setv({ background_fill_color: colours.paper, border_fill_color: colours.paper })
}
