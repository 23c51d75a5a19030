from ..measurements.files import tips as tips
from ..show import hints as hints
from ..show import limits as limits
from ..show import plots as plots
from ..show import progress as progress
from ..show import report as report
from ..solver.own import cap as cap
from ..solver.own import law as law
from ..solver.own import shape as shape

MODULES: dict[str, str]
