// The player: a button and a slider that move through the states of a scene, on the page and in a saved scene. Frames are
// sources, as texts what changes of each in each state, readouts, and times. `ask` is called with null when a move begins, and with the state
// in which it ends; `say` shows readouts. Other scripts find it as `player`.
export function make_player({ figures, say, ask }) {
  const el = Object.assign(document.createElement("div"), { className: "player" })
  el.innerHTML = `<button class="act"></button><input type="range" aria-label="State along the path">`
  const [button, range] = el.children
  let [value, moving, wait] = [0, false, null]
  let [sources, places, words, times] = []
  // A gap in a line is null in a text, which would be drawn as zero.
  const read = (text) => JSON.parse(text, (_, part) => part ?? NaN)
  const stand = (k) => {
    range.value = value = Math.min(k, range.max)
    range.style.setProperty("--share", value / range.max)
    if (!times) return
    sources.forEach((source, n) => { source.data = { ...source.data, ...read(places[n][value]) } })
    say(words[value])
    // By itself Bokeh paints at most every second frame.
    setTimeout(() => figures.forEach((figure) => Bokeh.index.find_one(figure).repaint()))
  }
  const move = (k) => {
    if (!moving) ask(null)
    moving = true
    if (k !== value) stand(k)
  }
  const turn = (on) => Object.assign(button, { ariaPressed: on, textContent: on ? "❚❚ Pause" : "▶ Play" })
  const play = () => {
    let begin = null
    const step = (now) => {
      if (!player.playing) return
      requestAnimationFrame(step)
      if (!times) return
      const last = times.length - 1
      begin ??= now - 3000 * (value >= last ? 0 : times[value])
      const clock = ((now - begin) / 3000) % 1.12, next = times.findIndex((time) => time >= clock)
      move(next < 0 ? last : next)
    }
    turn(true)
    move(value)
    requestAnimationFrame(step)
  }
  const player = {
    el,
    get value() { return value },
    get playing() { return button.ariaPressed === "true" },
    go(k) {
      turn(false)
      move(k)
    },
    rest() {
      if (!moving || player.playing) return
      moving = false
      ask(value)
    },
    // The course of the scene, and the state that the server has drawn.
    show({ last, now }) {
      range.max = last
      stand(moving ? value : now)
    },
    take(frames) {
      [sources, places, words, times] = frames
      if (times) player.show({ last: times.length - 1, now: value })
    },
    // Readouts (HTML) in words: of the slider at once, of the plots once they rest.
    tell(words) {
      const told = Array.from(words.matchAll(/data-name="(\w+)">([^<]*)/g), ([, name, text]) => `${name.replaceAll("_", " ")} ${text}`)
      range.ariaValueText = told.slice(0, 2).join(", ")
      clearTimeout(wait)
      wait = setTimeout(() => figures.forEach((figure) => { Bokeh.index.find_one(figure).el.ariaDescription = told.join(", ") }), 300)
    },
  }
  turn(false)
  range.oninput = () => player.go(range.valueAsNumber)
  range.onchange = player.rest
  button.onclick = () => {
    if (!player.playing) return play()
    player.go(value)
    player.rest()
  }
  document.addEventListener("keydown", (event) => {
    if (event.key !== " " || event.ctrlKey || event.altKey || event.metaKey) return
    if (event.composedPath()[0].matches?.("button, summary, select, textarea, input:not([type=range])")) return
    event.preventDefault()
    button.click()
  })
  return window.player = player
}
