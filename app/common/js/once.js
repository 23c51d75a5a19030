// A box is drawn once: then the plot is dragged again, and a finger scrolls the page. Other scripts hear the same end of a
// drag, and are not to take the box for one.
const [box] = cb_obj.origin.toolbar.tools.filter(({ type }) => type === "BoxZoomTool")
setTimeout(() => { box.active = false })
