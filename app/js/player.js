// Moves through the states of a scene: by a slider, play and pause, and along the force–depth curve.
const SPEEDS = [0.1, 0.25, 0.5, 1, 2]
// Milliseconds for each state on the average.
const PACE = 24
const STILL = 250

class Player {
  constructor({ show, settled, need }) {
    Object.assign(this, { show, settled, need, at: 0, playing: false, last: 0, clock: 0, resting: null })
    this.button = make("button", { type: "button", title: "Play or pause (space)" }, "▶ Play")
    this.slider = make("input", {
      type: "range",
      min: "0",
      max: "1",
      step: "1",
      "aria-label": "State along the way",
    })
    this.speed = make(
      "select",
      { "aria-label": "Speed of the player" },
      ...SPEEDS.map((speed) => make("option", { value: String(speed) }, `${speed} ×`)),
    )
    this.speed.value = "1"
    this.text = make("output", { "aria-live": "off" })
    this.node = make("div", { class: "player" }, this.button, this.slider, this.speed, this.text)
    this.button.addEventListener("click", () => this.toggle())
    this.slider.addEventListener("input", () => {
      this.stop()
      this.go(Number(this.slider.value))
    })
    this.slider.addEventListener("change", () => this.rest())
  }

  // A new scene: stands where the server says.
  load(scene) {
    this.scene = scene
    const { impact, progress } = scene.meta
    // An impact is played in slow motion, anything else at an even pace along its states.
    const t = scene.get("t")
    this.times = impact
      ? Array.from(t, (value) => value / t[t.length - 1])
      : progress.map((_, i) => i / (progress.length - 1))
    this.slider.max = String(progress.length - 1)
    if (!this.playing && this.resting === null) this.at = scene.meta.now
    this.at = Math.min(this.at, progress.length - 1)
    this.mark()
  }

  mark() {
    const { scene, at } = this
    const share = scene.meta.progress[at]
    this.slider.value = String(at)
    const phase = share < 1 ? "loading" : share === 1 ? "deepest" : share < 2 ? "unloading" : "load gone"
    const [time, unit] = scene.meta.impact
      ? written(this.units.time, scene.get("t")[at] * scene.meta.axes.t.factor, 3)
      : ["", ""]
    this.text.textContent = time ? `${phase}, t = ${time} ${unit}` : phase
    this.slider.setAttribute("aria-valuetext", this.text.textContent)
  }

  go(index) {
    if (index === this.at) return
    this.at = index
    this.mark()
    this.show(index)
    this.need()
  }

  toggle() {
    if (this.playing) {
      this.stop()
      this.rest()
      return
    }
    this.playing = true
    this.need()
    this.button.textContent = "❚❚ Pause"
    const end = this.times.length - 1
    this.clock = this.times[this.at >= end ? 0 : this.at]
    this.last = performance.now()
    requestAnimationFrame((now) => this.tick(now))
  }

  tick(now) {
    if (!this.playing) return
    const cycle = (PACE * this.times.length) / Number(this.speed.value)
    this.clock = (this.clock + Math.max(now - this.last, 0) / cycle) % 1.12
    this.last = now
    // A moment of rest at the end of each round.
    const next = this.times.findIndex((time) => time >= this.clock)
    this.go(next < 0 ? this.times.length - 1 : next)
    requestAnimationFrame((then) => this.tick(then))
  }

  // Stops, and tells where.
  stand() {
    this.stop()
    return this.scene.meta.progress[this.at]
  }

  stop() {
    this.playing = false
    this.button.textContent = "▶ Play"
  }

  // Once it is still for a moment, the server hears where the page stands.
  rest() {
    clearTimeout(this.resting)
    this.resting = setTimeout(() => {
      this.resting = null
      this.settled(this.scene.meta.progress[this.at])
    }, STILL)
  }

  // Dragging in the force–depth plot goes to the state next to the pointer.
  grab(view) {
    const area = view.canvas_view.events_el
    const drag = (event) => {
      const box = area.getBoundingClientRect()
      this.stop()
      this.go(this.nearest(view.frame, event.clientX - box.left, event.clientY - box.top))
    }
    area.style.touchAction = "pan-y"
    area.addEventListener("pointerdown", (event) => {
      if (event.button !== 0 || view.model.toolbar.gestures.pan.active !== null) return
      drag(event)
      const move = (each) => drag(each)
      const end = () => {
        window.removeEventListener("pointermove", move)
        this.rest()
      }
      window.addEventListener("pointermove", move)
      window.addEventListener("pointerup", end, { once: true })
      window.addEventListener("pointercancel", end, { once: true })
    })
  }

  nearest(frame, sx, sy) {
    const [d, F] = [this.scene.get("d"), this.scene.get("F")]
    let best = [Infinity, 0]
    for (let i = 0; i < d.length; i++) {
      const away = Math.hypot(frame.x_scale.compute(d[i]) - sx, frame.y_scale.compute(F[i]) - sy)
      // Of two states at one place the one nearer to the present.
      const score = away + 0.02 * Math.abs(i - this.at)
      if (score < best[0]) best = [score, i]
    }
    return best[1]
  }
}
