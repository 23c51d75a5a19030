// Whether a slider or the indenter is being dragged.
document.addEventListener("pointerdown", (event) => {
  const [on, ...within] = event.composedPath(), { held } = messages.document.get_model_by_name("springs")
  const springs = held && toolkit.is_canvas(on) && within.some((each) => each.classList?.contains("springs"))
  messages.dragged = springs || on.matches(".number [type=range]")
})
for (const name of ["pointerup", "pointercancel"]) document.addEventListener(name, () => { messages.dragged = false }, true)
