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
