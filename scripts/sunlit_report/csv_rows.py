"""CSV files, row by row, and how bad ones are refused."""

import array
import csv
import math
import operator
import os

import numpy as np

MOST = 2**53  # to which numbers of any kind hold each whole one


class ReportError(Exception):
    """A folder or file that cannot be used; says which and where."""


def whole(text):
    value = int(text)
    if abs(value) > MOST:
        raise ValueError
    return value


def optional_whole(text):
    return whole(text) if text else None


def number(text):
    """Infinity is not a result of anything we read."""
    value = float(text)
    if math.isinf(value):
        raise ValueError
    return value


def rows(path, header, kinds, older=()):
    """Dictionaries of a CSV file's rows; `kinds` are the columns that are no text. Nothing where there is no file. Files
    of one of the `older` headers do without the rest."""
    lines = _lines(path, header, kinds, older)
    names = next(lines, ())
    for fields in lines:
        yield dict(zip(names, fields))


def by_pose(path, header, keys, kinds, older=()):
    """{texts of the columns `keys`: {column of `kinds`: array}}, by rising pose, of a file as above; NaN is what one of
    an `older` header does without. Raises ReportError for a pose that is there twice."""
    lines = _lines(path, header, kinds, older)
    names = next(lines, ())
    if not names:
        return {}
    known = [name for name in kinds if name in names]
    key_of = operator.itemgetter(*(names.index(name) for name in keys))
    numbers_of = operator.itemgetter(*(names.index(name) for name in known))
    collected = {}
    for line, fields in enumerate(lines, start=2):
        key = key_of(fields)
        numbers = collected.get(key)
        if numbers is None:
            numbers = collected[key] = array.array("d")  # of 8 bytes each, where a tuple takes ten times that
        numbers.append(line)
        numbers.extend(numbers_of(fields))
    found = {}
    for key, numbers in collected.items():
        table = np.frombuffer(numbers).reshape(-1, 1 + len(known))
        table = table[np.argsort(table[:, 1 + known.index("pose")], kind="stable")]
        columns = {name: column.astype(int) if kinds[name] is whole else column.copy() for name, column in zip(known, table.T[1:])}
        twice = np.flatnonzero(np.diff(columns["pose"]) == 0)
        if len(twice):
            at = twice[np.argmin(table[twice + 1, 0])]
            raise ReportError(f"{path}:{table[at + 1, 0]:.0f}: pose {columns['pose'][at]} of {', '.join(key)} "
                              f"was given on line {table[at, 0]:.0f} already")
        found[key] = {name: columns.get(name, np.full(len(table), np.nan)) for name in kinds}
    return found


def opened(path, errors="strict"):
    """A file of text, with its line ends as they are."""
    try:
        return open(path, newline="", encoding="utf-8", errors=errors)
    except OSError as error:
        raise ReportError(f"{path}: cannot be read: {error.strerror}") from None


def _lines(path, header, kinds, older):
    """First the names of the columns, then each row's fields."""
    if not os.path.exists(path):
        return
    with opened(path, errors="replace") as file:
        lines = csv.reader(file, strict=True)
        try:
            names = next(lines, None)
            if names not in [one.split(",") for one in (header, *older)]:
                raise ReportError(f"{path}:1: the first line must be {header}")
            yield names
            places = [(names.index(name), kind) for name, kind in kinds.items() if name in names]
            for fields in lines:
                if len(fields) != len(names):
                    raise ReportError(
                        f"{path}:{lines.line_num}: {len(fields)} fields, but must be {len(names)}: {','.join(names)}")
                try:
                    for place, kind in places:
                        fields[place] = kind(fields[place])
                except ValueError:
                    must = "a whole number" if kind in (whole, optional_whole) else "a finite number or nan"
                    raise ReportError(
                        f"{path}:{lines.line_num}: {names[place]} is {fields[place]!r}, but must be {must}") from None
                yield fields
        except csv.Error as error:
            raise ReportError(f"{path}:{lines.line_num}: {error}") from None
