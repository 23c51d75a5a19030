// The buttons above the plots, and the frame around each of them.
function toolbar(page) {
  const button = (text, title, act) => {
    const node = make("button", { type: "button", title }, text)
    node.addEventListener("click", act)
    return node
  }
  page.buttons = {
    undo: button("Undo", "Undo the last change (Z)", () => page.ask({ do: "undo" })),
    redo: button("Redo", "Do it again (Y)", () => page.ask({ do: "redo" })),
    reset: button("Reset", "Back to the preset (R)", () => page.ask({ do: "reset" })),
    hold: button("Hold", "Hold these curves to compare with the next (H)", () =>
      page.askHere({ do: "hold" }),
    ),
    map: button("Map", "Pressure over the plane (M)", () => page.toggle("map")),
    speed: button("Speed", "Speed against error of the models (S)", () => page.toggle("speed")),
    theme: button("Dark", "Light or dark (D)", () => page.toggleTheme()),
  }
  const file = (text, what, title) => button(text, title, () => page.askHere({ do: "file", what }))
  const menu = make(
    "details",
    { class: "menu" },
    make("summary", {}, "Take with you"),
    make(
      "div",
      {},
      file("Curves as CSV", "curves", "Every state along the way"),
      file("Pressure as CSV", "pressure", "Stress and line load of this state"),
      file("Scene as JSON", "scene", "To load here or with mdr.Scene.from_json"),
      file("Copy as Python", "python", "A snippet that comes to this state"),
      button("Copy link", "A link to this page as it is", () => page.showLink()),
      bring(
        "Load a scene (JSON)",
        ".json,application/json",
        (text) => page.ask({ do: "upload", kind: "scene", text }),
        (why) => page.notify(why),
      ),
      bring(
        "Load a tip (CSV: r, z)",
        ".csv,.txt,text/csv",
        (text) => page.ask({ do: "upload", kind: "tip", text }),
        (why) => page.notify(why),
      ),
    ),
  )
  menu.addEventListener("click", (event) => {
    if (event.target.tagName === "BUTTON") menu.open = false
  })
  page.heldNote = make("span", { class: "note" })
  return make(
    "div",
    { class: "toolbar", role: "toolbar", "aria-label": "Page" },
    ...Object.values(page.buttons),
    menu,
    page.heldNote,
  )
}

function tile(page, plot) {
  const [number, math] = page.given.equations[plot.equation]
  const formula = make("span", { class: "formula" })
  formula.innerHTML = math
  const saved = (text, act) => {
    const node = make(
      "button",
      { type: "button", class: "save", title: `Save “${plot.title}” as ${text}` },
      text,
    )
    node.addEventListener("click", () => act(plot, page.plots.view(plot.name), page.dark))
    return node
  }
  const legend = make("ul", { class: "legend" })
  legend.append(
    ...plot.legend.map(({ label }) => {
      const name = indexed(label).map((part, k) => (k % 2 ? make("sub", {}, part) : part))
      const entry = make("li", { "data-layer": label }, make("span", {}, ...name))
      entry.insertAdjacentHTML("afterbegin", '<svg width="20" height="12" aria-hidden="true"></svg>')
      return entry
    }),
  )
  const head = make(
    "header",
    {},
    make("h3", {}, plot.title),
    formula,
    make("small", {}, number),
    saved("PNG", savePng),
    saved("SVG", saveSvg),
  )
  return make(
    "article",
    { class: "tile", "data-plot": plot.name, "aria-label": plot.title },
    head,
    legend,
    make("div", { class: "plot" }),
  )
}
