#!/usr/bin/env python3
"""Functions in unnamed namespaces of one library differ by name or parameters: its files are compiled several at a time, and so are
those of test programs. For the same reason no function of a nested namespace has the name of one of sunlit, which it would hide in
files that never saw it."""
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
CONSTANTS = re.compile(r"^(?:inline |static )?const(?:expr)? [^;]*", re.MULTILINE)
CONSTANT = re.compile(r"\b(k[A-Z]\w*)(?:\[\w*\])? ?(?:=(?!=)|\{)")
TYPE = re.compile(r"^(?:struct|class|enum class|enum|using) (\w+)(?! *\()\b", re.MULTILINE)
DECLARATION = re.compile(r"^(?:template <[^>]*> )?(?:\[\[\w+\]\] )?(?:(?:inline|constexpr|static|const) )*[A-Za-z][\w:]*(?:<[^()\n]*>)?[&* ]+(\w+)\(",
                         re.MULTILINE)
NAMESPACE = re.compile(r"^namespace sunlit(?:::([\w:]+))? \{$", re.MULTILINE)
BY_ARGUMENT = {"fieldsOf"}  # each stands with the type that it takes, whose namespace is looked into
PROGRAM = re.compile(r"sunlit_tests\(([a-z]+) (\w+)\s+FILES ([a-z0-9_ ]+?)\s*(?:LIBRARIES [^)]*)?\)")
OF_THE_PROCESS = re.compile(r"\b(?:setenv|unsetenv|setrlimit|fork|chdir|current_path|popen)\(")


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


def named(text):
    """Constants and types of a file's unnamed namespaces."""
    blocks = UNNAMED.findall(text)
    return {name for block in blocks for name in TYPE.findall(block)} | {
        name for block in blocks for declared in CONSTANTS.findall(block) for name in CONSTANT.findall(declared)}


def declared(text):
    """(namespace below sunlit or None, names of free functions) of a header, or None where it opens none."""
    opened = NAMESPACE.search(text)
    return opened and (opened[1], set(DECLARATION.findall(text[opened.end():])))


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

    def test_no_function_hides_one_of_sunlit(self):
        text = "namespace sunlit::a {\nconst B& of(int);\nstd::vector<C> all(\n  int member();\n}\n"
        self.assertEqual(declared(text), ("a", {"of", "all"}))
        names = collections.defaultdict(set)
        for folder in ("include", "src"):
            for path in (SOURCE / folder).rglob("*.h"):
                namespace, functions_there = declared(path.read_text()) or (None, set())
                for name in functions_there - BY_ARGUMENT:
                    names[namespace].add((name, path.relative_to(SOURCE)))
        of_sunlit = {name for name, _ in names.pop(None)}
        self.assertGreater(len(of_sunlit), 10)
        for namespace, functions_there in names.items():
            for name, path in functions_there:
                self.assertNotIn(name, of_sunlit, f"{path}: {name}() of {namespace} hides that of sunlit")

    def test_files_of_a_test_program_differ_and_change_no_more_than_themselves(self):
        self.assertEqual(named("namespace {\nconstexpr double kA = 1, kG = kH;\nconst B kC{2};\nstruct D : E {\n};\nusing F = G;\n}  // namespace\n"),
                         {"kA", "kC", "kG", "D", "F"})
        grouped = 0
        for lists in sorted((SOURCE / "test" / "unit").rglob("CMakeLists.txt")):
            for module, program, names in PROGRAM.findall(lists.read_text()):
                files = collections.defaultdict(set)
                for path in [lists.with_name(name + ".cpp") for name in names.split()]:
                    text = path.read_text()
                    self.assertIsNone(OF_THE_PROCESS.search(text), f"{path} changes its process, so it needs one of its own")
                    for told in functions(text) | named(text):
                        files[told].add(path.name)
                    grouped += 1
                for told, paths in sorted(files.items(), key=str):
                    self.assertEqual(len(paths), 1, f"test_{module}_{program}: {told} stands in {', '.join(sorted(paths))}")
        self.assertGreater(grouped, 100)


if __name__ == "__main__":
    rosunit.unitrun("sunlit", "unnamed", Unnamed, sysargs=sys.argv)
