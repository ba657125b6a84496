"""The page of an atlas, and what the terminal shows of it."""

import numpy as np

from . import atlas_figures, names, templating
from .localisation import USABLE_SHARE
from .pictures import data_uri
from .text import aligned

TABLE_HEADER = ["method", "best map", "lights that it serves", "worst map", "lights that it serves", "every map, on average"]


def pictures(atlas):
    """{name of the file: PNG}, usable_hours.png first, then method by method."""
    drawn = {"usable_hours.png": atlas_figures.usable_hours(atlas)}
    for method in atlas.methods:
        for metric in atlas_figures.METRICS:
            drawn[f"{metric[1]}_{method}.png"] = atlas_figures.heat_map(atlas, method, metric)
    return drawn


def served(atlas, method):
    """Of each map the number of lights in which it serves."""
    return (atlas_figures.usable_shares(atlas, method) >= USABLE_SHARE).sum(axis=1)


def table_rows(atlas):
    rows = []
    for method in atlas.methods:
        counts = served(atlas, method)
        best, worst = int(np.argmax(counts)), int(np.argmin(counts))
        rows.append([names.method(method), atlas.conditions.called(best), str(counts[best]), atlas.conditions.called(worst),
                     str(counts[worst]), f"{counts.mean():.1f} of {len(counts)}"])
    return rows


def title(atlas):
    dates = atlas.conditions.dates
    when = dates[0] if len(dates) == 1 else f"{len(dates)} days, {dates[0]} to {dates[-1]}"
    return f"What a map of each light is worth in each other: {when}"


def facts(atlas):
    queries = int(next(iter(atlas.matrices.values()))["n"][0, 0])
    cells = len(atlas.methods) * len(atlas.conditions) ** 2
    return [(str(queries), "poses"), (str(len(atlas.conditions)), "lights"), (str(len(atlas.methods)), "methods"),
            (templating.thousands(cells), "cells")]


def condition_rows(atlas):
    conditions = atlas.conditions
    return [[conditions.date[i], conditions.time[i], f"{conditions.sun_elevation_deg[i]:+.1f}", f"{conditions.illuminance_lx[i]:.3g}",
             f"{conditions.ev100_mean[i]:.1f}"] for i in range(len(conditions))]


def setting(atlas, option):
    """Its value as typed; empty where it was not, or is 0."""
    values = [line.partition(" ")[2] for line in atlas.settings if line.partition(" ")[0] == option]
    return "" if not values or float(values[-1]) == 0 else values[-1]


def render(atlas, drawn):
    """HTML text with everything in it."""
    methods = [(names.method(method), [(metric[2], data_uri("image/png", drawn[f"{metric[1]}_{method}.png"]))
                                       for metric in atlas_figures.METRICS]) for method in atlas.methods]
    return templating.template("atlas.html").render(
        title=title(atlas), query_offset=setting(atlas, "--query-offset"), facts=facts(atlas), usable_hours=data_uri("image/png", drawn["usable_hours.png"]), methods=methods,
        table_header=TABLE_HEADER, table_rows=table_rows(atlas), conditions=condition_rows(atlas), settings=atlas.settings)


def text(atlas):
    return ("Lights in which a map serves: at least 90 % of the queries within 0.5 m and 5 deg\n\n"
            + aligned(TABLE_HEADER, table_rows(atlas)))
