// Colours of the data in the theme of the page: of each model a property, and its colours, light and dark.
const dark = Number(document.documentElement.classList.contains("dark"))
for (const [model, name, colours] of looks) model.setv({ [name]: colours[dark] }, { sync: false })
