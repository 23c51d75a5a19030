// The start of the explorer. It loads Python and its packages in parallel, then imports them one after the other, with a
// bar. Meanwhile a drawing of a scene plays, which needs no Python; then the page replaces it.
const panel = document.getElementById("start"), said = panel.querySelector("p"), bar = panel.querySelector("i")
const here = (path) => new URL(path, document.baseURI).href
// The browser paints between the steps; a page that is not seen is not painted.
const painted = () => new Promise((done) => {
  requestAnimationFrame(() => setTimeout(done))
  setTimeout(done, 300)
})
const tell = async (share, text, seconds) => {
  said.textContent = text
  bar.style.transitionDuration = `${seconds}s`
  bar.style.transform = `scaleX(${share})`
  await painted()
}

// The first picture is drawn before anything else. There is one of each preset as it is; any other scene is announced over
// the opening one, which nobody may take for it.
const appended = new RegExp(`^(?:${settings.appended})$`, "i")
const told = [...asked].filter(([name]) => name !== "dark" && !appended.test(name))
const [[name, value] = ["preset", settings.presets[0]], ...others] = told
const known = name === "preset" && settings.presets.includes(value) && !others.length
const follows = Object.assign(document.createElement("p"), { className: "follows", textContent: "Your scene follows" })
const drawn = new Promise((done) => {
  const src = `drawings/${known ? value : settings.presets[0]}.html`
  const first = Object.assign(document.createElement("iframe"), { src, title: known ? "Drawing of this scene" : "Opening scene", inert: !known })
  first.onload = () => {
    const page = first.contentDocument, player = page?.getElementById("player")
    const dark = (each) => each?.documentElement.classList.contains("dark")
    const ready = () => {
      if (dark(page) !== dark(document)) page?.getElementById("dark")?.click()
      painted().then(done)
    }
    // The player comes last, once the button hears; Python would keep it waiting.
    if (!player || player.firstChild) ready()
    else new MutationObserver(ready).observe(player, { childList: true })
  }
  setTimeout(done, 5000)
  panel.append(first)
  if (!known) panel.append(follows)
})
// Scripts of the page, in their order.
const script = (src) => new Promise((onload, onerror) => document.head.append(Object.assign(document.createElement("script"), { src, onload, onerror, async: false })))
try {
  await drawn
  await tell(0.4, "Loading Python …", 5)
  const scripts = Promise.all(settings.scripts.map(script))
  const [{ loadPyodide }, sources] = await Promise.all([
    import(here(settings.pyodide + "pyodide.mjs")),
    fetch("explorer.zip").then((answer) => answer.arrayBuffer()),
  ])
  const python = await loadPyodide({
    indexURL: here(settings.pyodide), packages: settings.compiled,
    // Where Panel finds its style sheets and scripts.
    env: { HOME: "/home/pyodide", PANEL_CDN_ROOT: here("static/panel/"), PANEL_NPM_CDN: here("static/npm").replace(/\/$/, "") },
  })
  python.unpackArchive(sources, "zip", { extractDir: "/explorer" })
  python.runPython("import sys; sys.path.insert(0, '/explorer')")
  for (const [share, module, text, seconds] of settings.imports) {
    await tell(share, `${text} …`, seconds)
    python.runPython(`import ${module}`)
  }
  await tell(1, "Drawing …", 1)
  await scripts
  await python.pyimport("app.explorer.browser").start(location.search.slice(1), theme.own)
  panel.remove()
} catch (error) {
  follows.remove()
  said.role = "alert"
  said.textContent = `The explorer could not be started in this browser: ${String(error.message ?? error).trim().split("\n").pop()}`
  throw error
}
