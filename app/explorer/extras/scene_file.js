// Saved scene: the scripts of the page play and drag it.
const [numbers, theme] = ["readout", "dark"].map((id) => document.getElementById(id))
const { el, show } = make_player({ messages, figures, ask: () => {} })
show(look)
messages.properties.words.change.connect(() => { numbers.innerHTML = messages.words })
pages.touch(figures.filter(({ name }) => name !== "pressure"), dragging)
const shade = (dark) => {
  document.documentElement.classList.toggle("dark", dark)
  theme.ariaPressed = String(dark)
  layers.forEach((source, n) => { source.data = { ...source.data, ...looks[Number(dark)][n] } })
}
const system = matchMedia("(prefers-color-scheme: dark)")
system.onchange = () => shade(system.matches)
shade(document.documentElement.classList.contains("dark"))
theme.onclick = () => shade(theme.ariaPressed !== "true")
const bytes = Uint8Array.from(atob(packed), (letter) => letter.charCodeAt(0))
const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"))
new Response(stream).text().then((sent) => {
  messages.frames = [sources, ...JSON.parse(sent)]
  document.getElementById("player").append(el)
})
