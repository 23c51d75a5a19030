// What is taken away: plots with title and legend, texts as files or to copy, and files that are brought.
const LARGEST_FILE = 2_000_000
const HEAD = 44

function save(name, content, type) {
  const url = URL.createObjectURL(content instanceof Blob ? content : new Blob([content], { type }))
  make("a", { href: url, download: name }).click()
  setTimeout(() => URL.revokeObjectURL(url), 1000)
}

function svgText(text) {
  return text.replace(/[&<>"]/g, (sign) => `&#${sign.charCodeAt(0)};`)
}

// A line of text with its indices small and low.
function svgLine(text) {
  const index = (part) => `<tspan dy="3" font-size="8">${part}</tspan><tspan dy="-3">\u200b</tspan>`
  return indexed(text)
    .map((part, k) => (k % 2 ? index(svgText(part)) : svgText(part)))
    .join("")
}

// Title and legend of a plot as the content of an SVG.
function headSvg(plot, width, dark) {
  const font = "font-family='Helvetica, Arial, sans-serif'"
  const ink = shade("#22272e", dark)
  let x = 10
  const entries = plot.legend.map((entry) => {
    const at = x
    x += 34 + 6.2 * entry.label.length
    const text = `<text x="25" y="10" font-size="11" ${font} fill="${ink}">${svgLine(entry.label)}</text>`
    return `<g transform="translate(${at} 25)">${swatch(entry, dark)}${text}</g>`
  })
  const ground = `<rect width="${width}" height="${HEAD}" fill="${shade("#ffffff", dark)}"/>`
  const bold = `font-size="13" font-weight="600" ${font} fill="${ink}"`
  return `${ground}<text x="10" y="17" ${bold}>${svgText(plot.title)}</text>${entries.join("")}`
}

// The mark of a legend entry, 20 by 12.
function swatch(entry, dark) {
  const colour = shade(entry.colour, dark)
  if (entry.mark === "line") {
    const stroke = `stroke-width="${entry.width}" stroke-dasharray="${entry.dash.join(" ")}"`
    return `<line x1="0" x2="20" y1="6" y2="6" stroke="${colour}" ${stroke}/>`
  }
  if (entry.mark === "dot") {
    const edge = `stroke="${shade(entry.edge, dark)}"`
    return `<circle cx="10" cy="6" r="4.5" fill="${colour}" ${edge}/>`
  }
  const hatch = entry.hatch ? `<path d="M1 12 7 0M7 12 13 0M13 12 19 0" stroke="${colour}"/>` : ""
  return `<rect width="20" height="12" fill="${colour}" fill-opacity="${entry.alpha}"/>${hatch}`
}

function wrapped(width, height, content) {
  const names = 'xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'
  return `<svg ${names} width="${width}" height="${height}">${content}</svg>`
}

function saveSvg(plot, view, dark) {
  const { width, height } = view.bbox
  const body = view.export("svg").ctx.get_serialized_svg(true)
  const content = `${headSvg(plot, width, dark)}<g transform="translate(0 ${HEAD})">${body}</g>`
  save(`${plot.name}.svg`, wrapped(width, height + HEAD, content), "image/svg+xml")
}

async function savePng(plot, view, dark) {
  const body = view.export("png", true).canvas
  const { width, height } = view.bbox
  const ratio = body.width / width
  const canvas = make("canvas")
  canvas.width = body.width
  canvas.height = Math.round((height + HEAD) * ratio)
  const context = canvas.getContext("2d")
  const head = new Image()
  const drawing = encodeURIComponent(wrapped(width, HEAD, headSvg(plot, width, dark)))
  head.src = `data:image/svg+xml;charset=utf-8,${drawing}`
  await head.decode()
  context.drawImage(head, 0, 0, canvas.width, Math.round(HEAD * ratio))
  context.drawImage(body, 0, Math.round(HEAD * ratio))
  canvas.toBlob((blob) => save(`${plot.name}.png`, blob))
}

// A text to read and to copy.
function textDialog(title, text) {
  const area = make("textarea", { readonly: "", spellcheck: false, "aria-label": title }, text)
  const copy = make("button", { type: "button" }, "Copy")
  const close = make("button", { type: "button" }, "Close")
  const dialog = make(
    "dialog",
    { "aria-label": title },
    make("h2", {}, title),
    area,
    make("div", { class: "buttons" }, copy, close),
  )
  copy.addEventListener("click", async () => {
    area.select()
    try {
      await navigator.clipboard.writeText(text)
    } catch {
      // Where the page may not reach the clipboard the selection is copied.
      document.execCommand("copy")
    }
    copy.textContent = "Copied"
  })
  close.addEventListener("click", () => dialog.close())
  dialog.addEventListener("close", () => dialog.remove())
  return dialog
}

// A button that brings a text file.
function bring(label, accept, take, refuse) {
  const input = make("input", { type: "file", accept, "aria-label": label, hidden: true })
  const button = make("button", { type: "button" }, label)
  button.addEventListener("click", () => input.click())
  input.addEventListener("change", async () => {
    const [file] = input.files
    if (!file) return
    if (file.size > LARGEST_FILE) refuse("The file is larger than 2 MB.")
    else take(await file.text())
    input.value = ""
  })
  return make("span", {}, button, input)
}
