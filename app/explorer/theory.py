"""The theory, assets/theory.md, as a static page."""

import re
from base64 import b64encode
from html import escape
from pathlib import Path
from string import Template

import panel
from markdown_it import MarkdownIt
from mdit_py_plugins.dollarmath import dollarmath_plugin

from ..common.quantities import ASSETS
from ..common.ui import JS

#: Folders of Panel's files, and of KaTeX in them, whose name contains its version.
DIST = Path(panel.__file__).parent / "dist"
KATEX = next(DIST.glob("bundled/katex/katex@*/dist"), DIST).relative_to(DIST).as_posix()
#: A link to a file next to the theory, which no server serves.
_FILE = re.compile(r"\[(.*?)\]\(\w+\.md\)")
#: A picture next to the theory, which becomes part of the page.
_PICTURE = re.compile(r"!\[(.*?)\]\((\w+\.svg)\)")
#: References to equations, (4) or (4)–(8).
_NAMED = re.compile(r"\(([1-9]\d?)\)(?:–\((\d{1,2})\))?")


def html():
    """Return the theory as HTML with KaTeX formulas and ids of sections and equations."""
    parser, numbered = MarkdownIt().enable("table"), set()
    # Pictures are data links, which the parser rejects by default.
    parser.validateLink = lambda _: True
    parser.use(dollarmath_plugin, renderer=lambda text, _: f"\\({escape(text)}\\)")
    text = (ASSETS / "theory.md").read_text(encoding="utf-8")
    tokens = parser.parse(_PICTURE.sub(_with_picture, _FILE.sub(r"\1", text)))
    parts, in_body = [], False
    for k, token in enumerate(tokens):
        if token.type == "heading_open" and (number := re.match(r"\d+", tokens[k + 1].content)):
            token.attrSet("id", f"section-{number[0]}")
            in_body = True
        for first, last in _NAMED.findall(token.content) if in_body and not token.nesting else ():
            new = set(range(int(first), int(last or first) + 1)) - numbered
            parts += [f'<a id="eq-{n}"></a>' for n in sorted(new)]
            numbered |= new
        if token.type == "fence" and token.info == "math":
            parts.append(f"<p>$${escape(token.content)}$$</p>")
        else:
            parts.append(parser.renderer.render([token], parser.options, {}))
    return "".join(parts)


def _with_picture(found):
    data = b64encode((ASSETS / found[2]).read_bytes()).decode()
    return f"![{found[1]}](data:image/svg+xml;base64,{data})"


def page(katex: str) -> str:
    """Return the page as HTML for the folder of the style sheets; `katex` is the address of KaTeX."""
    template = Template(Path(__file__).with_suffix(".html").read_text(encoding="utf-8"))
    return template.substitute(theme=JS["head"], katex=katex, body=html())
