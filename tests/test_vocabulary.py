"""One word for each thing: words that were replaced do not come back (the table is in CONTRIBUTING.md)."""

import io
import re
import tokenize
from pathlib import Path

import pytest

import mdr_core as mdr

PACKAGE = Path(mdr.__file__).parent
FILES = sorted(PACKAGE.rglob("*.py"))
#: Names in code that have another one now, or that name nothing a reader knows.
NAMES = {
    "deepest": "known_depth, turning_point or largest_depth",
    "growth": "increase (of the plastic depth)",
    "live": "interval, live_interval or live_depth",
    "tip": "profile",
    "indenter": "profile",
    "foot": "the kink below",
    "feet": "the kinks",
    "way": "a distance, a path or a spacing",
    "found": "a noun of the result",
    "said": "a remark",
    "told": "a noun of the result",
    "beyond": "a depth above d_p, or a mask",
    "rest": "remainder",
    "wet": "viscous",
    "swift": "a speed",
    "spent": "work",
    "grown": "a ratio",
    "met": "penetration or contact",
    "gone": "released",
    "course": "motion, or path",
    "superposition": "integrals",
    "class_": "hardness_class",
}
#: Phrases in docstrings, comments and messages that a reader has to guess.
PHRASES = (
    r"\bthe way (of|to|into|there|from|back|out|it|in|is)\b", r"\bby the way\b", r"\bcomes? to an end\b",
    r"\bfalls? short\b", r"\bas deep as\b", r"\bhanded in\b", r"\bBack comes?\b", r"\blets? go\b",
    r"\bWhat (is|a|the|of|each|one|it|was|has|drives|results|comes|follows|fits|measured)\b",
    r"\bgives? back\b", r"\bas it takes\b", r"\bdeepest\b", r"\bin circles\b", r"\bis told\b",
)  # fmt: skip


def tokens(path):
    return tokenize.generate_tokens(io.StringIO(path.read_text(encoding="utf-8")).readline)


@pytest.mark.parametrize("path", FILES, ids=lambda path: str(path.relative_to(PACKAGE)))
def test_names_are_those_of_the_table(path):
    used = [(t.start[0], t.string) for t in tokens(path) if t.type == tokenize.NAME]
    wrong = [f"line {line}: {name} → {NAMES[name]}" for line, name in used if name in NAMES]
    assert not wrong, "\n".join(wrong)


@pytest.mark.parametrize("path", FILES, ids=lambda path: str(path.relative_to(PACKAGE)))
def test_prose_is_plain(path):
    prose = [(t.start[0], t.string) for t in tokens(path) if t.type in (tokenize.STRING, tokenize.COMMENT)]
    wrong = [
        f"line {line}: {match.group()}"
        for line, text in prose
        for phrase in PHRASES
        if (match := re.search(phrase, " ".join(text.split())))
    ]
    assert not wrong, "\n".join(wrong)
