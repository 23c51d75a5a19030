"""What results say of themselves: kinds of remarks, the remark of a kind, the limit of a name."""


def kinds(result):
    """Kinds of the remarks on a result."""
    return {remark.kind for remark in result.remarks}


def remark_of(result, kind):
    """The one remark of a kind."""
    (found,) = (remark for remark in result.remarks if remark.kind == kind)
    return found


def limit_of(result, what):
    """The one limit of a name."""
    (found,) = (limit for limit in result.limits if limit.what == what)
    return found
