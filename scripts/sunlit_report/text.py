"""The tables for the terminal."""

from . import findings as judge
from . import comparisons, localisation, tables, verified, warnings


def aligned(header, rows):
    widths = [max(len(str(row[k])) for row in [header] + rows) for k in range(len(header))]
    lines = []
    for row in [header] + rows:
        cells = [str(row[0]).ljust(widths[0])] + [str(cell).rjust(width) for cell, width in zip(row[1:], widths[1:])]
        lines.append("  ".join(cells).rstrip())
    lines.insert(1, "-" * len(lines[0]))
    return "\n".join(lines)


def _of_table(table):
    header = ["difference"] + [f"E {pair}" for pair in table["pairs"]] + [f"s {pair}" for pair in table["pairs"]]
    rows = []
    for row in table["rows"]:
        rows.append([row["name"]] + row["e"] + row["s"])
        if any(row["paper_e"]):
            rows.append(["  paper"] + row["paper_e"] + row["paper_s"])
    return aligned(header, rows)


def whole(output, findings):
    """Everything that the terminal shows."""
    parts = [f"Warning: {sentence}" for sentence in warnings.warnings(output)]
    if output.queries:
        parts += ["Queries localised in the map", aligned(localisation.TABLE_HEADER, localisation.table_rows(output))]
    if not output.series:
        return "\n\n".join(parts)
    parts.append("Mean difference E and standard deviation s along the path")
    parts += [_of_table(table) for table in tables.main_tables(output)]
    if output.verified.means:
        parts += ["Are the matches right? Means along the path",
                  aligned(verified.TABLE_HEADER, [cells for cells, _, _ in verified.table_rows(output)])]
    if output.comparisons:
        parts += ["Differences that are more than chance (Holm, 5 %)", aligned(comparisons.COUNTS_HEADER, comparisons.count_rows(output))]
    self_tables = tables.self_tables(output)
    if self_tables:
        parts += ["Each hour against itself (two independent renderings)"] + [_of_table(table) for table in self_tables]
    lines = [f"{number}. {finding.verdict}: {finding.claim}" + (f" It {finding.extent}." if finding.extent else "")
             for number, finding in enumerate(findings, start=1)]
    parts.append(f"The paper's findings: {judge.verdict_of_all(findings, output)}\n" + "\n".join(lines))
    return "\n\n".join(parts)
