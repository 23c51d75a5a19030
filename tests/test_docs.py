"""Examples in docstrings, in the README and on the site run, and the site is complete."""

import ast
import doctest
import importlib
import inspect
import io
import os
import pkgutil
import re
import subprocess
import sys
import tokenize
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote

import pytest

import mdr_core as mdr
from mdr_core.show.synonyms import SYNONYMS

ROOT = Path(__file__).parents[1]
DOCS = ROOT / "assets" / "docs"
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted(DOCS.rglob("*.md"))]
EXAMPLES = sorted((DOCS / "examples").rglob("[0-9]*.py"))
#: Blocks of code, each with what the block of text below it says that it prints.
CODE = re.compile(r"```python\n(.*?)```(?:\n\n```text\n(.*?)```)?", re.DOTALL)
BLOCKS = [
    pytest.param(block, printed, id=f"{page.stem}-{number}")
    for page in PAGES[1:]
    for number, (block, printed) in enumerate(CODE.findall(page.read_text("utf-8")))
    if ">>>" not in block
]
ROWS = [row for row in (DOCS / "equations.md").read_text("utf-8").splitlines() if re.match(r"\| \(\d", row)]
#: Optional packages that a block needs besides those that it imports.
NEEDED = {
    "to_excel": "openpyxl",
    ".plot()": "holoviews",
    "to_pandas": "pandas",
    "to_xarray": "xarray",
    "import app": "panel",
    "from app": "panel",
    "from ..": "panel",
}


def run(code, name="example", **names):
    """Run the text of a script, or skip it where an optional package is missing; returns its names."""
    packages = re.findall(r"^(?:import|from) (\w+)", code, re.MULTILINE)
    for package in [*packages, *(package for text, package in NEEDED.items() if text in code)]:
        pytest.importorskip(package)
    # An extra of the page imports what is beside it.
    folder = "app.explorer.extras"
    place = {"__name__": f"{folder}.example", "__package__": folder} if "from .." in code else {}
    names |= {"__name__": "__main__"} | place
    exec(compile(code, name, "exec"), names)
    return names


@pytest.mark.parametrize("module", [m.name for m in pkgutil.walk_packages(mdr.__path__, "mdr_core.")])
def test_examples_in_docstrings(module):
    if module == "mdr_core.sweep":
        pytest.importorskip("xarray")
    assert doctest.testmod(importlib.import_module(module)).failed == 0


def documented(name):
    """A public name with its public methods or functions, those that have a docstring."""
    thing = getattr(mdr, name)
    yield name, thing
    if inspect.isclass(thing) or inspect.ismodule(thing):
        for part, value in vars(thing).items():
            value = getattr(value, "__func__", getattr(value, "fget", value))
            own = inspect.isclass(thing) or part in thing.__all__
            if own and not part.startswith("_") and inspect.isfunction(value):
                yield f"{name}.{part}", value


@pytest.mark.parametrize("name", mdr.__all__)
def test_an_example_runs_alone_as_it_is_pasted(name):
    """In an empty namespace; every public name has one."""
    if name == "sweep":
        pytest.importorskip("xarray")
    for title, thing in documented(name):
        text = inspect.getdoc(thing) or ""
        test = doctest.DocTestParser().get_doctest(text, {}, title, None, 0)
        assert test.examples or title != name, f"{name} has no example"
        said = []
        failures, _ = doctest.DocTestRunner().run(test, out=said.append)
        assert not failures, "".join(said)


def test_the_example_of_a_shape_of_ones_own_is_run():
    """Examples of classes count only where their module says that they are its own."""
    profile = importlib.import_module("mdr_core.solver.profiles.profile")
    examples = [test.name for test in doctest.DocTestFinder().find(profile) if test.examples]
    assert "mdr_core.solver.profiles.profile.Profile" in examples


def test_examples_in_the_readme():
    result = doctest.testfile(str(ROOT / "README.md"), module_relative=False)
    assert result.attempted > 0
    assert result.failed == 0


class Comments:
    """Numbers in comments behind statements of a block, and what these statements print or assign.

    A comment may have words. The numbers behind its last "=" count, if it has one, and "within 3 %" is the
    tolerance of all; else a number of the comment is one of the result, rounded to as many places.
    """

    def __init__(self, block):
        tokens = tokenize.generate_tokens(io.StringIO(block).readline)
        comments = {token.start[0]: token.string for token in tokens if token.type == tokenize.COMMENT}
        self.calls, self.assigned, self.printed = {}, {}, {}
        for node in ast.walk(ast.parse(block)):
            text = comments.get(getattr(node, "end_lineno", None), "")
            if not re.search(r"\d", text):
                continue
            if isinstance(node, ast.Call) and getattr(node.func, "id", "") == "print":
                self.calls |= dict.fromkeys(range(node.lineno, node.end_lineno + 1), text)
            elif isinstance(node, ast.Assign) and "=" in text:
                self.assigned[node.targets[0].id] = text

    def print(self, *values, **options):
        print(*values, **options)
        text = self.calls.get(sys._getframe(1).f_lineno)
        if text:
            self.printed[text] = self.printed.get(text, "") + " ".join(map(str, values)) + "\n"

    def check(self, names):
        """Check all comments with the names that the block has left."""
        for text, result in [
            *self.printed.items(),
            *((t, str(names[n])) for n, t in self.assigned.items()),
        ]:
            within = re.search(r"within (\d+) %", text)
            said = numbers(text.replace(within[0], "") if within else text.rpartition("=")[2])
            found = [float(each) for each in numbers(result)]
            for each in said:
                margin = 0.01 * float(within[1]) * float(each) if within else 0.5 * 10.0 ** -places(each)
                assert any(abs(value - float(each)) <= margin * 1.000001 for value in found), (text, result)
        return len(self.printed) + len(self.assigned)


def numbers(text):
    return re.findall(r"(?<![\w.])-?\d+(?:\.\d+)?(?:e[+-]?\d+)?", text)


def places(number):
    """Decimal places of a number in a text; many of one that has a power of ten."""
    return 15 if "e" in number else len(number.partition(".")[2])


@pytest.mark.parametrize(("block", "printed"), BLOCKS)
def test_blocks_of_code(block, printed, tmp_path, monkeypatch, capsys):
    """In an empty folder, as a reader pastes them; numbers in comments count, too."""
    monkeypatch.chdir(tmp_path)
    comments = Comments(block)
    comments.check(run(block, print=comments.print))
    assert not printed or capsys.readouterr().out == printed


def test_a_wrong_number_in_a_comment_is_seen():
    for line, right in (
        ("print(0.3804)  # 0.38", True), ("print(0.3804)  # 0.39 in all", False),
        ("x = 2.0  # k/m = 2 s", True), ("x = 2.0  # k/m = 3 s", False),
        ("print(\n    196\n)  # 195: within 1 %", True), ("print(196)  # 190: within 1 %", False),
    ):  # fmt: skip
        comments = Comments(line)
        names = run(line, print=comments.print)
        if right:
            assert comments.check(names) == 1
        else:
            with pytest.raises(AssertionError):
                comments.check(names)
    assert sum(bool(Comments(block.values[0]).calls) for block in BLOCKS) >= 6


def test_blocks_that_need_a_file_of_a_reader_import_what_they_use():
    """Blocks of the page on AFM cannot be run here: their files are the reader's."""
    blocks = re.findall(r"```py\n(.*?)```", (DOCS / "afm.md").read_text("utf-8"), re.DOTALL)
    assert len(blocks) >= 3
    for block in blocks:
        tree = ast.parse(block)
        imported = {
            part.asname or part.name
            for node in tree.body
            if isinstance(node, ast.Import)
            for part in node.names
        }
        used = {
            node.id for node in ast.walk(tree) if isinstance(node, ast.Name) and node.id in ("mdr", "np")
        }
        assert used <= imported, block


def test_the_curve_of_the_readme_is_plotted_and_saved(tmp_path, monkeypatch):
    blocks = re.findall(r"```python\n(.*?)```", PAGES[0].read_text("utf-8"), re.DOTALL)
    (block,) = (block for block in blocks if ">>>" not in block)
    assert len([line for line in block.splitlines() if line]) <= 10
    monkeypatch.chdir(tmp_path)
    run(block)
    assert "d, indentation depth (nm)" in (tmp_path / "curve.html").read_text(encoding="utf-8")
    assert (tmp_path / "curve.csv").read_text(encoding="utf-8").count("\n") == 202


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_example_of_the_gallery(path, tmp_path, monkeypatch):
    """It is short, it runs in an empty folder without a warning, and it draws one figure or more."""
    plt = pytest.importorskip("matplotlib.pyplot")
    plt.switch_backend("Agg")
    code = path.read_text(encoding="utf-8")
    assert len(code.splitlines()) <= 60
    # A window would wait, and Agg would warn that it has none.
    monkeypatch.setattr(plt, "show", lambda: None)
    monkeypatch.chdir(tmp_path)
    run(code, path.name)
    assert plt.get_fignums()
    plt.close("all")


def test_the_gallery_is_large_and_the_readme_short():
    assert len(EXAMPLES) >= 14
    assert len(PAGES[0].read_text(encoding="utf-8").splitlines()) <= 120


def test_contributing_begins_with_the_environment_of_the_readme():
    """Its first command is the README's, which `.ci/run` runs, with ruff besides."""
    readme, contributing = (page.read_text(encoding="utf-8") for page in PAGES[:2])
    command = re.search(r"python3 -m venv \.venv-test .*?--group test", readme, re.DOTALL)[0]
    block = re.search(r"```sh\n(.*?)```", contributing, re.DOTALL)[1]
    assert block.startswith(f"{command} --group dev\n")


@pytest.mark.parametrize("page", [PAGES[0], *sorted(DOCS.glob("*.md"))], ids=lambda page: page.stem)
def test_a_block_of_code_fits_a_page(page):
    """A page of 1280 pixels shows 88 columns."""
    blocks = re.findall(r"^```\w+\n(.*?)^```", page.read_text("utf-8"), re.DOTALL | re.MULTILINE)
    assert [line for block in blocks for line in block.splitlines() if len(line) > 88] == []


@pytest.mark.parametrize("path", sorted((DOCS / "examples").rglob("*.py")), ids=lambda path: path.stem)
def test_an_example_fits_a_page(path):
    assert [line for line in path.read_text("utf-8").splitlines() if len(line) > 88] == []


def test_the_reference_has_all_public_names():
    text = "".join(page.read_text(encoding="utf-8") for page in (DOCS / "reference").glob("*.md"))
    documented = set(re.findall(r"^\.\. auto\w+:: (?:mdr_core\.)?(\w+)$", text, re.MULTILINE))
    assert set(mdr.__all__) <= documented


#: What people search for first; a term of the glossary is the first answer of the site's search.
SEARCHED = [
    "spherical indenter",
    "viscoelastic",
    "DEM",
    "Mindlin",
    "friction",
    "area function",
    "restitution",
    "hardness",
    "JKR",
    "Hertz",
    "Sneddon",
    "Berkovich",
    "Oliver-Pharr",
    "Oliver Pharr",
    "creep",
    "pile-up",
    "PDMS",
    "gold",
    "AFM",
    "Kelvin-Voigt",
    "Kelvin Voigt",
    "plastic zone",
    "Leeb",
    "Meyer's index",
    "notebook",
    "export",
    "torsion",
    *("drop tower", "drop weight", "impactor", "striker", "CFRP", "GFRP", "laminate", "dent"),
    *("absorbed energy", "BVID", "peak force"),
    *("batch", "folder", "decimal comma", "Windows", "FAQ", "BibTeX", "cohesion", "sigma_zz"),
    *("reproduce Popov 2015", "Hopkinson", "velocity", "line load", "e(v)"),
]


@pytest.mark.parametrize("word", SEARCHED)
def test_a_word_that_is_searched_for_is_a_term_with_an_answer(word):
    if any(word in row.words for row in SYNONYMS):
        return
    entries = re.findall(
        r"((?:^   \S.*\n)+)((?:^      \S.*\n)+)", (DOCS / "words.md").read_text("utf-8"), re.M
    )
    (answer,) = (answer for terms, answer in entries if f"   {word}\n" in terms)
    # A name of the package, a page, or "No".
    assert re.search(r"`|\*\*No\*\*", answer)


class Links(HTMLParser):
    """Links, anchors, and addresses of what a page loads."""

    def __init__(self, page):
        super().__init__()
        self.links, self.anchors, self.loaded = [], set(), []
        self.feed(page.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attrs):
        attrs = dict(attrs)
        self.anchors |= {attrs.get("id"), attrs.get("name")}
        if tag == "a" and attrs.get("href"):
            self.links.append(attrs["href"])
        address = attrs.get("src") or (attrs.get("href") if tag == "link" else None)
        if address and not address.startswith("data:"):
            self.loaded.append(address)


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    """The folder of the site: of `MDR_SITE`, which the README's command has built, or without pictures."""
    if built := os.environ.get("MDR_SITE"):
        return Path(built)
    for package in ("sphinx", "numpydoc", "myst_parser", "pydata_sphinx_theme", "sphinx_gallery", "panel"):
        pytest.importorskip(package)
    folder, tree = (tmp_path_factory.mktemp(name) for name in ("site", "tree"))
    build = ("-m", "sphinx", "-W", "-q", "-D", "plot_gallery=0", "-d", tree, DOCS, folder)
    done = subprocess.run([sys.executable, *map(str, build)], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return folder


@pytest.mark.slow
def test_the_site_is_built_without_warnings_and_its_links_lead_somewhere(site):
    """Nothing is loaded from other servers."""
    # A template of the theme is in _static.
    files = [page for page in site.rglob("*.html") if "_static" not in page.parts]
    pages = {page.resolve(): Links(page) for page in files}
    assert len(pages) > len(EXAMPLES)
    # A scene to play stands on the first page, with its plots and the frames of its slider.
    assert "scene.html" in pages[(site / "index.html").resolve()].loaded
    assert {"player", "readout"} <= pages[(site / "scene.html").resolve()].anchors
    # What the README links has a page there, and is no file to download.
    first = pages[(site / "index.html").resolve()].links
    assert "gallery/first_hour.html" in first
    assert not any("_downloads" in link for link in first)
    for page, found in pages.items():
        for link in found.links + found.loaded:
            target, _, anchor = unquote(link).partition("#")
            if re.match(r"https?:|mailto:", target):
                assert link not in found.loaded, f"{page.name} loads {link}"
                continue
            path = (page.parent / target.partition("?")[0]).resolve() if target else page
            assert path.exists(), f"{page.name}: {link}"
            assert not anchor or path not in pages or anchor in pages[path].anchors, f"{page.name}: {link}"


@pytest.mark.slow
def test_the_reference_of_the_site_begins_with_an_index_of_all_public_names(site):
    """Each with a link to its own description and with what it does."""
    index = site / "reference" / "index.html"
    linked = {link.partition("#")[2].removeprefix("module-") for link in Links(index).links}
    names = {*mdr.__all__, *(f"sweep.{name}" for name in mdr.sweep.__all__)}
    assert {f"mdr_core.{name}" for name in names} <= linked
    rows = re.findall(r"<tr.*?</tr>", index.read_text(encoding="utf-8"), re.DOTALL)
    said = [re.sub(r"<[^>]+>", "", row.rpartition("<td>")[2]).strip() for row in rows]
    assert len(said) >= len(mdr.__all__)
    # A sentence, which an abbreviation such as "Eq." does not cut.
    assert all(len(text.split()) >= 3 and not re.search(r"\b(Eqs?|Fig)\.$", text) for text in said)


@pytest.mark.slow
def test_the_reference_of_the_site_has_no_machinery(site):
    """What only solvers ask for: of shapes and drives it is said once, in the base class or not at all."""
    described = set().union(*(Links(page).anchors for page in (site / "reference").glob("*.html"))) - {None}
    for shape in (mdr.Cone, mdr.Sphere, mdr.Sampled, mdr.Smooth):
        assert not {f"mdr_core.{shape.__name__}.{name}" for name in dir(mdr.Profile)} & described
    hidden = ("Profile.sound", "DepthPath.solve", "numerics.results.Record", "numerics.results.Model")
    assert not {f"mdr_core.{name}" for name in hidden} & described
    assert "mdr_core.Cone.from_half_angle" in described


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row.split("|")[1].strip())
def test_equation_has_a_function_and_a_test(row):
    _, _, _, functions, tests, _ = row.split("|")
    for function in re.findall(r"`([^`]+)`", functions):
        thing = mdr
        for part in function.split("."):
            # Fields of a dataclass are no attributes of its class, everything named here is.
            thing = getattr(thing, part)
    named = re.findall(r"`([\w/]+\.py)::(\w+)`", tests)
    assert named
    for file, test in named:
        assert f"def {test}(" in (ROOT / "tests" / file).read_text(encoding="utf-8")


def test_the_citation_is_that_of_the_file():
    """BibTeX of the questions beside CITATION.cff."""
    bibtex = (DOCS / "faq.md").read_text("utf-8").partition("```bibtex")[2]
    cff = (ROOT / "CITATION.cff").read_text("utf-8").partition("preferred-citation:")[2]
    parts = dict(re.findall(r"^ +(?:- )?([\w-]+): \"?([^\"\n]+)", cff, re.MULTILINE))
    assert f"{parts['family-names']}, {parts['given-names']}" in bibtex
    for name, value in (("title", "title"), ("volume", "volume"), ("number", "issue"), ("year", "year")):
        assert f"{name} = {{{parts[value]}}}" in " ".join(re.sub(r" +=", " =", bibtex).split())
    assert parts["journal"] in bibtex
    assert f"{parts['start']}--{parts['end']}" in bibtex


def test_the_code_in_an_hour_names_what_there_is():
    """Files from the package on, with functions and classes after two colons."""
    named = re.findall(r"`([\w/]+\.py)(?:::([\w.]+))?`", (DOCS / "code.md").read_text("utf-8"))
    assert len(named) > 40
    for file, names in named:
        if file.startswith("tests/"):
            assert (ROOT / file).is_file(), file
            continue
        thing = importlib.import_module("mdr_core." + file.removesuffix(".py").replace("/", "."))
        for part in filter(None, names.split(".")):
            thing = getattr(thing, part)


def test_the_code_in_an_hour_follows_every_folder():
    text = (DOCS / "code.md").read_text("utf-8")
    top = Path(mdr.__file__).parent
    folders = {path.parent.name for path in (*top.glob("*/__init__.py"), *top.glob("solver/*/__init__.py"))}
    assert len(folders) >= 13
    assert all(f"{folder}/" in text for folder in folders)


def test_every_equation_of_the_paper_is_in_the_table():
    numbers = set()
    for row in ROWS:
        for first, last in re.findall(r"\((\d+)\)(?:–\((\d+)\))?", row.split("|")[1]):
            numbers.update(range(int(first), int(last or first) + 1))
    assert numbers == set(range(1, 25))
