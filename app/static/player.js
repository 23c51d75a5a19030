// The player: a button and a slider that move through the states of a scene, on the page and in a saved scene. Frames are
// sources and, as one text, what these have in each state. `ask` is called with null when it begins to move, and with the
// state in which it ends. Other scripts find it as `player`.
export function make_player({ figures, say, ask }) {
  const el = Object.assign(document.createElement("div"), { className: "player" })
  el.innerHTML = `<button class="act"></button><input type="range" aria-label="State along the path">`
  const [button, range] = el.children
  let [value, moving, sources, sent, wait] = [0, false, [], null, null]
  const place = (k) => {
    range.value = value = Math.min(k, range.max)
    range.style.setProperty("--share", value / range.max)
  }
  const draw = () => {
    if (!sent) return
    sources.forEach((source, n) => { source.data = { ...source.data, ...sent.pictures[value][n] } })
    say(sent.words[value])
    // By itself Bokeh paints at most every second frame.
    setTimeout(() => figures.forEach((figure) => Bokeh.index.find_one(figure).repaint()))
  }
  const move = (k) => {
    if (!moving) ask(null)
    moving = true
    if (k === value) return
    place(k)
    draw()
  }
  const rest = () => {
    if (moving) ask(value)
    moving = false
  }
  const turn = (playing) => Object.assign(button, { ariaPressed: playing, textContent: playing ? "❚❚ Pause" : "▶ Play" })
  const play = () => {
    let begin = null
    const step = (now) => {
      if (!player.playing) return
      requestAnimationFrame(step)
      if (!sent) return
      const { times } = sent, last = times.length - 1
      begin ??= now - 3000 * (value >= last ? 0 : times[value])
      const clock = ((now - begin) / 3000) % 1.12, next = times.findIndex((time) => time >= clock)
      move(next < 0 ? last : next)
    }
    turn(true)
    move(value)
    requestAnimationFrame(step)
  }
  const told = (words, count) => [...words.matchAll(/data-name="(\w+)">([^<]*)/g)].slice(0, count)
    .map(([, name, number]) => `${name.replaceAll("_", " ")} ${number}`).join(", ")
  const player = {
    el,
    rest,
    get value() { return value },
    get playing() { return button.ariaPressed === "true" },
    go(k) {
      turn(false)
      move(k)
    },
    // Another scene, or another state of it, which is drawn already.
    show({ last, now }) {
      range.max = last
      place(moving ? value : now)
    },
    take([those, text]) {
      sources = those
      // A gap in a line is null in a text, which would be drawn as zero.
      sent = text && JSON.parse(text, (_, part) => part ?? NaN)
      if (sent) player.show({ last: sent.times.length - 1, now: value })
      draw()
    },
    // What is seen in words (HTML): the slider says it at once, the plots once they rest.
    tell(words) {
      range.ariaValueText = told(words, 2)
      clearTimeout(wait)
      wait = setTimeout(() => {
        const views = figures.map((figure) => Bokeh.index.find_one(figure))
        // Plots are there later than the player.
        if (!views.every(Boolean)) return player.tell(words)
        for (const view of views) view.el.ariaDescription = told(words)
      }, 300)
    },
  }
  turn(false)
  range.oninput = () => player.go(range.valueAsNumber)
  range.onchange = rest
  button.onclick = () => {
    if (!player.playing) return play()
    turn(false)
    rest()
  }
  document.addEventListener("keydown", (event) => {
    const [on] = event.composedPath()
    if (event.key !== " " || event.ctrlKey || event.altKey || event.metaKey) return
    if (on.matches?.("button, summary, select, textarea, input:not([type=range])")) return
    event.preventDefault()
    button.click()
  })
  return window.player = player
}
