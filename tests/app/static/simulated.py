"""The start of the page as in a browser, with stand-ins for what a browser has.

It is run with a query, where the sources of a static folder are on the path, and prints as JSON the roots
that Bokeh was given, what the page says and has for its address, and packages from elsewhere.
"""

import asyncio
import json
import sys
from types import ModuleType, SimpleNamespace
from unittest.mock import AsyncMock, MagicMock


class Place(SimpleNamespace):
    """An element of the page, in which a root is drawn."""

    def __init__(self):
        super().__init__(style=SimpleNamespace(), kept={})

    def setAttribute(self, name, value):
        self.kept[name] = value

    def getAttribute(self, name):
        return self.kept[name]


def stand_in(name, **parts):
    module = ModuleType(name)
    module.__dict__.update(parts)
    sys.modules[name] = module
    return module


def browser():
    """Stand-ins for JavaScript and Pyodide; what is embedded is returned."""
    js, places = MagicMock(), []
    js.document.createElement = lambda kind: Place()
    js.document.body.append = places.append
    js.document.querySelectorAll = lambda wanted: places
    js.JSON.parse = json.loads
    js.JSON.stringify = lambda location: json.dumps({"href": "http://localhost:8000/", "pathname": "/"})
    js.window.Bokeh.embed.embed_items = AsyncMock(return_value=[MagicMock(roots=[MagicMock()])])
    sys.modules["js"] = js
    ffi = stand_in("pyodide.ffi", create_proxy=lambda act: act, to_js=MagicMock())
    code = stand_in("pyodide.code", run_js=MagicMock())
    stand_in("pyodide", ffi=ffi, code=code)
    # By this name Panel knows that it is in a browser.
    stand_in("_pyodide")
    return js.window.Bokeh.embed.embed_items


async def main(query):
    embedded = browser()
    from app.explorer.browser import start

    await start(query, False)
    documents, items = embedded.call_args.args
    (document,) = documents.values()
    text = json.dumps(document)
    files = [getattr(module, "__file__", None) or "" for module in list(sys.modules.values())]
    elsewhere = sorted({path.partition("site-packages/")[2].split("/")[0] for path in files})
    found = {"roots": [root["name"] for root in document["roots"]], "elsewhere": elsewhere}
    print(json.dumps(found | {"places": len(items[0]["roots"]), "text": text}))


asyncio.run(main(sys.argv[1]))
