"""CSV files, row by row, and how bad ones are refused."""

import csv
import math
import os


class ReportError(Exception):
    """A folder or file that cannot be used; says which and where."""


def whole(text):
    return int(text)


def optional_whole(text):
    return int(text) if text else None


def number(text):
    """Infinity is not a result of anything we read."""
    value = float(text)
    if math.isinf(value):
        raise ValueError
    return value


def rows(path, header, kinds, older=None):
    """Dictionaries of a CSV file's rows; `kinds` are the columns that are no text. Nothing where there is no file. Files
    of an `older` header do without the rest."""
    if not os.path.exists(path):
        return
    with open(path, newline="", encoding="utf-8", errors="replace") as file:
        lines = csv.reader(file, strict=True)
        try:
            names = next(lines, None)
            if names not in [one.split(",") for one in (header, older or header)]:
                raise ReportError(f"{path}:1: the first line must be {header}")
            for fields in lines:
                if len(fields) != len(names):
                    raise ReportError(
                        f"{path}:{lines.line_num}: {len(fields)} fields, but must be {len(names)}: {','.join(names)}")
                row = dict(zip(names, fields))
                for name, kind in ((name, kind) for name, kind in kinds.items() if name in row):
                    row[name] = converted(row[name], kind, f"{path}:{lines.line_num}: {name}")
                yield row
        except csv.Error as error:
            raise ReportError(f"{path}:{lines.line_num}: {error}") from None


def converted(text, kind, where):
    try:
        return kind(text)
    except ValueError:
        article = "a whole number" if kind in (whole, optional_whole) else "a finite number or nan"
        raise ReportError(f"{where} is {text!r}, but must be {article}") from None
