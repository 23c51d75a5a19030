"""Words in the names of columns: quantities in several languages, and columns that are not of the curve."""

import re
from functools import lru_cache

from .units import cleaned

#: A word begins and ends where no letter of an alphabet stands beside it.
_BOUNDED = r"(?<![^\W\d_])(?:%s)(?![^\W\d_])"


def _any_of(*words):
    return re.compile(_BOUNDED % "|".join(words))


#: Words of each quantity, in small letters; single letters are its symbols.
_QUANTITIES = {
    "time": _any_of(r"\w*zeit", "time", "temps", "tiempo", "tempo", "t", "时间", "時間"),
    "force": _any_of(
        r"forces?|load|charge|effort|fuerza|carga|forza|carico|kracht|сила|нагрузка|f|p|fn|fz|ph",
        r"\w*kraft|\w*last|\w*载荷|\w*荷载|\w*负荷|\w*力|荷重",
    ),
    "deflection": _any_of(
        r"v?defl\w*|dfl|t b|auslenkung|durchbiegung|verbiegung|d[eé]flexion|deflexi[oó]n",
        r"deflessione|偏转|挠度",
    ),
    "depth": _any_of(
        r"depth|displ\w*|disp|indent\w*|penetr\w*|\w*tiefe|\w*weg|eindring\w*|profond\w*|enfonce\w*",
        r"d[eé]placement|p[eé]n[eé]tration|profundidad|desplazamiento|penetraci[oó]n|profondit[aà]",
        r"spostamento",
        r"penetrazione|diepte|глубина|\w*verschiebung|hub|\w*位移|\w*深度|压入\w*|压痕\w*|h|d|z|tip",
        r"separation|sep",
        r"tss|\w*height|höhe|hauteur|altura|altezza|piezo|ramp|extension|stage|z ?pos\w*|z ?sens\w*",
        r"scanner|travel",
        r"stroke|traverse\w*|distance|abstand",
    ),
}
#: Words of values that belong to a whole test, or are no part of the curve.
_STATISTICS = (
    r"std\w*|sd|s d|standard ?(?:deviation|dev|error)|standardabweichung|standardfehler|deviation",
    r"sigma|error\w*",
    r"uncertainty|rms|noise|max\w*|peak|min|minimum|mean|average\w*|avg|median|target|set ?point\w*",
    r"demand\w*",
    r"command\w*|limit|threshold|trigger\w*|rate|velocity|speed|amplitude|harmonic|dynamic|variance",
    r"abweichung",
    r"stabw|mittel\w*|fehler|soll\w*|rausch\w*|moyen\w*|écart|consigne|promedio|desviación|media",
    r"scarto|deriva",
    r"标准差|平均\w*|最大\w*",
)
_NONE = {
    "force": _any_of(
        *_STATISTICS,
        r"lat\w*|friction\w*|tangential\w*|horizontal\w*|h ?defl\w*|quer\w*|seiten\w*|reib\w*",
        r"frottement|roz\w*",
        r"attrito|fricci[oó]n|fx|fy|[fpl] ?max|摩擦\w*|preload|adhesion|pull ?off",
    ),
    "depth": _any_of(
        *_STATISTICS,
        r"contact(?! point)|residual|plastic|final|permanent|area|radius|diameter|wavelength",
        r"roughness|lateral",
        r"drift(?! ?corr)|frame(?! ?corr)|offset|h ?(?:c|f|r|max|p|i)|width",
        r"(?:^|pos |position )[xy](?!\w)|[xy] ?pos\w*|restl\w*",
        r"kontakt\w*|接触\w*|残余\w*",
    ),
    "time": _any_of("std|sd|deviation|error|constant|period|dwell|hold|interval|step|rate"),
}
#: Names that say the depth of the tip, and others of the position of a piezo, with its deflection.
_DEPTH = _any_of(
    r"depth|indent\w*|penetr\w*|\w*tiefe|eindring\w*|profond\w*|enfonce\w*|p[eé]n[eé]tration|profundidad",
    r"penetraci[oó]n|profondit[aà]|penetrazione|diepte|глубина|\w*深度|压入\w*|压痕\w*|into surface",
)
_TIP = _any_of("tip|separation|sep|tss|h|abstand")
_PIEZO = re.compile(r"piezo|\w*height|sens|scanner|höhe|hauteur|altura|altezza")
#: Nouns that number samples, each a curve of its own; a cycle or a segment is a part of one.
SAMPLES = (
    r"tests?|curves?|indents?|indentations?|imprints?|samples?|specimens?|runs?|points?|spots?"
    r"|measurements?"
    r"|positions?|experiments?|kurven?|messung(?:en)?|versuche?|proben?|eindr[uü]ck|punkt|essais?"
    r"|courbes?|mesures?"
    r"|pruebas?|ensayos?|curvas?|prov[ae]|curv[ae]|misur[ae]|试验|测试|曲线|试样|样品|压痕|测点"
)
_SAMPLES = _any_of(SAMPLES, "id|nr|no|number|file|label|name|group|probe|#")
_PARTS = _any_of("segments?|steps?|phases?|cycles?|retract|zyklus|zyklen|schritt|segmente?|direction|stage")
#: Modulus and hardness, of which a test has one.
_MECHANICAL = _any_of(
    r"modulus|moduli|hardness|young\w*|e ?modul\w*|\w*h[äa]rte|martens\w*|vickers|e ?it|h ?it|e ?r",
    r"er|hv|hm|hmv",
    r"module|duret[eé]|m[oó]dulo|dureza|durezza|modulo|\w*模量|硬度|elastizitäts\w*",
)
_MEANS = _any_of(
    r"std\w*|s d|deviation|standard ?(?:deviation|dev|error)|standardabweichung|mean|average\w*|avg",
    r"cov|mittel\w*",
    r"abweichung|stabw|moyen\w*|écart|promedio|desviación|media|scarto|标准差|平均\w*",
)


@lru_cache(maxsize=4096)
def normal(head):
    """Name in small letters, its parts separated by blanks: "tipSampleSeparation" has three."""
    head = re.sub(r"(?<=[a-z]{2})(?=[A-Z])", " ", cleaned(str(head)))
    return re.sub(r"[\s_\-./:,;()\[\]{}]+", " ", head).strip().lower()


def quantity_of(head):
    """Quantity that a name has a word of: "time", "force", "deflection" or "depth"; else None."""
    return next((each for each, pattern in _QUANTITIES.items() if pattern.search(normal(head))), None)


def named(each, head):
    """Whether a name has a word of a quantity."""
    return bool(_QUANTITIES[each].search(normal(head)))


def is_none(each, head):
    """Whether a name says that a column is another one than that of the curve, as "Max Load"."""
    return each in _NONE and bool(_NONE[each].search(normal(head)))


def says_depth(head):
    """2 for a name that says the depth, 1 for the tip, a separation or h, 0 for others, as of a piezo."""
    name = normal(head)
    if _PIEZO.search(name) and not re.search(r"\btip\b|separation", name):
        return 0
    return 2 if _DEPTH.search(name) else int(bool(_TIP.search(name)))


def says_piezo(head):
    """Whether a name says the position of a piezo."""
    return bool(_PIEZO.search(normal(head))) and not says_depth(head)


def numbers_samples(head):
    """Whether a name is that of labels or numbers of samples."""
    return bool(_SAMPLES.search(normal(head))) or not normal(head)


def numbers_parts(head):
    """Whether a name is that of parts of one curve, as segments and cycles."""
    return bool(_PARTS.search(normal(head)))


def mechanical(head):
    """Whether a name is that of a modulus or a hardness."""
    return bool(_MECHANICAL.search(normal(head)) or re.search(r"(?<![^\W_])[kMG]Pa(?![^\W_])", head))


def of_means(text):
    """Whether a name or a cell is that of a mean or a deviation."""
    return bool(_MEANS.search(normal(text)))
