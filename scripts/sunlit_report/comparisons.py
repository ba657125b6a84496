"""comparisons.csv: which differences between methods, and between hours, are more than chance."""

import math

from . import names
from .comparison_rows import SIGNIFICANT
from .tables import MISSING

SHOWN = 40  # rows of each family, the surest first
METRICS = {"d": "D", "matching_score_3px": "matching score", "precision_3px": "precision",
           "within_0.25m_2deg": "within 0.25 m, 2°", "within_0.5m_5deg": "within 0.5 m, 5°",
           "within_5m_10deg": "within 5 m, 10°", "error_m": "error / m"}
TABLE_HEADER = ["metric", "of", "a", "b", "n", "left out", "mean a − b", "95 % interval", "p", "p (Holm)"]


def _hours(name, pairs):
    """'h04-h12' -> '4–12 h', 'h04 in h12' -> '4 h in 12 h'; stream names may hold a dash of their own."""
    if " in " in name:
        return " in ".join(names.condition(part) for part in name.split(" in "))
    found = [pair for pair in pairs if "-".join(pair) == name]
    return names.pair(*found[0]) if found else name


def _p(value):
    return MISSING if math.isnan(value) else "< 0.0001" if value < 1e-4 else f"{value:.4f}"


def _left_out(row):
    told = [f"{count} {what}" for count, what in ((row.undefined, "undefined"), (row.failed, "failed"),
                                                  (row.unpaired, "alone")) if count]
    return ", ".join(told) or "0"


def _row(row, pairs):
    is_of_methods = row.family == "methods"
    hours = [_hours(name, pairs) for name in ((row.same,) if is_of_methods else (row.a, row.b))]
    methods = [names.difference(name) for name in ((row.a, row.b) if is_of_methods else (row.same,))]
    same, (a, b) = (hours[0], methods) if is_of_methods else (methods[0], hours)
    has_interval = not math.isnan(row.low)
    return [METRICS.get(row.metric, row.metric), same, a, b, str(row.n), _left_out(row),
            MISSING if math.isnan(row.mean_difference) else f"{row.mean_difference:+.3f}",
            f"[{row.low:+.3f}, {row.high:+.3f}]" if has_interval else MISSING, _p(row.p), _p(row.p_holm)]


def families(output):
    """What there is to say of each family: its title, how many of how many are significant by metric, and its rows as text,
    (cells, is significant), the surest first within a metric."""
    found = []
    for family, title in (("methods", "Between methods, at the same hours"), ("hours", "Between hours, by the same method")):
        of_family = [row for row in output.comparisons if row.family == family]
        if not of_family:
            continue
        metrics = list(dict.fromkeys(row.metric for row in of_family))
        ordered = sorted(of_family, key=lambda row: (math.isnan(row.p_holm), row.p_holm if row.p_holm < SIGNIFICANT else 1.0,
                                                     metrics.index(row.metric)))
        shown = sorted(ordered[:SHOWN], key=lambda row: metrics.index(row.metric))
        counts = [(METRICS.get(metric, metric), sum(row.is_significant for row in of_family if row.metric == metric),
                   sum(row.metric == metric for row in of_family)) for metric in metrics]
        found.append({"family": family, "title": title, "counts": counts, "all": len(of_family),
                      "rows": [(_row(row, output.all_pairs), row.is_significant) for row in shown]})
    return found
