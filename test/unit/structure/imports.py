#!/usr/bin/env python3
"""Modules of a Python package import one another one way, without circles."""
import ast
import pathlib
import tempfile
import unittest

import rosunit

SCRIPTS = pathlib.Path(__file__).resolve().parents[3] / "scripts"


def imported(path):
    """What a module imports of its own package: `from . import a`, `from .a import b`, `from package import a`."""
    package = path.parent
    names = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom):
            module = node.module or ""
            if node.level == 1 or module.split(".")[0] == package.name:
                within = module if node.level else module.partition(".")[2]
                names |= {within.split(".")[0]} if within else {name.name for name in node.names}
        elif isinstance(node, ast.Import):
            names |= {name.name.split(".")[1] for name in node.names if name.name.startswith(package.name + ".")}
    return {name for name in names if (package / (name + ".py")).exists()}


def circle(package):
    """Modules of which each imports another one of them; none where all goes one way."""
    left = {path.stem: imported(path) for path in package.glob("*.py")}
    while True:
        ends = [name for name, names in left.items() if not names & left.keys()]
        if not ends:
            return sorted(left)
        for name in ends:
            del left[name]


class Imports(unittest.TestCase):
    def test_all_packages_import_one_way(self):
        packages = [folder for folder in SCRIPTS.iterdir() if (folder / "__init__.py").exists()]
        self.assertGreater(len(packages), 1)
        for package in packages:
            self.assertEqual(circle(package), [], package.name)

    def test_a_circle_is_found_however_it_is_written(self):
        with tempfile.TemporaryDirectory() as folder:
            package = pathlib.Path(folder) / "made"
            package.mkdir()
            for name, text in {"a": "from . import b\n", "b": "from .c import D\n", "c": "D = 1\n", "e": "import json\n"}.items():
                (package / (name + ".py")).write_text(text, encoding="utf-8")
            self.assertEqual(circle(package), [])
            for back in ("from . import a\n", "from .a import x\n", "import made.a\n", "from made import a\n", "from made.a import x\n"):
                (package / "c.py").write_text(back, encoding="utf-8")
                self.assertEqual(set(circle(package)), {"a", "b", "c"}, back)


if __name__ == "__main__":
    rosunit.unitrun("sunlit", "imports", Imports)
