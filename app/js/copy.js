// Copies the text of a field.
navigator.clipboard?.writeText(area.value).catch(() => {})
cb_obj.label = "Copied"
setTimeout(() => { cb_obj.label = "Copy" }, 1500)
