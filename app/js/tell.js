// The address says what is shown, without a step in the history; or light and dark, for all that the sheet colours.
const [what] = cb_obj.tags
typeof what === "string" ? history.replaceState(null, "", what) : document.documentElement.classList.toggle("dark", what)
