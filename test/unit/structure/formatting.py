#!/usr/bin/env python3
"""Every C++ file is formatted by .clang-format, every Python and shell script has the run bit it needs."""
import os
import pathlib
import re
import subprocess
import sys
import unittest

import rosunit

SOURCE = pathlib.Path(__file__).resolve().parents[3]
FOLDERS = ("include", "src", "test", "bench")
VERSION = "14"  # of clang-format, that of Debian 12: each lays out some lines in its own way


def version_here():
    said = subprocess.run(["clang-format", "--version"], stdout=subprocess.PIPE, text=True, check=True).stdout
    return re.search(r"version (\d+)\.", said).group(1)


class Formatting(unittest.TestCase):
    def test_cpp_files_are_formatted(self):
        if version_here() != VERSION:
            self.skipTest("needs clang-format %s; here it is %s" % (VERSION, version_here()))
        files = sorted(str(path) for folder in FOLDERS for path in (SOURCE / folder).rglob("*")
                       if path.suffix in (".h", ".cpp"))
        self.assertGreater(len(files), 100)
        done = subprocess.run(["clang-format", "--dry-run", "-Werror", *files], stderr=subprocess.PIPE, text=True)
        self.assertEqual(done.returncode, 0, done.stderr[:3000])

    def test_scripts_can_be_run(self):
        for path in (SOURCE / "scripts").iterdir():
            if path.is_file():
                self.assertTrue(os.access(path, os.X_OK), path)


if __name__ == "__main__":
    rosunit.unitrun("sunlit", "formatting", Formatting, sysargs=sys.argv)
