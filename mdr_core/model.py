"""How a result was found: the model that was solved, and why that one."""


class Model(str):
    """Name of a model, and in `reason` what makes it the one for a result.

    Examples
    --------
    >>> CLOSED_FORM == "closed form"
    True
    """

    __slots__ = ("reason",)

    def __new__(cls, name, reason):
        model = super().__new__(cls, name)
        model.reason = reason
        return model

    def __getnewargs__(self):
        return str(self), self.reason


CLOSED_FORM = Model(
    "closed form",
    "without viscosity, or infinitely slowly, all that the past leaves behind is the plastic depth, and "
    "every result is an integral over the live interval",
)
SCALAR_ODE = Model(
    "scalar ODE",
    "a viscous body that comes in at one go obeys one equation of motion, because elements let go from "
    "outside inward and are not met again",
)
CHAIN = Model(
    "chain",
    "on a viscous path elements that have let go may be met again while they relax, so that every one "
    "has a memory of its own",
)
