// Whether a slider or the indenter is being dragged.
document.addEventListener("pointerdown", (event) => {
  const [on, ...within] = event.composedPath(), { held } = dragged.document.get_model_by_name("springs")
  const springs = held && toolkit.is_canvas(on) && within.some((each) => each.classList?.contains("springs"))
  dragged.on = springs || on.matches(".number [type=range]")
})
for (const name of ["pointerup", "pointercancel"]) document.addEventListener(name, () => { dragged.on = false }, true)
