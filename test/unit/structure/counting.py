#!/usr/bin/env python3
"""scripts/count_tests counts whatever failed, as the runners of tests write it."""
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import unittest

import rosunit

COUNT = pathlib.Path(__file__).resolve().parents[3] / "scripts" / "count_tests"
PASSED = '<testcase classname="a" name="one"/>'
FAILED = '<testcase classname="a" name="two"><failure>was 2</failure><failure>was 3</failure></testcase>'
SKIPPED = '<testcase classname="a" name="three"><skipped/></testcase>'


class Counting(unittest.TestCase):
    def counted(self, **files):
        with tempfile.TemporaryDirectory() as build:
            results = pathlib.Path(build) / "test_results" / "sunlit"
            results.mkdir(parents=True)
            for name, text in files.items():
                (results / (name + ".xml")).write_text(text, encoding="utf-8")
            done = subprocess.run([sys.executable, str(COUNT), build], stdout=subprocess.PIPE, text=True, check=False)
        return done.returncode, done.stdout.splitlines()

    def test_nobody_who_reads_on_is_no_word_worth(self):
        with tempfile.TemporaryDirectory() as build:
            read, write = os.pipe()
            os.close(read)
            done = subprocess.run([sys.executable, str(COUNT), build], stdout=write, stderr=subprocess.PIPE, check=False)
            os.close(write)
        self.assertEqual((done.returncode, done.stderr), (-signal.SIGPIPE, b""))

    def test_all_that_passed_is_a_success(self):
        status, said = self.counted(a=f'<testsuite failures="0" errors="0">{PASSED}{SKIPPED}</testsuite>')
        self.assertEqual((status, said[-1]), (0, "1 passed, 0 failed, 1 skipped"))

    def test_a_failure_is_named_once_whatever_it_says(self):
        status, said = self.counted(a=f'<testsuites failures="1"><testsuite failures="1" errors="0">{PASSED}{FAILED}</testsuite></testsuites>')
        self.assertEqual((status, said[-1]), (1, "1 passed, 1 failed, 0 skipped"))
        self.assertIn("FAILED: a.two", said)

    def test_parts_of_tests_that_stand_nowhere_else_are_counted(self):
        status, said = self.counted(a=f'<testsuite failures="2" errors="1">{PASSED}</testsuite>')
        self.assertEqual((status, said[-1]), (1, "1 passed, 1 failed, 0 skipped"))
        self.assertIn("FAILED: a: 3 parts of tests", said)

    def test_what_left_half_a_result_failed(self):
        status, said = self.counted(a=f'<testsuite>{PASSED}</testsuite>', b="<testsuite>")
        self.assertEqual((status, said[-1]), (1, "1 passed, 1 failed, 0 skipped"))

    def test_nothing_at_all_is_no_success(self):
        self.assertEqual(self.counted(), (1, ["0 passed, 0 failed, 0 skipped"]))


if __name__ == "__main__":
    rosunit.unitrun("sunlit", "counting", Counting)
