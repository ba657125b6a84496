"""Puts the page together."""

from . import comparison_rows, comparisons, figures, localisation, lost, lost_rows, map_figure, matrices, names, paper, pictures, tables, templating, verified, warnings
from . import findings as judge

SHOWN_PROBLEMS = 100
PAIRS_PER_PLOT = 6  # as many lines can be told apart


def render(output, findings):
    """HTML text with everything in it."""
    significant, significant_count = comparisons.significant_rows(output)
    return templating.template("report.html").render(
        output=output, findings=findings, verdict_of_all=judge.verdict_of_all(findings, output), citation=paper.CITATION,
        title=title(output), until_which=names.until_which(output.conditions), facts=facts(output), warnings=warnings.warnings(output), verdict_class=_verdict_class,
        main_tables=tables.main_tables(output), self_tables=tables.self_tables(output), counts=tables.counts(output),
        conditions=tables.conditions(output), timing=tables.timing(output), problems=tables.problems(output),
        shown_problems=tables.gravest_first(output.problems)[:SHOWN_PROBLEMS], counters=tables.counters(output.run),
        settings=settings(output), versions=tables.flattened(tables.mapping(output.run, "versions")),
        grid=pictures.grid(output), smoothed_over=figures.SMOOTHED_OVER,
        comparison_counts=comparisons.count_rows(output), counts_header=comparisons.COUNTS_HEADER,
        comparisons=significant, significant_count=significant_count, comparisons_header=comparisons.TABLE_HEADER,
        significant=comparison_rows.SIGNIFICANT,
        localised=localisation.table_rows(output), localised_header=localisation.TABLE_HEADER,
        **matches(output), **plots(output))


def _verdict_class(verdict):
    return {judge.REPRODUCED: "yes", judge.NOT_REPRODUCED: "no"}.get(verdict, "open")


def matches(output):
    """What verified.html shows; nothing without verified matches."""
    if not output.verified.means:
        return {"verified_rows": []}
    found = verified.table_rows(output)
    return {"verified_rows": found, "verified_header": verified.TABLE_HEADER,
            "undefined_verified": "; ".join(f"{cells[0]}, {cells[1]}: {undefined}" for cells, _, undefined in found if undefined),
            "accuracy": pictures.svg_uri(verified.accuracy(output)), "drawn": verified.drawn(output)}


def plots(output):
    """The figures; pairs of different conditions, or the self-tests where there is nothing else."""
    pairs = output.shown_pairs
    return {
        "usable_hours": pictures.svg_uri(localisation.usable_hours(output)) if output.queries else None,
        "errors_along_path": [pictures.svg_uri(localisation.errors_along_path(output, few))
                              for few in tables.chunks(localisation.pairs(output.queries), PAIRS_PER_PLOT)],
        "along_path": [pictures.svg_uri(figures.along_path(output, few))
                       for few in tables.chunks(pairs, PAIRS_PER_PLOT)],
        "matrices": pictures.svg_uri(matrices.of_all_pairs(output)) if matrices.worth_showing(output) else None,
        "boxes": pictures.svg_uri(figures.boxes(output, pairs)) if pairs else None,
        "over_elevation": _uri(localisation.over_elevation(output)),
        "found_on_map": _found_on_map(output),
        "lost": pictures.svg_uri(lost.heat_maps(output)) if output.lost else None,
        "lost_rows": lost.table_rows(output), "lost_header": lost.TABLE_HEADER, "least_features": lost_rows.LEAST_FEATURES,
        "map": pictures.svg_uri(map_figure.path_on_map(output)) if output.path else None,
    }


def _uri(figure):
    return pictures.svg_uri(figure) if figure else None


def _found_on_map(output):
    if not output.positions:
        return None
    picture, shown, hours = map_figure.found_on_map(output)
    return pictures.svg_uri(picture), shown, hours


def title(output):
    listed = names.conditions(output.conditions)
    if output.pairs:
        return f"How far images of one place drift apart between {listed}"
    if not output.self_pairs:
        maps = " or ".join(names.condition_of_map(name) for name in localisation.maps(output.queries))
        return f"{names.until_which(output.conditions)} a map of {maps} serves"
    return f"How far images of one place at {listed} differ from themselves"


def facts(output):
    """(number, what it counts) for the first lines."""
    undefined = sum(row.undefined for row in output.summary.values())
    values = templating.thousands(sum(row.n for row in output.summary.values()))
    found = [(f"{len(output.poses)}", "poses"), (f"{len(output.conditions)}", "conditions")]
    if output.series:
        found += [(f"{len(output.differences)}", "differences"), (values, "values"), (f"{undefined}", "undefined values")]
    if output.queries:
        found.append((f"{sum(len(one.pose) for one in output.queries.values())}", "queries of a map"))
    if output.path:
        found.insert(1, (f"{figures.distance_driven(output):.0f} m", "driven"))
    return found


def settings(output):
    """Settings in groups by what stands before the first slash: [(group, [(key, value)])]."""
    groups = {}
    top = {key: value for key, value in output.run.items() if key not in ("settings", "versions", "counters")}
    if output.inputs:  # bags come without
        top["inputs"] = output.inputs
    if output.rasterizer:
        top["drawn by"] = output.rasterizer
    if output.ground_albedo is not None:
        top["albedo of the land around the world"] = output.ground_albedo
    for key, value in tables.flattened(output.settings) + tables.flattened(top):
        group, _, rest = key.rpartition("/")
        groups.setdefault(group or "general", []).append((rest, value))
    return sorted(groups.items(), key=lambda item: (item[0] != "general", not item[0].startswith("about"), item[0]))
