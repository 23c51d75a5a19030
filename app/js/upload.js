// A file, chosen or dropped. Its size is looked at first: a message that is too large ends the session.
export function render({ model, el }) {
  el.innerHTML = `<label for="file">${model.label}</label><input id="file" type="file" accept="${model.accept}">`
  const input = el.querySelector("input")
  input.addEventListener("change", async () => {
    const [file] = input.files
    if (!file) return
    const data = file.size > model.most ? null : await file.arrayBuffer()
    model.send_msg({ name: file.name, size: file.size, data })
    // Else a file of the same name is not read again.
    input.value = ""
  })
}
