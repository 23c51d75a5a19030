// Private names of Bokeh in the browser, which any version may change. Only this file uses them. The page works without
// each of them, with a warning in the console that names the lost function. Other scripts use them as `toolkit`.
window.toolkit = (() => {
  const reported = new Set()
  const missing = (name, lost) => {
    if (!reported.has(name)) console.warn(`${name} is not there in this version of Bokeh; ${lost}`)
    reported.add(name)
    return null
  }
  // A part of an object by its name; null without the object or the part.
  const end = (from, name, lost) => (from ? from[name] ?? missing(name, lost) : null)
  const call = (from, name, lost, ...given) => (typeof end(from, name, lost) === "function" ? from[name](...given) : null)
  const all = (root) => [...root?.querySelectorAll("*") ?? []].flatMap((each) => [each, ...all(each.shadowRoot)])
  // The view of a model.
  const view = (model) => call(window.Bokeh?.index, "find_one", "plots are neither dragged nor saved", model)
  const element = (model) => end(view(model), "el", "plots are not dragged")
  return {
    // The element of a model, for events and places.
    element,
    // The figures of a document.
    figures: (document) => [...end(document, "all_models", "an opened note does not change the height of a plot") ?? []].filter(({ type }) => type === "Figure"),
    // The box inside the axes of a plot, in pixels of the window, and its scales between values and pixels. They find the
    // spring under the pointer and the mark under a finger.
    frame(figure) {
      const lost = "springs show no values", on = element(figure), frame = end(view(figure), "frame", lost)
      const [box, x, y] = ["bbox", "x_scale", "y_scale"].map((name) => end(frame, name, lost))
      if (!(on && box && x && y)) return null
      const { left, top } = on.getBoundingClientRect()
      const moved = (scale, by) => ({ compute: (value) => by + scale.compute(value), invert: (place) => scale.invert(place - by) })
      const edges = { left: left + box.left, right: left + box.right, top: top + box.top, bottom: top + box.bottom }
      return { ...edges, x: moved(x, left), y: moved(y, top) }
    },
    // Paint a played state in every frame of the screen; Bokeh alone paints at most every second frame.
    paint: (figure) => call(view(figure), "repaint", "the player paints only every second frame"),
    // Fit a plot to the height next to a note; Bokeh does not notice a change of a few pixels.
    lay_out: (figure) => call(view(figure), "invalidate_layout", "an opened note does not change the height of a plot"),
    // Width and height of a plot; a picture needs a plot that has its size.
    size(figure) {
      const box = end(view(figure), "bbox", "a picture waits for a second until its plot has its size")
      return box && [box.width, box.height]
    },
    // A newly drawn canvas of a plot, with two pixels per point. Without it, the canvas on the screen.
    picture(figure) {
      const layer = call(view(figure), "export", "a picture has the pixels of the screen", "png", true)
      return layer?.canvas ?? all(element(figure)?.shadowRoot).find((each) => each.matches("canvas")) ?? null
    },
    // Whether an element receives the pointer events of a plot; a drag there keeps the axes.
    is_canvas: (element) => element.matches(".bk-events"),
    // Remove the canvas, which has no keys, from the tab stops, and give the tools the role of buttons.
    tidy(figure) {
      const on = element(figure), parts = all(on?.shadowRoot), canvas = parts.find((each) => each.matches(".bk-events"))
      if (canvas) canvas.tabIndex = -1
      else if (on) missing(".bk-events", "a canvas is a tab stop")
      for (const each of parts) if (each.tabIndex === 0 && each.title && !each.matches("button, a")) each.role = "button"
    },
    // Name both handles of a slider.
    name_handles(within, names) {
      const handles = all(within.shadowRoot).filter((each) => each.matches(".noUi-handle"))
      if (handles.length !== names.length) missing(".noUi-handle", "handles of sliders have no names")
      handles.forEach((each, k) => { each.ariaLabel = names[k] })
    },
  }
})()
