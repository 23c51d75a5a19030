// What is above a plot: title, formula, buttons, legend. The browser saves its picture.
export function render({ model, el, view }) {
  el.innerHTML = `<div class="top"><div class="heading"><div class="formula"></div><div class="row"></div></div><div class="key"></div></div>`
  const [formula, row, key] = [".formula", ".row", ".key"].map((name) => el.querySelector(name))
  const figure = () => view.model.document.get_model_by_name(model.figure)
  const press = (k) => (model.shown[k][0] === "Save" ? save(figure(), model) : model.send_msg(k))
  const show = () => {
    if (formula.innerHTML !== model.formula) formula.innerHTML = model.formula
    if (key.innerHTML !== model.legend) key.innerHTML = model.legend
    fill(row, model.shown, press)
  }
  model.on(["formula", "legend", "shown"].map((name) => `change:${name}`), show)
  show()
}
