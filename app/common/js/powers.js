// A number at a logarithmic axis: both axes of a plot write it in the same way, 0.01 or 1000, and 10⁻⁵ beyond these.
const power = Math.floor(Math.log10(tick) + 1e-9), mantissa = Number((tick / 10 ** power).toPrecision(3))
if (power >= -3 && power <= 3) return String(Number(tick.toPrecision(6)))
const raised = String(power).replace(/./g, (letter) => ({ "-": "⁻" })[letter] ?? "⁰¹²³⁴⁵⁶⁷⁸⁹"[letter])
return `${mantissa === 1 ? "" : `${mantissa}·`}10${raised}`
