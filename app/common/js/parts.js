// Render parts of the page with a script that the browser loads once.
const { render } = await import(new URL("app/static/parts.js", document.baseURI).href)
export { render }
