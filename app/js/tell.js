// The address says what is shown, without a step in the history; or light and dark, for all that the sheet colours.
const { address, dark } = cb_obj
if (address) history.replaceState(null, "", address)
document.documentElement.classList.toggle("dark", dark)
