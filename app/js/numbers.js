// Numbers as in a paper: units that fit, significant digits. The scripts of this folder are one module.
const RAISED = Object.fromEntries([..."-0123456789"].map((digit, k) => [digit, "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"[k]]))

function digits(value, count = 4) {
  if (!Number.isFinite(value)) return value > 0 ? "∞" : "–"
  if (value === 0) return "0"
  const size = Math.abs(value)
  if (size >= 1e-3 && size < 1e5) {
    const rounded = Number(value.toExponential(count - 1))
    const places = Math.max(count - 1 - Math.floor(Math.log10(Math.abs(rounded))), 0)
    return rounded.toFixed(places).replace("-", "−")
  }
  const [mantissa, exponent] = value.toExponential(count - 1).split("e")
  const power = String(Number(exponent)).replace(/./g, (digit) => RAISED[digit])
  return `${mantissa} × 10${power}`.replace("-", "−")
}

// The parts of a text by turns plain and an index, as in σ_zz.
function indexed(text) {
  return text.split(/_([a-z0-9]+)/)
}

// The unit of a kind in which a value in SI has one to three digits before the point.
function fitting(units, value) {
  const size = Number.isFinite(value) ? Math.abs(value) : 0
  if (size === 0) return units.find(([, factor]) => factor === 1) ?? units[0]
  return units.findLast(([, factor]) => factor <= size * (1 + 1e-9)) ?? units[0]
}

// A value in SI as a pair of its digits and its unit.
function written(units, value, count = 4) {
  if (value === 0 || !Number.isFinite(value)) return [digits(value), ""]
  const [name, factor] = fitting(units, value)
  return [digits(value / factor, count), name]
}
