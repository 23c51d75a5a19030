// Choose dark or light before the page is drawn: from the link, else from the last choice in this browser, else from the
// system. A cookie lets the server draw the next page in this theme. A browser may block cookies and storage.
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
// Show an error if the server rejects the first websocket: the page would stay empty. Later sockets are reconnections.
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
      const message = `The server does not answer this page: it does not accept the address ${location.host}. Open the page at an accepted address, or start the server with --allow-websocket-origin ${location.host}`
      document.body.append(Object.assign(document.createElement("p"), { textContent: message, role: "alert", className: "refused" }))
    })
  }
}
