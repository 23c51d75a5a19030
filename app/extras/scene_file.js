// A saved scene: the page's own scripts move it, with a plain slider and button in the place of the page's widgets.
const [slider, button, numbers, theme] = ["state", "play", "readout", "dark"].map((id) => document.getElementById(id))
const dragging = { path, depth: null }
const messages = { frames: [], setv: ({ words }) => { numbers.innerHTML = words } }
const play = {
  set label(text) { button.textContent = text },
  get active() { return button.ariaPressed === "true" },
  set active(on) {
    if (on === play.active) return
    button.ariaPressed = String(on)
    moved(play)
  },
}
const shown = () => {
  slider.style.setProperty("--share", slider.value / slider.max)
  moved(state)
  slider.ariaValueText = [...numbers.querySelectorAll("output")].map((each) => each.textContent).join(", ")
}
const state = {
  get value() { return slider.valueAsNumber },
  setv({ value }) {
    if (value === state.value) return
    slider.value = value
    shown()
  },
}
const shade = (dark) => {
  document.documentElement.classList.toggle("dark", dark)
  theme.ariaPressed = String(dark)
  layers.forEach((source, n) => { source.data = { ...source.data, ...looks[Number(dark)][n] } })
}
const system = matchMedia("(prefers-color-scheme: dark)")
system.onchange = () => shade(system.matches)
shade(document.documentElement.classList.contains("dark"))
theme.onclick = () => shade(theme.ariaPressed !== "true")
button.onclick = () => { play.active = !play.active }
slider.oninput = () => {
  play.active = false
  shown()
}
document.onkeydown = (event) => {
  if (event.key !== " " || event.target.matches("button, summary, a")) return
  event.preventDefault()
  button.click()
}
// A drag finds these by their names, as if they were the page's.
Object.assign(window, { messages, dragging, play, state })
touched(figures.filter(({ name }) => name !== "pressure"))
const bytes = Uint8Array.from(atob(packed), (letter) => letter.charCodeAt(0))
const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"))
new Response(stream).text().then((sent) => {
  messages.frames = [sources, ...JSON.parse(sent)]
  slider.disabled = button.disabled = false
  slider.style.setProperty("--share", slider.value / slider.max)
})
