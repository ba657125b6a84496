"""comparisons.csv, row by row."""

import dataclasses

from .csv_rows import number, rows, whole

HEADER = "metric,family,same,a,b,n,undefined,failed,unpaired,mean_difference,low,high,p,p_holm,block_length"
SIGNIFICANT = 0.05


@dataclasses.dataclass
class Comparison:
    """a less b at the same poses; NaN where it cannot be told."""

    metric: str
    family: str  # "methods" or "hours"
    same: str  # the hours, or the method, that both have
    a: str
    b: str
    n: int
    undefined: int
    failed: int
    unpaired: int
    mean_difference: float
    low: float
    high: float
    p: float
    p_holm: float
    block_length: int

    @property
    def is_significant(self):
        return self.p_holm < SIGNIFICANT


def read(path):
    """Empty where there is no file. Raises ReportError naming file and line."""
    counts = ("n", "undefined", "failed", "unpaired", "block_length")
    numbers = ("mean_difference", "low", "high", "p", "p_holm")
    kinds = {**{name: whole for name in counts}, **{name: number for name in numbers}}
    return [Comparison(**row) for row in rows(path, HEADER, kinds)]
