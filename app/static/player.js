// The player: a button and a slider that move through the states of a scene, on the page and in a saved scene. It calls `ask`
// with null when a move begins, and with the last state when it ends. Other scripts use it as `player`.
export function make_player({ messages, figures, ask }) {
  const el = Object.assign(document.createElement("div"), { className: "player" })
  el.innerHTML = `<button class="act"></button><select class="speed" aria-label="Speed of the player" hidden>
    <option value="1">1×</option><option value="0.5">½×</option><option value="0.25">¼×</option></select><div class="along"><input type="range" aria-label="State along the path"><div class="marks"></div></div>`
  const [button, speed, range, marked] = ["button", "select", "input", ".marks"].map((each) => el.querySelector(each))
  // The visible state, and the last state drawn by the server.
  let [value, drawn, moving, wait] = [0, 0, false, null]
  // Time at which the first state was, or would have been, played.
  let begin = null
  let [sources, places, words, times] = []
  // A gap in a line is null in JSON; the plot would draw null as zero.
  const read = (text) => JSON.parse(text, (_, part) => part ?? NaN)
  const stand = (k) => {
    range.value = value = Math.min(k, range.max)
    range.style.setProperty("--share", value / range.max)
    if (!times) return
    sources.forEach((source, n) => { source.data = { ...source.data, ...read(places[n][value]) } })
    messages.setv({ words: words[value] }, { sync: false })
    setTimeout(() => figures.forEach(toolkit.paint))
  }
  const move = (k) => {
    if (!moving) ask(null)
    moving = true
    if (k !== value) stand(k)
  }
  // Places of some states along the slider, whose thumb is 14 px wide.
  const mark = (last, marks) => {
    const place = (k) => `style="left: calc(7px + (100% - 14px) * ${k / last})"`
    const found = Object.entries(marks).map(([name, k]) => `<i ${place(k)}></i><span ${place(k)}>${name}</span>`).join("")
    if (marked.innerHTML !== found) marked.innerHTML = found
  }
  const turn = (on) => Object.assign(button, { ariaPressed: on, textContent: on ? "❚❚ Pause" : "▶ Play" })
  const playing = () => button.ariaPressed === "true"
  const go = (k) => {
    turn(false)
    move(k)
  }
  const rest = () => {
    if (!moving || playing()) return
    moving = false
    ask(value)
  }
  // Take the numbers of the last state and of the state drawn by the server, and show the latter unless the player moves. It
  // does not move while it waits for frames. An answer to an `earlier` move does not undo the last move.
  const show = ({ last, now, marks }, earlier = false) => {
    drawn = now
    mark(last, marks)
    if (earlier) return
    range.max = last
    stand(moving && (times || !playing()) ? value : now)
  }
  messages.properties.frames.change.connect(() => {
    // The server removes the frames before it draws another course. It does not send unchanged data again.
    if (times && value !== drawn) stand(drawn);
    [sources, places, words, times] = messages.frames
    if (!times) return
    range.max = times.length - 1
    if (value !== drawn) stand(value)
  })
  // Describe the visible state in words: on the slider at once, on the plots once they rest.
  const tell = () => {
    const numbers = messages.words.matchAll(/data-name="(\w+)"[^>]*>([^<]*)/g)
    const readings = Array.from(numbers, ([, name, number]) => `${name.replaceAll("_", " ")} ${number}`)
    range.ariaValueText = readings.slice(0, 2).join(", ")
    clearTimeout(wait)
    wait = setTimeout(() => figures.forEach((figure) => {
      const el = toolkit.element(figure)
      if (el) el.ariaDescription = readings.join(", ")
    }), 300)
  }
  button.onclick = () => {
    begin = null
    const step = (now) => {
      if (!playing()) return
      requestAnimationFrame(step)
      if (!times) return
      // A run takes three seconds.
      const lasts = 3000 / speed.value
      begin ??= now - lasts * (value < range.max ? times[value] : 0)
      // A cycle is longer than a run, which pauses in its last state.
      const clock = ((now - begin) / lasts) % 1.12
      move(times.findLastIndex((time) => time <= clock))
    }
    turn(!playing())
    speed.hidden = false
    move(value)
    rest()
    requestAnimationFrame(step)
  }
  // Continue from the visible state.
  speed.onchange = () => { begin = null }
  range.oninput = () => go(range.valueAsNumber)
  range.onchange = rest
  document.addEventListener("keydown", (event) => {
    if (event.key !== " " || event.ctrlKey || event.altKey || event.metaKey) return
    if (event.composedPath()[0].matches?.("button, summary, select, textarea, input:not([type=range])")) return
    event.preventDefault()
    button.click()
  })
  messages.properties.words.change.connect(tell)
  turn(false)
  tell()
  window.player = { get value() { return value }, go, rest }
  return { el, show }
}
