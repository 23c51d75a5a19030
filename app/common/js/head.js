// Dark or light before anything is drawn: as a link asks, else as was chosen in this browser, else as the system is. A
// cookie tells the server, which then draws the next page so from the start. A browser may refuse to keep either.
window.theme = (() => {
  const kept = (act) => { try { return act() } catch { return null } }
  const remember = (dark) => kept(() => {
    document.cookie = `dark=${Number(dark)}; path=${location.pathname}; max-age=31536000; samesite=lax`
  })
  const chosen = kept(() => localStorage.getItem("dark")), asked = new URLSearchParams(location.search).get("dark")
  const own = chosen === null ? matchMedia("(prefers-color-scheme: dark)").matches : chosen === "1"
  const show = (dark) => document.documentElement.classList.toggle("dark", dark)
  remember(own)
  show(asked === null ? own : asked === "1")
  return {
    own, asked: asked !== null, show,
    choose(dark) {
      show(dark)
      kept(() => localStorage.setItem("dark", dark ? "1" : "0"))
      remember(dark)
    },
  }
})()
// A page whose first websocket is refused says so: it stays empty otherwise. Later ones are those of a page that comes back.
window.WebSocket = class extends WebSocket {
  static first = true
  constructor(...given) {
    super(...given)
    const { first } = window.WebSocket
    window.WebSocket.first = false
    let opened = false
    this.addEventListener("open", () => { opened = true })
    this.addEventListener("close", () => {
      if (opened || !first) return
      const said = `The server does not answer this page: it is served for other addresses than ${location.host}. Open it at one of those, or start the server with --allow-websocket-origin ${location.host}`
      document.body.append(Object.assign(document.createElement("p"), { textContent: said, role: "alert", className: "refused" }))
    })
  }
}
