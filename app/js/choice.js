// A choice of options: radio buttons or a list, with an explanation in a popover.
export function render({ model, el }) {
  const about = `<div popover id="about">${model.about}</div>`
  el.innerHTML = model.radio
    ? `<div class="radio"><button class="word" popovertarget="about">${model.label}</button>${about}<div class="options"></div></div>`
    : `<div class="list"><label for="list">${model.label}</label><select id="list"></select>
      <button class="help" aria-label="What is ${model.label}?" popovertarget="about">?</button>${about}</div>`
  const list = el.querySelector(model.radio ? ".options" : "select")
  let asked = model.answered
  const choose = (option) => {
    asked += 1
    model.send_msg(option)
  }
  const filled = () => {
    list.replaceChildren(...model.options.map(([option, text]) => {
      if (!model.radio) return new Option(text, option)
      const label = document.createElement("label")
      label.innerHTML = `<input type="radio" name="of">`
      label.append(text)
      Object.assign(label.firstChild, { value: option, onchange: () => choose(option) })
      return label
    }))
    show()
  }
  // Also what was refused is answered: the present option stands again. Earlier answers do not touch what is asked now.
  const show = () => {
    if (model.answered < asked) return
    if (model.radio) for (const { firstChild } of list.children) firstChild.checked = firstChild.value === model.value
    else list.value = model.value
  }
  if (!model.radio) list.onchange = () => choose(list.value)
  model.on("change:options", filled)
  model.on(["value", "answered"].map((what) => `change:${what}`), show)
  filled()
}
