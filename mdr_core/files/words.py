"""Words in the names of columns: quantities in several languages, and what is none of the curve."""

import re
from functools import lru_cache

from .units import cleaned

#: Words of each quantity, in small letters; single letters are its symbols.
_QUANTITIES = {
    "time": r"time|zeit|\w*zeit|temps|tiempo|tempo|t|时间|時間",
    "force": r"force|forces|load|\w*kraft|last|\w*last|charge|effort|fuerza|carga|forza|carico|kracht|сила|нагрузка"
    r"|f|p|fn|fz|ph|\w*载荷|\w*荷载|\w*负荷|\w*力|荷重",
    "deflection": r"v?defl\w*|dfl|t b|auslenkung|durchbiegung|verbiegung|d[eé]flexion|deflexi[oó]n|deflessione|偏转"
    r"|挠度",
    "depth": r"depth|displ\w*|disp|indent\w*|penetr\w*|\w*tiefe|\w*weg|eindring\w*|profond\w*|enfonce\w*"
    r"|d[eé]placement|p[eé]n[eé]tration|profundidad|desplazamiento|penetraci[oó]n|profondit[aà]|spostamento"
    r"|penetrazione|diepte|глубина|\w*verschiebung|hub|\w*位移|\w*深度|压入\w*|压痕\w*|h|d|z|tip|separation|sep|tss"
    r"|\w*height|höhe|hauteur|altura|altezza|piezo|ramp|extension|stage|z ?pos\w*|z ?sens\w*|scanner|travel|stroke"
    r"|traverse\w*|distance|abstand",
}
#: A word begins and ends where no letter of an alphabet stands beside it.
_WORD = r"(?<![^\W\d_])(?:%s)(?![^\W\d_])"
_PATTERNS = {each: re.compile(_WORD % words) for each, words in _QUANTITIES.items()}
#: Names of columns of values that belong to a whole test or to the instrument, or are no part of the curve.
_STATISTICS = (
    r"std\w*|sd|stdev|s d|standard\w*|deviation|sigma|error\w*|uncertainty|rms|noise|max\w*|peak|min|minimum|mean"
    r"|average\w*|avg|median|target|set ?point\w*|demand\w*|command\w*|limit|threshold|trigger\w*|rate|velocity|speed"
    r"|amplitude|harmonic|dynamic|variance|abweichung|stabw|mittel\w*|fehler|soll\w*|rausch\w*|moyen\w*|écart|consigne"
    r"|promedio|desviación|media|scarto|deriva|标准差|平均\w*|最大\w*"
)
_NONE = {
    "force": re.compile(_WORD % (
        rf"{_STATISTICS}|lat\w*|friction\w*|tangential\w*|horizontal\w*|h ?defl\w*|hdefl\w*|quer\w*|seiten\w*|reib\w*"
        r"|frottement|roz\w*|attrito|fricci[oó]n|fx|fy|[fpl] ?max|摩擦\w*|preload|adhesion|pull ?off"
    )),
    "depth": re.compile(_WORD % (
        rf"{_STATISTICS}|contact(?! point)|residual|plastic|final|permanent|area|radius|diameter|wavelength|roughness"
        r"|lateral|drift(?! ?corr)|frame(?! ?corr)|offset|h ?(?:c|f|r|max|p|i)|width|[xy](?!\w)|x ?pos\w*|y ?pos\w*|restl\w*|"
        r"kontakt\w*|接触\w*|残余\w*"
    )),
    "time": re.compile(_WORD % "std|sd|deviation|error|constant|period|dwell|hold|interval|step|rate"),
}  # fmt: skip
#: Names that say the depth of the tip, and others of the position of a piezo, with its deflection.
_DEPTH = re.compile(
    _WORD % (
        r"depth|indent\w*|penetr\w*|\w*tiefe|eindring\w*|profond\w*|enfonce\w*|p[eé]n[eé]tration|profundidad"
        r"|penetraci[oó]n|profondit[aà]|penetrazione|diepte|глубина|\w*深度|压入\w*|压痕\w*|into surface"
    )
)  # fmt: skip
_TIP = re.compile(_WORD % r"tip|separation|sep|tss|h|distance tip|abstand")
_PIEZO = re.compile(r"piezo|\w*height|sens|scanner|höhe|hauteur|altura|altezza")
#: Nouns that number samples, each a curve of its own; a cycle or a segment is a part of one.
SAMPLES = (
    r"tests?|curves?|indents?|indentations?|imprints?|samples?|specimens?|runs?|points?|spots?|measurements?|positions?|"
    r"experiments?|kurven?|messung(?:en)?|versuche?|proben?|eindr[uü]ck|punkt|essais?|courbes?|mesures?|pruebas?|ensayos?|"
    r"curvas?|prov[ae]|curv[ae]|misur[ae]|试验|测试|曲线|试样|样品|压痕|测点"
)
_SAMPLES = re.compile(_WORD % rf"{SAMPLES}|id|nr|no|number|file|label|name|group|probe|#")
_PARTS = re.compile(
    _WORD % r"segments?|steps?|phases?|cycles?|retract|zyklus|zyklen|schritt|segmente?|direction|stage"
)
#: Modulus and hardness, of which a test has one.
_MECHANICAL = re.compile(
    _WORD % (
        r"modulus|moduli|hardness|young\w*|e ?modul\w*|h[äa]rte|martens\w*|vickers|e ?it|h ?it|e ?r|er|hv|hm|hmv"
        r"|module|duret[eé]|m[oó]dulo|dureza|durezza|modulo|模量|\w*模量|硬度|eindringhärte|elastizitäts\w*"
    )
)  # fmt: skip
_MEANS = re.compile(
    _WORD
    % r"std\w*|stdev|stddev|s d|deviation|standard\w*|mean|average\w*|avg|cov|mittel\w*|abweichung|stabw|moyen\w*|"
    r"écart|promedio|desviación|media|scarto|标准差|平均\w*"
)


@lru_cache(maxsize=4096)
def normal(head):
    """Name in small letters, its parts separated by blanks: "tipSampleSeparation" has three."""
    head = re.sub(r"(?<=[a-z]{2})(?=[A-Z])", " ", cleaned(str(head)))
    return re.sub(r"[\s_\-./:,;()\[\]{}]+", " ", head).strip().lower()


def quantity_of(head):
    """Quantity that a name has a word of: "time", "force", "deflection" or "depth"; else None."""
    return next((each for each, pattern in _PATTERNS.items() if pattern.search(normal(head))), None)


def named(each, head):
    """Whether a name has a word of a quantity."""
    return bool(_PATTERNS[each].search(normal(head)))


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
