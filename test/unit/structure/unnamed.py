#!/usr/bin/env python3
"""Functions in unnamed namespaces of one library differ by name or parameters: its files are compiled several at a time."""
import collections
import pathlib
import re
import sys
import unittest

import rosunit

SOURCE = pathlib.Path(__file__).resolve().parents[3]
# Of these one is built at most.
ALTERNATIVES = re.compile(r"(_9|_12|_absent|_openssl)\.cpp$")
DEFINITION = re.compile(
    r"^(?!return|using|static_assert|namespace|template|struct|class|enum|#|//)"
    r"[A-Za-z_][\w:<>,&*\[\] ]*?[ &*](\w+)\(((?:[^()]|\([^()]*\))*)\)(?: const)?(?: noexcept)?(?: ->[^{]*)? \{",
    re.MULTILINE)
UNNAMED = re.compile(r"^namespace \{\n(.*?)^\}  // namespace$", re.MULTILINE | re.DOTALL)


def parameters(text):
    """What tells overloads apart, about: types without const, names and defaults."""
    parts, depth, part = [], 0, ""
    for letter in text + ",":
        depth += {"<": 1, "(": 1, ">": -1, ")": -1}.get(letter, 0)
        if letter == "," and depth == 0:
            parts.append(part)
            part = ""
        else:
            part += letter
    types = []
    for part in parts:
        part = re.sub(r"=.*|/\*.*?\*/", "", part, flags=re.DOTALL).strip()
        part = re.sub(r"(?<=[\w>&*\]])(\s+|(?<=[&*]))\w+$", "", part)
        types.append(re.sub(r"\s+|\bconst\b", "", part))
    return tuple(types)


def functions(text):
    """(name, parameters) of all in a file's unnamed namespaces."""
    return {(match[1], parameters(match[2]))
            for block in UNNAMED.findall(text) for match in DEFINITION.finditer(block)}


class Unnamed(unittest.TestCase):
    def test_is_told(self):
        text = "namespace {\nint of(const A& a, int b = 3) {\n}\nstd::map<A, B> of(\n    A* a) const {\n}\n}  // namespace\n"
        self.assertEqual(functions(text), {("of", ("A&", "int")), ("of", ("A*",))})

    def test_functions_of_a_library_differ(self):
        seen = 0
        for library in [path for path in (SOURCE / "src").iterdir() if path.is_dir() and path.name != "ros"] + [
                path for path in (SOURCE / "src" / "ros").iterdir() if path.is_dir()]:
            if library.name == "tools":  # programs
                continue
            files = collections.defaultdict(set)
            for path in library.rglob("*.cpp"):
                if ALTERNATIVES.search(path.name):
                    continue
                for function in functions(path.read_text()):
                    files[function].add(path.name)
                    seen += 1
            for function, names in sorted(files.items()):
                self.assertEqual(len(names), 1, f"{library.name}: {function[0]}() stands in {', '.join(sorted(names))}")
        self.assertGreater(seen, 1000)


if __name__ == "__main__":
    rosunit.unitrun("sunlit", "unnamed", Unnamed, sysargs=sys.argv)
