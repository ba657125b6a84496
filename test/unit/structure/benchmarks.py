#!/usr/bin/env python3
"""What stands in bench/ compiles. Nobody builds it but who measures, who would find it left behind by the code."""
import json
import os
import shlex
import subprocess
import unittest

import rosunit

COMPILED, COMPILER = os.environ["SUNLIT_COMPILED"], os.environ["SUNLIT_COMPILER"]
FOLDER = os.path.join(os.environ["SUNLIT_SOURCE_DIR"], "bench", "")


class Benchmarks(unittest.TestCase):
    def test_all_compile(self):
        with open(COMPILED, encoding="utf-8") as file:
            entries = [entry for entry in json.load(file) if entry["file"].startswith(FOLDER)]
        if not entries:
            self.skipTest("there is no Google Benchmark here")
        for entry in entries:
            words = shlex.split(entry["command"])
            words = words[words.index(COMPILER):]  # behind a compiler cache, if there is one
            del words[words.index("-o"):words.index("-o") + 2]
            with self.subTest(os.path.basename(entry["file"])):
                done = subprocess.run([*words, "-fsyntax-only"], cwd=entry["directory"], stderr=subprocess.PIPE, text=True, check=False)
                self.assertEqual(done.returncode, 0, done.stderr)


if __name__ == "__main__":
    rosunit.unitrun("sunlit", "benchmarks", Benchmarks)
