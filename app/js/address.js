// The address says what is shown, without a step in the history.
history.replaceState(null, "", cb_obj.tags[0])
