// A plot has got its size, and with it its canvas.
window.toolkit?.tidy(cb_obj)
