// Scripts of both pages: functions that callbacks of Bokeh and Panel call by name.
window.pages = (() => {
  const all = (root) => [...root.querySelectorAll("*")].flatMap((each) => [each, ...(each.shadowRoot ? all(each.shadowRoot) : [])])
  return {
    // Reload the page from its address once a lost server answers again.
    again() {
      const later = () => setTimeout(() => fetch(location.href).then((r) => (r.ok ? location.reload() : later()), later), 1000)
      later()
    },
    // Tidy a plot once it has its size and its canvas.
    tidy(figure) {
      window.toolkit?.tidy(figure)
    },
    // Copy the value of a field, even without a clipboard, which browsers only give to pages served over https.
    copy(field) {
      const area = Object.assign(document.createElement("textarea"), { value: field.value })
      document.body.append(area)
      area.select()
      document.execCommand("copy")
      area.remove()
    },
    // Set landmarks of a page by class, role and name. The first tab stop is a link to the element with the class `to`.
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
      // Also mark elements that the user opens later.
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
    // Set up the keys of undo and Escape, the theme, and the address.
    start(messages) {
      // The server has drawn the theme of the cookie; a first visit has no cookie.
      if (!theme.asked) messages.dark = theme.own
      theme.show(messages.dark)
      messages.properties.dark.change.connect(() => theme.choose(messages.dark))
      // All letters are larger on a wide screen, also those of the plots.
      const measure = () => { messages.wide = innerWidth >= 1600 }
      measure()
      addEventListener("resize", measure)
      // Put the present scene into the address, without an entry in the history.
      messages.properties.address.change.connect(() => {
        // The opening scene has no query; remove its question mark.
        if (messages.address) history.replaceState(null, "", messages.address === "?" ? location.pathname : messages.address)
      })
      document.addEventListener("keydown", (event) => {
        const on = event.composedPath()[0]
        // In a text field the keys edit the text. Escape restores a number field, and closes a panel with another field.
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
          // The browser closes popovers. A panel over the plots comes first, so it closes before a large plot below it.
          return void (open.some(({ popover }) => popover) || open[0]?.click())
        }
        if (key === "z") act("Undo")
      })
      // Redraw plots after small changes of height, for example by an opened note.
      let before = null
      new ResizeObserver(([{ contentRect: { height } }]) => {
        if (before !== null) toolkit.figures(messages.document).forEach(toolkit.lay_out)
        before = height
      }).observe(all(document).find((each) => each.shadowRoot && each.classList.contains("plots")))
    },
    // Track whether the user drags a slider or the indenter.
    watch(messages) {
      document.addEventListener("pointerdown", (event) => {
        const [on, ...within] = event.composedPath(), { held } = messages.document.get_model_by_name("springs")
        const springs = held && toolkit.is_canvas(on) && within.some((each) => each.classList?.contains("springs"))
        messages.dragged = springs || on.matches(".number [type=range]")
      })
      for (const name of ["pointerup", "pointercancel"]) document.addEventListener(name, () => { messages.dragged = false }, true)
    },
    // Move the indenter, or the mark on the curve, with a drag: to another depth when pressing, else to the nearest state.
    drag(event) {
      const figure = event.origin, { name, x_range: x, y_range: y, inner_height } = figure
      // The user draws a zoom box.
      if (figure.toolbar.tools.some(({ type, active }) => type === "BoxZoomTool" && active)) return
      const { d, F, unit, pressing } = JSON.parse(dragging.path), wide = (range) => range.end - range.start
      const [begin, depth, pixel] = event.event_name === "panstart" ? [event.sy, d[player.value] * unit, wide(y) / inner_height] : figure.tags
      figure.setv({ tags: [begin, depth, pixel] }, { sync: false })
      const wish = Math.max(depth + (event.sy - begin) * pixel, 1e-3 * wide(y))
      const end = event.event_name === "panend"
      // Without a hold the finger scrolls the page, or the browser has cancelled the drag and its position is null.
      if (!figure.held && !end) return
      if (name === "springs" && pressing) {
        // One request at a time: the server sets it to null after drawing.
        if (figure.held && (end || dragging.depth === null)) dragging.depth = wish
      } else if (end) player.rest()
      else {
        const near = name === "springs" ? (k) => Math.abs(d[k] * unit - wish) / wide(y)
          : (k) => Math.hypot((d[k] - event.x) / wide(x), (F[k] - event.y) / wide(y))
        const away = d.map((_, k) => near(k) + 1e-4 * Math.abs(k - player.value))
        player.go(away.indexOf(Math.min(...away)))
      }
    },
    // Let a finger drag only within 24 pixels of the mark; elsewhere it scrolls the page. A mouse drags anywhere.
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
    // End the zoom after one box, so that the user can drag and scroll again. The delay hides the box from other scripts that
    // handle the end of the same drag.
    end_box({ origin }) {
      const [box] = origin.toolbar.tools.filter(({ type }) => type === "BoxZoomTool")
      setTimeout(() => { box.active = false })
    },
    // Show the whole plot after a double click.
    whole({ origin }) {
      origin.reset.emit()
    },
    // Format a number of a logarithmic axis, the same on both axes: 0.01 or 1000, and 10⁻⁵ beyond these.
    power(tick) {
      const power = Math.floor(Math.log10(tick) + 1e-9), mantissa = Number((tick / 10 ** power).toPrecision(3))
      if (power >= -3 && power <= 3) return String(Number(tick.toPrecision(6)))
      const raised = String(power).replace(/./g, (letter) => ({ "-": "⁻" })[letter] ?? "⁰¹²³⁴⁵⁶⁷⁸⁹"[letter])
      return `${mantissa === 1 ? "" : `${mantissa}·`}10${raised}`
    },
    // Set the data colours of the theme; each entry has a model, its property, and the colours in light and dark.
    shade(looks) {
      const dark = Number(document.documentElement.classList.contains("dark"))
      for (const [model, name, colours] of looks) model.setv({ [name]: colours[dark] }, { sync: false })
    },
    // Make the button *Dark* show and change the theme, on a page without a state.
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
    // Save the curve and its residuals as one picture; the tags of the curve are the file name and the caption.
    async save_fit([force, residual]) {
      const { save } = await import(new URL("app/static/save.js", document.baseURI).href)
      const [name, caption] = force.tags, rows = force.renderers.map((each) => each.name)
      const plots = [
        { figure: force, place: [0, 0, 960, 464], look: { title: "Force and depth", rows } },
        { figure: residual, place: [0, 464, 960, 232], look: { title: "Residuals", rows: [] } },
      ]
      await save(name, caption, plots, [960, 720])
    },
    // Name both handles of the range slider.
    name_handles() {
      for (const slider of all(document).filter((each) => each.classList.contains("ends")))
        toolkit.name_handles(slider, ["First sample of the fit", "Last sample of the fit"])
    },
    // Scroll the element with a class into view, once it exists.
    reveal(name, tries = 120) {
      const place = all(document).find((each) => each.classList.contains(name) && each.getClientRects().length)
      if (place) place.scrollIntoView({ block: "nearest" })
      else if (tries > 0) requestAnimationFrame(() => pages.reveal(name, tries - 1))
    },
    // Focus the first field of the element with a class, once it exists: a fold may have to open before.
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
