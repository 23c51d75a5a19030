// Scripts of both pages: functions that callbacks of Bokeh and Panel call by their names.
window.pages = (() => {
  const all = (root) => [...root.querySelectorAll("*")].flatMap((each) => [each, ...(each.shadowRoot ? all(each.shadowRoot) : [])])
  return {
    // The server is gone: the page comes back from its address once it answers.
    again() {
      const later = () => setTimeout(() => fetch(location.href).then((r) => (r.ok ? location.reload() : later()), later), 1000)
      later()
    },
    // A plot has got its size, and with it its canvas.
    tidy(figure) {
      window.toolkit?.tidy(figure)
    },
    // The value of a field is copied, also where the browser gives a page no clipboard, as one that is not served over https.
    copy(field) {
      const area = Object.assign(document.createElement("textarea"), { value: field.value })
      document.body.append(area)
      area.select()
      document.execCommand("copy")
      area.remove()
    },
    // Landmarks of a page, each with its class, role and name; as the first tab stop a link to what has the class `to`.
    landmarks(landmarks, to, label) {
      const found = (name) => all(document).find((each) => each.classList.contains(name))
      const mark = () => {
        for (const [name, role, ariaLabel] of landmarks) {
          const el = found(name)
          if (el) Object.assign(el, { role, ariaLabel })
        }
      }
      mark()
      document.documentElement.lang = "en"
      // What is opened later is a part of the page.
      const page = found(landmarks[0][0])?.getRootNode()
      if (page && page !== document) new MutationObserver(mark).observe(page, { childList: true })
      if (to) {
        const skip = Object.assign(document.createElement("nav"), { className: "skip", innerHTML: `<a href="#">${label}</a>` })
        skip.firstChild.onclick = (event) => {
          event.preventDefault()
          const target = found(to)
          target.tabIndex = -1
          target.focus()
        }
        document.body.prepend(skip)
      }
    },
    // Once the page is there: the keys of undo and Escape, the theme, and the address.
    start(messages) {
      // The server has drawn what a cookie told it, which a first visit has not.
      if (!theme.asked) messages.dark = theme.own
      theme.show(messages.dark)
      messages.properties.dark.change.connect(() => theme.choose(messages.dark))
      // Letters of the plots are larger on a wide screen, as all else is.
      const measure = () => { messages.wide = innerWidth >= 1600 }
      measure()
      addEventListener("resize", measure)
      // The address says what is shown, without a step in the history.
      messages.properties.address.change.connect(() => {
        // The opening scene has no query, and the address then no mark of one.
        if (messages.address) history.replaceState(null, "", messages.address === "?" ? location.pathname : messages.address)
      })
      document.addEventListener("keydown", (event) => {
        const on = event.composedPath()[0]
        // In a field they are those of what is typed; Escape takes back what was typed in a number, and closes what a field is in.
        const typing = on.matches?.("input[type=text], textarea") && (event.key !== "Escape" || on.closest(".number"))
        if (event.altKey || typing) return
        const key = event.key.toLowerCase(), act = (name) => all(document).find((each) => each.matches(`.act[name=${name}]:not([hidden])`))?.click()
        if (event.ctrlKey || event.metaKey) {
          const back = key === "z" && !event.shiftKey, forth = key === "y" || (key === "z" && event.shiftKey)
          if (!(back || forth)) return
          event.preventDefault()
          return void act(back ? "Undo" : "Redo")
        }
        if (on.matches?.("select")) return
        if (event.key === "Escape") {
          const open = all(document).filter((each) => each.matches("[popover='']:popover-open, [data-key=escape][aria-pressed=true], .help[aria-expanded=true]"))
          // The browser closes popovers. What lies over the plots stands first, and is closed before a large plot below it.
          return void (open.some(({ popover }) => popover) || open[0]?.click())
        }
        if (key === "z") act("Undo")
      })
      // Plots that have become a few pixels less high, as by a note that is opened, are drawn so.
      let before = null
      new ResizeObserver(([{ contentRect: { height } }]) => {
        if (before !== null) toolkit.figures(messages.document).forEach(toolkit.lay_out)
        before = height
      }).observe(all(document).find((each) => each.shadowRoot && each.classList.contains("plots")))
    },
    // Whether a slider or the indenter is being dragged.
    watch(messages) {
      document.addEventListener("pointerdown", (event) => {
        const [on, ...within] = event.composedPath(), { held } = messages.document.get_model_by_name("springs")
        const springs = held && toolkit.is_canvas(on) && within.some((each) => each.classList?.contains("springs"))
        messages.dragged = springs || on.matches(".number [type=range]")
      })
      for (const name of ["pointerup", "pointercancel"]) document.addEventListener(name, () => { messages.dragged = false }, true)
    },
    // A drag takes the indenter along, or the mark on the curve: to another depth when pressing, else to the nearest state.
    drag(event) {
      const figure = event.origin, { name, x_range: x, y_range: y, inner_height } = figure
      // A box that is drawn to zoom is no drag.
      if (figure.toolbar.tools.some(({ type, active }) => type === "BoxZoomTool" && active)) return
      const { d, F, unit, pressing } = JSON.parse(dragging.path), wide = (range) => range.end - range.start
      const [begin, depth, pixel] = event.event_name === "panstart" ? [event.sy, d[player.value] * unit, wide(y) / inner_height] : figure.tags
      figure.setv({ tags: [begin, depth, pixel] }, { sync: false })
      const wish = Math.max(depth + (event.sy - begin) * pixel, 1e-3 * wide(y))
      const end = event.event_name === "panend"
      // Without a hold the finger scrolls the page, or the browser has cancelled the drag and its place is none.
      if (!figure.held && !end) return
      if (name === "springs" && pressing) {
        // One request at a time: the server empties it once it has drawn.
        if (figure.held && (end || dragging.depth === null)) dragging.depth = wish
      } else if (end) player.rest()
      else {
        const near = name === "springs" ? (k) => Math.abs(d[k] * unit - wish) / wide(y)
          : (k) => Math.hypot((d[k] - event.x) / wide(x), (F[k] - event.y) / wide(y))
        const away = d.map((_, k) => near(k) + 1e-4 * Math.abs(k - player.value))
        player.go(away.indexOf(Math.min(...away)))
      }
    },
    // A finger drags a plot by its mark alone, within 24 pixels of it; elsewhere it scrolls the page. A mouse drags anywhere.
    touch(figures, dragging) {
      window.dragging = dragging
      for (const figure of figures) {
        const at_mark = ({ clientX, clientY }) => {
          const frame = toolkit.frame(figure)
          const away = (x, y) => Math.hypot(clientX - frame.x.compute(x), clientY - frame.y.compute(y))
          return frame && figure.renderers.some(({ data_source: { data } }) => data.row?.some(
            (row, k) => ["handle", "now"].includes(row) && away(data.x[k], data.y[k]) < 24))
        }
        const el = toolkit.element(figure)
        el?.addEventListener("pointerdown", (event) => { figure.held = event.pointerType === "mouse" || at_mark(event) }, true)
        el?.addEventListener("pointercancel", () => { figure.held = false }, true)
        el?.addEventListener("touchstart", (event) => figure.held && event.preventDefault(), { passive: false })
      }
    },
    // A box is drawn once: then the plot is dragged again, and a finger scrolls the page. Other scripts hear the same end of a
    // drag, and are not to take the box for one.
    end_box({ origin }) {
      const [box] = origin.toolbar.tools.filter(({ type }) => type === "BoxZoomTool")
      setTimeout(() => { box.active = false })
    },
    // A double click on a plot shows the whole of it.
    whole({ origin }) {
      origin.reset.emit()
    },
    // A number at a logarithmic axis: both axes of a plot write it in the same way, 0.01 or 1000, and 10⁻⁵ beyond these.
    power(tick) {
      const power = Math.floor(Math.log10(tick) + 1e-9), mantissa = Number((tick / 10 ** power).toPrecision(3))
      if (power >= -3 && power <= 3) return String(Number(tick.toPrecision(6)))
      const raised = String(power).replace(/./g, (letter) => ({ "-": "⁻" })[letter] ?? "⁰¹²³⁴⁵⁶⁷⁸⁹"[letter])
      return `${mantissa === 1 ? "" : `${mantissa}·`}10${raised}`
    },
    // Colours of the data in the theme of the page: of each model a property, and its colours, light and dark.
    shade(looks) {
      const dark = Number(document.documentElement.classList.contains("dark"))
      for (const [model, name, colours] of looks) model.setv({ [name]: colours[dark] }, { sync: false })
    },
    // The button *Dark* of a page without a state of its own says which theme there is, and chooses the other one.
    theme_button(looks) {
      const button = all(document).find((each) => each.classList.contains("theme")).shadowRoot.querySelector("button")
      const show = () => {
        button.ariaPressed = document.documentElement.classList.contains("dark")
        pages.shade(looks)
      }
      button.addEventListener("click", () => {
        theme.choose(button.ariaPressed === "false")
        show()
      })
      show()
    },
    // The curve and its residuals as one picture; tags of the curve are the name of its file, and the text below it.
    async save_fit([force, residual]) {
      const { save } = await import(new URL("app/static/save.js", document.baseURI).href)
      const [name, caption] = force.tags, rows = force.renderers.map((each) => each.name)
      const plots = [
        { figure: force, place: [0, 0, 960, 464], look: { title: "Force and depth", rows } },
        { figure: residual, place: [0, 464, 960, 232], look: { title: "Residuals", rows: [] } },
      ]
      await save(name, caption, plots, [960, 720])
    },
    // Both ends of the range have their names.
    name_handles() {
      for (const slider of all(document).filter((each) => each.classList.contains("ends")))
        toolkit.name_handles(slider, ["First sample of the fit", "Last sample of the fit"])
    },
    // Scroll what has a class into view, once it is there.
    reveal(name, tries = 120) {
      const place = all(document).find((each) => each.classList.contains(name) && each.getClientRects().length)
      if (place) place.scrollIntoView({ block: "nearest" })
      else if (tries > 0) requestAnimationFrame(() => pages.reveal(name, tries - 1))
    },
    // Lead to the first field of what has a class, once it is there: a fold may have to open before.
    lead(name) {
      const lead = (tries) => {
        const place = all(document).find((each) => each.classList.contains(name) && each.getClientRects().length)
        const field = place && all(place.shadowRoot ?? place).find((each) => each.matches("input, select"))
        if (field) field.focus()
        else if (tries > 0) requestAnimationFrame(() => lead(tries - 1))
      }
      lead(120)
    },
  }
})()
