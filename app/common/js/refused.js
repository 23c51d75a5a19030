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
