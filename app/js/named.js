// What a script is about, by name: arguments of the script would be searched with each part of the page that has it.
const figure = cb_obj.origin
const [messages, state, play, ...figures] = ["messages", "state", "play", "springs", "pressure", "force"].map(
  (name) => (figure ?? cb_obj).document.get_model_by_name(name))
