// Parts of the page are made by a script that is sent once.
const { render } = await import(new URL("app/static/parts.js", document.baseURI).href)
export { render }
