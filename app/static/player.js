// The player: a button and a slider that move through the states of a scene, on the page and in a saved scene. It asks null
// when a move begins, and the state in which it ends. Other scripts find it as `player`.
export function make_player({ messages, figures, ask }) {
  const el = Object.assign(document.createElement("div"), { className: "player" })
  el.innerHTML = `<button class="act"></button><select class="speed" aria-label="Speed of the player" hidden>
    <option value="1">1×</option><option value="0.5">½×</option><option value="0.25">¼×</option></select><div class="along"><input type="range" aria-label="State along the path"><div class="marks"></div></div>`
  const [button, speed, range, marked] = ["button", "select", "input", ".marks"].map((each) => el.querySelector(each))
  // The state that is seen, and the one that the server has drawn last.
  let [value, drawn, moving, wait] = [0, 0, false, null]
  // When the first state was, or would have been, played.
  let begin = null
  let [sources, places, words, times] = []
  // A gap in a line is null in a text, which would be drawn as zero.
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
  // The number of the last state, and that of the state which the server has drawn: it is seen unless the player moves,
  // which it does not while a playing one waits for frames. An answer to an `earlier` move does not undo the last one.
  const show = ({ last, now, marks }, earlier = false) => {
    drawn = now
    mark(last, marks)
    if (earlier) return
    range.max = last
    stand(moving && (times || !playing()) ? value : now)
  }
  messages.properties.frames.change.connect(() => {
    // Frames are taken back before another course is drawn. The server does not send again what is as it has drawn it.
    if (times && value !== drawn) stand(drawn);
    [sources, places, words, times] = messages.frames
    if (!times) return
    range.max = times.length - 1
    if (value !== drawn) stand(value)
  })
  // What is seen is told in words: the state at once, the plots once they rest.
  const tell = () => {
    const numbers = messages.words.matchAll(/data-name="(\w+)"[^>]*>([^<]*)/g)
    const told = Array.from(numbers, ([, name, number]) => `${name.replaceAll("_", " ")} ${number}`)
    range.ariaValueText = told.slice(0, 2).join(", ")
    clearTimeout(wait)
    wait = setTimeout(() => figures.forEach((figure) => {
      const el = toolkit.element(figure)
      if (el) el.ariaDescription = told.join(", ")
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
      // Longer than a run, which rests in its last state.
      const clock = ((now - begin) / lasts) % 1.12
      move(times.findLastIndex((time) => time <= clock))
    }
    turn(!playing())
    speed.hidden = false
    move(value)
    rest()
    requestAnimationFrame(step)
  }
  // It goes on from the state that is seen.
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
