// The value of a field is copied, also where the browser gives a page no clipboard, as one that is not served over https.
const area = Object.assign(document.createElement("textarea"), { value: field.value })
document.body.append(area)
area.select()
document.execCommand("copy")
area.remove()
