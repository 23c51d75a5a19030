// Light or dark: another palette of the roles, and other variables of the style sheet.
const root = document.documentElement.classList
if ("active" in cb_obj) root.toggle("dark", cb_obj.active)
const colours = root.contains("dark") ? dark : light
for (const figure of figures) {
  for (const { name, glyph } of figure.renderers) {
    if (name === "labels") glyph.text_color = { value: colours.ink }
    for (const key of ["fill_color", "line_color", "hatch_color"]) {
      const { transform, value } = glyph[key] ?? {}
      if (transform?.factors) transform.palette = transform.factors.map((role) => colours[role])
      else if (name === "areas" && key === "line_color" && value) glyph.line_color = { value: colours.ink }
    }
  }
  for (const each of figure.above) if ("label_text_color" in each) each.label_text_color = colours.ink
  figure.setv({ background_fill_color: colours.paper, border_fill_color: colours.paper })
}
