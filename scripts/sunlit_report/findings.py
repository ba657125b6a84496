"""The paper's six findings, judged on a summary: each by a criterion that is spelt out."""

import dataclasses
import math

from . import circumstances, names, paper
from .files import is_self_test

REPRODUCED, NOT_REPRODUCED, NOT_JUDGED = "reproduced", "not reproduced", "cannot be judged"

BOOLEAN = ["boolean_rgb", "boolean_grey"]
EUCLIDEAN = ["euclidean_rgb", "euclidean_grey"]
BY_RISING_DIFFERENCE = ["sift", "surf", "brisk", "orb"]
HOUR_PAIRS = ["4–12", "4–20", "12–20"]
EQUAL_WITHIN = 0.01  # the paper's boolean differences of noon to morning and evening differ by 0.0006 and 0.0002
SLIGHTLY_ABOVE = 1.5  # the paper's ratio is 1.11
FEW = 0.5  # of the paper's poses
SMALL_RESIDUE = 0.02  # the paper's largest is 0.0127


@dataclasses.dataclass
class Finding:
    """What the paper found, and whether it holds.

    `rows` under `header` are what the verdict rests on; the last field of a row says whether it breaks the criterion.
    `reason` says why there is no verdict.
    """

    claim: str
    criterion: str
    verdict: str
    header: list = dataclasses.field(default_factory=list)
    rows: list = dataclasses.field(default_factory=list)
    reason: str = ""

    @property
    def extent(self):
        """How far a finding that is not reproduced holds all the same, in words; else empty."""
        if self.verdict != NOT_REPRODUCED:
            return ""
        broken = [row[0] for row in self.rows if row[-1]]
        return f"holds in {len(self.rows) - len(broken)} of {len(self.rows)}, not for {', '.join(broken)}"


class NotJudged(Exception):
    """Why a finding cannot be judged."""


def judge(output):
    """All six, in the paper's order."""
    return [_judged(output, *rule) for rule in RULES]


def count(findings, verdict=REPRODUCED):
    return sum(finding.verdict == verdict for finding in findings)


def verdict_of_all(findings, output):
    """How many hold, in words; those that this run cannot tell anything of are not held against it. A part of the way
    need not show what holds for the whole, so a run of few poses says that it is one."""
    not_judged = count(findings, NOT_JUDGED)
    if not_judged == len(findings):
        return f"none of the {len(findings)} can be judged from these conditions"
    text = f"{count(findings)} of {len(findings)} reproduced"
    if not_judged:
        text += f", {not_judged} cannot be judged"
    poses = len(output.poses)
    if poses < FEW * paper.POSES:
        text += f", by {poses} poses; the paper's findings are those of {paper.POSES}"
    return text + circumstances.reserve(output)


def _judged(output, claim, criterion, rule):
    try:
        header, rows = rule(output)
    except NotJudged as reason:
        return Finding(claim, criterion, NOT_JUDGED, reason=str(reason))
    breaks = any(row[-1] for row in rows)
    return Finding(claim, criterion, NOT_REPRODUCED if breaks else REPRODUCED, header, rows)


def _three(output, difference, field):
    """Values of 4-12, 4-20 and 12-20."""
    values = []
    for a, b in paper.PAIRS:
        row = output.summary.get((a, b, difference)) or output.summary.get((b, a, difference))
        if row is None:
            raise NotJudged(f"needs the pairs of 4, 12 and 20 h (conditions {', '.join(_hours())}); "
                            f"{names.pair(a, b)} of {names.difference(difference)} was not evaluated")
        value = getattr(row, field)
        if math.isnan(value):
            raise NotJudged(f"{names.pair(a, b)} of {names.difference(difference)} has no defined {field}")
        values.append(value)
    return values


def _hours():
    return [paper.MORNING, paper.NOON, paper.EVENING]


def _evaluated(output, wanted):
    found = [d for d in wanted if d in output.differences]
    if not found:
        raise NotJudged("none of " + ", ".join(names.difference(d) for d in wanted) + " was evaluated")
    return found


def _each(output, differences, field, rule):
    """The rule on the three values of every difference."""
    symbol = {"mean": "E", "sd": "s"}[field]
    rows = []
    for difference in differences:
        values = _three(output, difference, field)
        rows.append([names.difference(difference)] + [f"{value:.5f}" for value in values]
                    + [not rule(difference, *values)])
    return [f"{symbol}({hours})" for hours in HOUR_PAIRS], rows


def _dim_hours_are_alike(output):
    return _each(output, output.differences, "mean", lambda _, e412, e420, e1220: e420 < e412 and e420 < e1220)


def _evening_is_dimmer(output):
    return _each(output, _evaluated(output, EUCLIDEAN), "mean",
                 lambda _, e412, e420, e1220: e412 < e1220 < SLIGHTLY_ABOVE * e412)


def _boolean_saturates(output):
    return _each(output, _evaluated(output, BOOLEAN), "mean",
                 lambda _, e412, e420, e1220: abs(e412 - e1220) <= EQUAL_WITHIN)


def _features_are_ordered(output):
    missing = [d for d in BY_RISING_DIFFERENCE if d not in output.differences]
    if missing:
        raise NotJudged(", ".join(names.difference(d) for d in missing) + " was not evaluated")
    means = [_three(output, d, "mean") for d in BY_RISING_DIFFERENCE]
    rows = []
    for hours, values in zip(HOUR_PAIRS, zip(*means)):
        holds = all(low < high for low, high in zip(values, values[1:]))
        rows.append([f"{hours} h"] + [f"{value:.5f}" for value in values] + [not holds])
    return [f"E({names.difference(d)})" for d in BY_RISING_DIFFERENCE], rows


def _spread_of_dim_hours(output):
    def rule(difference, s412, s420, s1220):
        if difference in EUCLIDEAN:
            return s420 < s412 and s420 < s1220
        return s420 > s412 and s420 > s1220
    return _each(output, output.differences, "sd", rule)


def _self_tests_are_zero(output):
    pairs = [pair for pair in output.all_pairs if is_self_test(*pair)]
    if not pairs:
        raise NotJudged("no condition was compared with itself")
    # Of other hours the paper found nothing: a night has few features, and few of those make large residues.
    pairs = [pair for pair in pairs if pair[0] in _hours()] or pairs
    rows = []
    for difference in output.differences:
        is_direct = difference in BOOLEAN + EUCLIDEAN
        means = [output.summary[(*pair, difference)].mean for pair in pairs if (*pair, difference) in output.summary]
        series = [output.series[(*pair, difference)] for pair in pairs if (*pair, difference) in output.series]
        if not series or all(math.isnan(mean) for mean in means):
            raise NotJudged(f"a self-test of {names.difference(difference)} has no defined value")
        largest = max(mean for mean in means if not math.isnan(mean))
        # Only a query whose second neighbour is as near as can be, or that has none, may fail between equal images.
        unexplained = sum(int(((one.value > 0) & (((one.zero_second == 0) & (one.features_b > 1)) | is_direct)).sum())
                          for one in series)
        holds = unexplained == 0 and (largest == 0 if is_direct else largest <= SMALL_RESIDUE)
        twins = "" if is_direct else str(sum(int(one.zero_second.sum()) for one in series))
        rows.append([names.difference(difference), f"{largest:.3g}", twins, str(unexplained), not holds])
    return ["largest E", "twin queries", "values > 0 unexplained"], rows


RULES = [
    ("Morning and evening are nearer to each other than either is to noon.",
     "E(4–20) < E(4–12) and E(4–20) < E(12–20), for every algorithm evaluated.", _dim_hours_are_alike),
    ("Euclidean: noon is slightly further from evening than from morning, since 20 h is nearer to sunset than 4 h to "
     "sunrise.",
     f"E(4–12) < E(12–20) < {SLIGHTLY_ABOVE} E(4–12), for both Euclidean differences.", _evening_is_dimmer),
    ("Boolean differences saturate: noon is as far from morning as from evening.",
     f"|E(4–12) − E(12–20)| ≤ {EQUAL_WITHIN}, for both boolean differences.", _boolean_saturates),
    ("Features differ in the order SIFT < SURF < BRISK < ORB.",
     "E(SIFT) < E(SURF) < E(BRISK) < E(ORB) in each of the three pairs.", _features_are_ordered),
    ("Equal darkness does not make morning and evening interchangeable: their difference varies most along the path, "
     "but for the Euclidean ones, where it varies least.",
     "s(4–20) is the largest of the three for every algorithm but the Euclidean ones, and the smallest for those.",
     _spread_of_dim_hours),
    ("An hour against itself differs by nothing, but for small residues of features.",
     "Over two independent renderings of the paper's hours (of all, where it has none of these), direct differences are "
     f"exactly 0 at every pose; features have E ≤ {SMALL_RESIDUE} and are above 0 only at poses with twin queries (whose "
     "second neighbour is at distance 0, so that the strict ratio test fails) or a single feature (which has no second).",
     _self_tests_are_zero),
]
