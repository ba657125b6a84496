#!/usr/bin/env python3
"""compile_once.py COMPILER ARGUMENT...: a compiler launcher that takes the object file of an earlier build where that one
was made by the same command from the same files, byte for byte, and otherwise compiles.

SUNLIT_COMPILED names the compile_commands.json of the earlier build, SUNLIT_SAME_FOLDERS the folders that stand for one
another, as HERE=THERE:HERE=THERE, a folder before those around it."""
import filecmp
import json
import os
import shlex
import shutil
import subprocess
import sys

DEPENDENCY_OPTIONS = {"-MD": 1, "-MMD": 1, "-MT": 2, "-MF": 2}  # and how many words they are


def without_dependencies(words):
    kept, at = [], 0
    while at < len(words):
        count = DEPENDENCY_OPTIONS.get(words[at], 0)
        if not count:
            kept.append(words[at])
        at += count or 1
    return kept


def as_there(text, pairs):
    for here, there in pairs:
        text = text.replace(here + "/", there + "/")
    return text


def same_file(here, there, pairs):
    """Byte for byte, or but for the folders that a generated file names."""
    if filecmp.cmp(here, there, shallow=False):
        return True
    with open(here, errors="replace") as ours, open(there, errors="replace") as theirs:
        return as_there(ours.read(), pairs) == theirs.read()


def same_content(read, made, pairs):
    """Whether all files that the earlier compilation `read` are older than what it made, and are ours too."""
    for name in read:
        here, there = next((pair for pair in pairs if name.startswith(pair[1] + "/")), ("", ""))
        if os.path.getmtime(name) > os.path.getmtime(made):
            return False
        if here and not same_file(here + name[len(there):], name, pairs):
            return False
    return True


def earlier_object(words, output):
    """The object file that stands for what `words` would make, or None."""
    pairs = [pair.split("=") for pair in os.environ["SUNLIT_SAME_FOLDERS"].split(":")]
    folder = as_there(os.getcwd() + "/", pairs).rstrip("/")
    with open(os.environ["SUNLIT_COMPILED"]) as file:
        commands = [entry["command"] for entry in json.load(file)
                    if entry["directory"] == folder and " -o %s " % output in entry["command"]]
    expected = [as_there(word, pairs) for word in without_dependencies(words)]
    if [without_dependencies(shlex.split(command)) for command in commands] != [expected]:
        return None
    made = os.path.join(folder, output)
    with open(made + ".d") as file:
        # A compiler cache may name files as they are seen from where it was called.
        read = [os.path.normpath(os.path.join(folder, name))
                for name in file.read().replace("\\\n", " ").split(": ", 1)[1].split()]
    return made if same_content(read, made, pairs) else None


def main():
    words = sys.argv[1:]
    try:
        output = words[words.index("-o") + 1]
        made = earlier_object(words, output) if "-c" in words else None
    except (OSError, LookupError, ValueError):  # no such build, or one of another kind
        made = None
    if not made:
        usual = os.environ.get("CMAKE_CXX_COMPILER_LAUNCHER", "")  # a compiler cache
        return subprocess.call([word for word in usual.split(";") if word] + words)
    shutil.copyfile(made, output)
    if "-MF" in words:
        shutil.copyfile(made + ".d", words[words.index("-MF") + 1])
    return 0


sys.exit(main())
