// The start of the explorer: Python and its packages are loaded side by side, then imported one after the other, with a
// bar, over a drawing of the opening scene that plays by itself; the page takes its place.
const panel = document.getElementById("start"), said = panel.querySelector("p"), bar = panel.querySelector("i")
const here = (path) => new URL(path, document.baseURI).href
// The browser paints between the steps.
const painted = () => new Promise((done) => requestAnimationFrame(() => setTimeout(done)))
const tell = async (share, text, seconds) => {
  said.textContent = text
  bar.style.transitionDuration = `${seconds}s`
  bar.style.transform = `scaleX(${share})`
  await painted()
}

// A link to another scene would be shown a wrong picture.
if ([...asked.keys()].every((name) => name === "dark")) {
  const first = Object.assign(document.createElement("iframe"), { src: "first.html", title: "Opening scene" })
  first.onload = () => {
    const { documentElement, body } = first.contentDocument
    if (documentElement.classList.contains("dark") !== document.documentElement.classList.contains("dark")) body.querySelector("#dark").click()
  }
  panel.append(first)
}
try {
  await tell(0.4, "Loading Python …", 5)
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
  await python.pyimport("app.browser").start(location.search.slice(1), theme.own)
  panel.remove()
} catch (error) {
  said.role = "alert"
  said.textContent = `The explorer could not be started in this browser: ${String(error.message ?? error).trim().split("\n").pop()}`
  throw error
}
