"""What was set for an earlier run, and is spelt otherwise now but means the same."""

import os

from sunlit_experiment import arguments as read

FILES = ("world", "robot", "path")
TIMES = ("hours", "conditions")


def as_before(now, before, has_inputs):
    """`now`, texts by name, with those of `before` where they mean the same: what the evaluator compares are texts.
    `has_inputs`: the renderer compares what files hold, and what the earlier run's were called stays; else by name."""
    times = _times(now)
    same_times = times is not None and times == _times(before)

    def means_the_same(name):
        if name in TIMES and same_times:
            return True
        if name == "camera":
            return _is_same_camera(now[name], before[name], has_inputs)
        if name in FILES:
            return has_inputs or _is_same_file(now[name], before[name])
        return _value(now[name]) == _value(before[name])

    return {name: before[name] if name in before and means_the_same(name) else text for name, text in now.items()}


def _times(about):
    """Nothing where they cannot be understood."""
    try:
        return read.conditions(about["conditions"], about["hours"])
    except (KeyError, read.BadArgument):
        return None


def _value(text):
    try:
        return read.parse("", text, "")
    except read.BadArgument:
        return text


def _is_same_camera(now, before, has_inputs):
    """FILE, 1.0 m; without a file all of it are numbers, whose spelling the evaluator sees through."""
    (file, _, height), (file_before, _, height_before) = (text.rpartition(", ") for text in (now, before))
    same_height = _value(height.rstrip(" m")) == _value(height_before.rstrip(" m"))
    same_name = has_inputs and os.path.basename(file) == os.path.basename(file_before)
    return same_height and (same_name or _is_same_file(file, file_before))


def _is_same_file(now, before):
    try:
        return now == before or read.file(now).rstrip("/") == read.file(before).rstrip("/")
    except read.BadPath:  # what cannot be named from here, such as a file of the current folder, which was deleted
        return False
