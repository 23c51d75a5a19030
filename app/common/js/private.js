// Private ends of Bokeh in the browser, which may move with any version. Each is used here alone, beside what it gains; the
// page works without each of them, with one line in the console. Other scripts find them as `toolkit`.
window.toolkit = (() => {
  const told = new Set()
  const missing = (name, lost) => {
    if (!told.has(name)) console.warn(`${name} is not there in this version of Bokeh; ${lost}`)
    told.add(name)
    return null
  }
  // A part of an object by its name, null without the object, or where the part has moved.
  const end = (from, name, lost) => (from ? from[name] ?? missing(name, lost) : null)
  const call = (from, name, lost, ...given) => (typeof end(from, name, lost) === "function" ? from[name](...given) : null)
  const all = (root) => [...root?.querySelectorAll("*") ?? []].flatMap((each) => [each, ...all(each.shadowRoot)])
  // All of what is drawn of a model. Without it plots are neither dragged nor saved.
  const view = (model) => call(window.Bokeh?.index, "find_one", "plots are neither dragged nor saved", model)
  const element = (model) => end(view(model), "el", "plots are not dragged")
  return {
    // Where a model is on the page: what is done there is done to it.
    element,
    // The figures of a document, which are laid out again.
    figures: (document) => [...end(document, "all_models", "a plot stays as high as it was when a note is opened") ?? []].filter(({ type }) => type === "Figure"),
    // The box inside the axes of a plot, in pixels of the window, and its scales, which turn values to such pixels and back:
    // a spring is told, and a finger takes hold of a mark.
    frame(figure) {
      const lost = "springs say nothing", on = element(figure), frame = end(view(figure), "frame", lost)
      const [box, x, y] = ["bbox", "x_scale", "y_scale"].map((name) => end(frame, name, lost))
      if (!(on && box && x && y)) return null
      const { left, top } = on.getBoundingClientRect()
      const moved = (scale, by) => ({ compute: (value) => by + scale.compute(value), invert: (place) => scale.invert(place - by) })
      const edges = { left: left + box.left, right: left + box.right, top: top + box.top, bottom: top + box.bottom }
      return { ...edges, x: moved(x, left), y: moved(y, top) }
    },
    // A played state is painted in every frame of the screen; by itself Bokeh paints at most every second one.
    paint: (figure) => call(view(figure), "repaint", "what is played is painted in every second frame"),
    // A plot takes the height that is left beside a note; Bokeh does not see a change of a few pixels.
    lay_out: (figure) => call(view(figure), "invalidate_layout", "a plot stays as high as it was when a note is opened"),
    // Width and height of a plot: a picture is taken once it has its size.
    size(figure) {
      const box = end(view(figure), "bbox", "a picture waits for a second until its plot has its size")
      return box && [box.width, box.height]
    },
    // The canvas of a plot as it is drawn anew: a picture has two pixels a point. Without it, what is on the screen.
    picture(figure) {
      const layer = call(view(figure), "export", "a picture has the pixels of the screen", "png", true)
      return layer?.canvas ?? all(element(figure)?.shadowRoot).find((each) => each.matches("canvas")) ?? null
    },
    // Whether an element is what hears the pointer on a plot: what is dragged keeps its axes.
    is_canvas: (element) => element.matches(".bk-events"),
    // A canvas, on which no key does anything, is no tab stop, and buttons of tools say that they are.
    tidy(figure) {
      const on = element(figure), parts = all(on?.shadowRoot), canvas = parts.find((each) => each.matches(".bk-events"))
      if (canvas) canvas.tabIndex = -1
      else if (on) missing(".bk-events", "a canvas is a tab stop")
      for (const each of parts) if (each.tabIndex === 0 && each.title && !each.matches("button, a")) each.role = "button"
    },
    // Both handles of a slider have names.
    name_handles(within, names) {
      const handles = all(within.shadowRoot).filter((each) => each.matches(".noUi-handle"))
      if (handles.length !== names.length) missing(".noUi-handle", "handles of sliders have no names")
      handles.forEach((each, k) => { each.ariaLabel = names[k] })
    },
  }
})()
