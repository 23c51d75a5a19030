// How the page talks to the server, and what it remembers.
const ANSWER = 4000

// Sends one message at a time; of the moves of one slider that wait, only the latest is sent.
function asker(send, lost, busy) {
  let [count, under, timer] = [0, null, null]
  const waiting = []
  const next = () => {
    clearTimeout(timer)
    under = waiting.shift() ?? null
    busy(under !== null)
    if (under === null) return
    timer = setTimeout(() => {
      lost()
      next()
    }, ANSWER)
    send({ ...under, n: (under.n = ++count) })
  }
  const ask = (message) => {
    const last = waiting[waiting.length - 1]
    if (message.do === "move" && last?.do === "move" && last.name === message.name) waiting.pop()
    waiting.push(message)
    if (under === null) next()
  }
  ask.answered = (n) => {
    if (under !== null && n === under.n) next()
  }
  // Whether something asked for is still on its way: all of a kind, or of one slider or choice.
  ask.pending = (kind, name) =>
    [under, ...waiting].some((each) => each?.do === kind && (name === undefined || each.name === name))
  return ask
}

function stored(name, otherwise) {
  try {
    return localStorage.getItem(name) ?? otherwise
  } catch {
    return otherwise
  }
}

function store(name, value) {
  try {
    localStorage.setItem(name, value)
  } catch {
    // Where nothing may be stored the choice holds for this visit.
  }
}
