#!/usr/bin/env python3
"""The line that tells how far a run is, and where it is shown."""

import fcntl
import math
import os
import pty
import signal
import struct
import subprocess
import sys
import tempfile
import termios
import unittest
from types import SimpleNamespace
from unittest import mock

import rosunit

sys.dont_write_bytecode = True
HERE = os.path.dirname(os.path.abspath(__file__))
SOURCE = os.path.join(HERE, "..", "..", "..")
sys.path[:0] = [os.path.join(SOURCE, "test", "support"), os.path.join(SOURCE, "scripts")]

from screen import Screen  # noqa: E402
from sunlit_experiment import display, guard as guarding, progress, summary  # noqa: E402
from sunlit_experiment.guard import Guard  # noqa: E402
from sunlit_experiment.launch import Failure  # noqa: E402


# Where a child finds our modules, whatever else is set.
FINDING = dict(os.environ, PYTHONPATH=os.pathsep.join([os.path.join(SOURCE, "scripts"), os.environ.get("PYTHONPATH", "")]))


def rendering(done, total=991, **changes):
    return progress.Status(doing="rendering", done=done, total=total, images_a_pose=3, **changes)


class Pace(unittest.TestCase):

    def pace(self, *times):
        made = progress.Pace()
        for now, done in times:
            made.update(now, done)
        return made

    def test_there_is_none_without_a_basis(self):
        self.assertTrue(math.isnan(progress.Pace().poses_a_second(100.0)))
        self.assertTrue(math.isnan(self.pace((0, 0)).poses_a_second(100.0)))
        self.assertTrue(math.isnan(self.pace((0, 0), (100, 1)).poses_a_second(101.0)))
        self.assertTrue(math.isnan(self.pace((0, 0), (1, 1), (1.1, 9)).poses_a_second(1.2)))  # eight, but in no time

    def test_loading_and_baking_do_not_count(self):
        # Two minutes, and then two poses a second.
        pace = self.pace((0, 0), (120, 1), *((120 + k / 2, 1 + k) for k in range(1, 9)))
        self.assertAlmostEqual(pace.poses_a_second(124.0), 2.0)

    def test_what_an_earlier_run_has_done_does_not_count(self):
        pace = self.pace((0, 900), (60, 901), (61, 902), (62, 903), (63, 904), (64, 905))
        self.assertAlmostEqual(pace.poses_a_second(64.0), 1.0)

    def test_it_follows_a_change(self):
        slow = [(k, k) for k in range(1, 100)]
        fast = [(100 + k / 10, 100 + k) for k in range(1, 1000)]
        self.assertAlmostEqual(self.pace((0, 0), *slow, *fast).poses_a_second(199.9), 10.0, places=0)

    def test_it_does_not_waver_between_two_poses(self):
        pace = self.pace(*((2.0 * k, k) for k in range(20)))
        self.assertEqual({pace.poses_a_second(38.0 + t) for t in (0.0, 0.5, 1.0, 1.9)}, {0.5})

    def test_a_run_that_stalls_does_not_look_fast(self):
        pace = self.pace(*((k, k) for k in range(20)))
        self.assertLess(pace.poses_a_second(100.0), 0.2)


class Line(unittest.TestCase):

    def test_it_says_all_of_a_run(self):
        self.assertEqual(progress.line(rendering(412, poses_a_second=4.1)),
                         "rendering: 412 of 991 poses (41 %), 12.3 images/s, 2 min 21 s left")

    def test_nothing_is_said_of_time_without_a_pace(self):
        self.assertEqual(progress.line(rendering(None)), "rendering: 0 of 991 poses (0 %)")
        self.assertEqual(progress.line(rendering(0, poses_a_second=0.0)), "rendering: 0 of 991 poses (0 %)")
        self.assertEqual(progress.line(rendering(991, poses_a_second=4.0)), "rendering: 991 of 991 poses (100 %)")

    def test_a_bake_tells_its_share(self):
        baking = progress.Status(doing="baking", share=0.426, seconds_left=31.2, total=991)
        self.assertEqual(progress.line(baking), "baking 42 %, 31 s left: 0 of 991 poses (0 %)")

    def test_a_time_left_that_was_told_long_ago_is_none(self):
        status = progress.Status(total=4)
        baking = SimpleNamespace(doing="baking", share=0.19, seconds_left=240.0)
        status.follow(baking, False, 19.0)
        self.assertEqual(progress.line(status), "baking 19 %, 4 min 00 s left: 0 of 4 poses (0 %)")
        status.follow(baking, False, 75.2)
        self.assertEqual(progress.line(status), "baking 19 %, no news for 1 min 15 s: 0 of 4 poses (0 %)")
        status.follow(SimpleNamespace(doing="rendering", share=math.nan, seconds_left=math.nan), False, 75.2)
        self.assertEqual(progress.line(status), "rendering: 0 of 4 poses (0 %)")

    def test_it_fits_into_any_terminal(self):
        for status in (rendering(412, poses_a_second=4.1), rendering(0), rendering(991), progress.Status(),
                       progress.Status(doing="baking", share=0.5, seconds_left=4000.0, total=10**7)):
            for columns in range(200):
                self.assertLessEqual(len(progress.fitted(status, columns)), columns, columns)
        self.assertEqual(progress.fitted(rendering(495, 990, poses_a_second=4.1), 200),
                         "[###############---------------]  495/990 poses  12.3 images/s  2 min 01 s left  rendering")
        self.assertEqual(progress.fitted(rendering(495, 990, poses_a_second=4.1), 45),
                         "495/990 poses  2 min 01 s left  rendering")
        self.assertEqual(progress.fitted(rendering(495, 990, poses_a_second=4.1), 30), "495/990 poses  rendering")

    def test_what_the_renderer_is_at(self):
        status = progress.Status(total=9)
        shown = []
        for done, doing, share, has_left in ((None, None, 0, False), (0, "loading", math.nan, False), (0, "baking", 0.5, False),
                                             (0, "waiting", math.nan, False), (0, "rendering", math.nan, False),
                                             (3, "waiting", math.nan, False), (8, "done", math.nan, False),
                                             (9, "waiting", math.nan, True)):
            status.done = done
            status.follow(doing and SimpleNamespace(doing=doing, share=share, seconds_left=math.nan), has_left)
            shown.append(progress.line(status).split(":")[0])
        self.assertEqual(shown, ["starting", "loading", "baking 50 %", "waiting", "rendering", "rendering", "evaluating",
                                 "evaluating"])

    def test_durations(self):
        self.assertEqual([progress.duration(s) for s in (0.4, 59.4, 59.6, 3599.4, 7260)],
                         ["0 s", "59 s", "1 min 00 s", "59 min 59 s", "2 h 01 min"])


class AtTheEnd(unittest.TestCase):

    def test_the_means_stand_in_tables_that_fit(self):
        row = lambda a, b, difference, mean: {"a": a, "b": b, "difference": difference, "mean": mean}
        self.assertEqual(summary.tables([row("h04", "h12", "orb", "0.25"), row("h04", "h20", "orb", ""),
                                         row("h04", "self_test/h04", "orb", "0")]),
                         "mean difference  h04-h12  h04-h20\norb              0.25000        -\n\n"
                         "with itself      h04\norb          0.00000")

    def test_a_run_without_its_localisation_is_not_whole(self):
        with tempfile.TemporaryDirectory() as folder:
            def check(outcome):
                with open(os.path.join(folder, "run.yaml"), "w") as file:
                    file.write("settings:\n  a: 'b'\noutcome:\n  whole: true\n" + outcome)
                summary.check_localised(folder)

            check("")  # nothing was to be localised, or it was before
            check("  key_frames: 3\n  not_localised: 0\n")
            with self.assertRaisesRegex(Failure, "nothing was localised: the map has no key frame"):
                check("  key_frames: 0\n  not_localised: 9\n")
            with self.assertRaisesRegex(Failure, "^2 queries were not looked for"):
                check("  key_frames: 3\n  not_localised: 2\n")
            check("  key_frames: 3\n  not_localised: 0\n  unplaced: []\n")
            with self.assertRaisesRegex(Failure, "^no query can be found by sift, orb: depth tells the place of none"):
                check("  key_frames: 3\n  not_localised: 0\n  unplaced: ['sift', 'orb']\n")

    def test_a_summary_is_this_run_s_by_being_another_file_whatever_the_clock_says(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "summary.csv")

            def write(pairs, when):
                with open(path + ".part", "w") as file:
                    file.write("a,b\n" + pairs)
                os.utime(path + ".part", (when, when))
                os.replace(path + ".part", path)

            self.assertEqual(summary.identity(path), "")
            with self.assertRaisesRegex(Failure, "evaluator ended before it had written summary.csv"):
                summary.read(folder, {"summary": ""})
            write("h04,h12\n", 2e9)
            self.assertEqual(len(summary.read(folder, {"summary": ""})), 1)
            earlier = summary.identity(path)
            with self.assertRaisesRegex(Failure, "evaluator ended before it had written summary.csv"):
                summary.read(folder, {"summary": earlier})
            write("h04,h12\nh04,h20\n", 1e9)  # by a clock that was set back meanwhile
            self.assertEqual(len(summary.read(folder, {"summary": earlier})), 2)
            with self.assertRaisesRegex(Failure, "before it had written comparisons.csv"):
                summary.read(folder, {"summary": earlier, "comparisons": ""})


class OnATerminal(unittest.TestCase):
    """Real pty, and what a terminal would make of it."""

    def setUp(self):
        environment = mock.patch.dict(os.environ, TERM="xterm")
        environment.start()
        self.addCleanup(environment.stop)
        self.master, slave = pty.openpty()
        self.stream = os.fdopen(slave, "w")
        self.addCleanup(self.stream.close)
        self.addCleanup(os.close, self.master)
        self.resize(10, 60)

    def resize(self, rows, columns):
        fcntl.ioctl(self.stream, termios.TIOCSWINSZ, struct.pack("HHHH", rows, columns, 0, 0))
        self.screen = Screen(rows, columns)

    def written(self):
        """Onto the screen. What is written to a pty takes its time to arrive, so an end is sent behind it."""
        end = "\x1b[99m"
        self.node_says(end)
        text = ""
        while not text.endswith(end):
            text += os.read(self.master, 65536).decode()
        self.screen.feed(text)
        return text[:-len(end)]

    def node_says(self, text):
        self.stream.write(text)
        self.stream.flush()

    def test_the_line_stays_in_place_and_warnings_stay_whole_above_it(self):
        shown = display.Display(self.stream)
        self.node_says("process[render-3]: started\n")
        for pose in range(40):
            shown.show(rendering(pose, 40))
            if pose % 2:
                self.node_says("[ WARN] warning of pose %d\n" % pose)
        self.written()
        self.assertIn("39/40 poses", self.screen.foot())
        self.assertEqual([line for line in self.screen.above() if line],
                         ["process[render-3]: started"] + ["[ WARN] warning of pose %d" % pose for pose in range(1, 40, 2)])
        shown.close()
        self.node_says("the end\n")
        self.written()
        self.assertEqual([line for line in self.screen.lines() if "poses" in line], [])
        self.assertIn("the end", self.screen.lines())

    def test_a_line_that_is_written_in_pieces_is_not_torn(self):
        shown = display.Display(self.stream)
        shown.show(rendering(1))
        for part in ("half of ", "a warn", "ing\n"):
            self.node_says(part)
            shown.show(rendering(2 + len(part)))
        self.written()
        self.assertIn("half of a warning", self.screen.above())

    def test_a_narrow_terminal_does_not_wrap(self):
        self.resize(10, 20)
        shown = display.Display(self.stream)
        shown.show(rendering(123, poses_a_second=2.0))
        self.written()
        self.assertEqual([line for line in self.screen.lines() if line], ["123/991  rendering"])

    def test_it_follows_a_change_of_size(self):
        shown = display.Display(self.stream)
        shown.show(rendering(1))
        self.written()
        self.resize(6, 80)
        shown.show(rendering(2))
        self.node_says("\n".join("line %d" % k for k in range(10)) + "\n")
        self.written()
        self.assertIn("2/991 poses", self.screen.foot())
        self.assertEqual([line for line in self.screen.above() if line.startswith("line")], ["line %d" % k for k in range(10)])

    def test_what_did_not_change_is_not_written(self):
        shown = display.Display(self.stream)
        shown.show(rendering(1))
        self.written()
        shown.show(rendering(1))
        self.assertEqual(self.written(), "")

    def test_all_rows_are_given_back_when_the_display_was_killed(self):
        display.Display(self.stream).show(rendering(1))
        display.restore(self.stream)
        self.written()
        self.assertEqual(self.screen.region, (0, 9))

    def test_a_terminal_that_knows_no_rows_gets_lines(self):
        with mock.patch.dict(os.environ, TERM="dumb"):
            shown = display.Display(self.stream)
            shown.show(rendering(1))
            display.restore(self.stream)
        self.assertEqual(self.written(), "experiment: rendering: 1 of 991 poses (0 %)\r\n")

    def test_a_terminal_that_hangs_up_does_not_end_the_run(self):
        shown = display.Display(self.stream)
        shown.show(rendering(1))
        self.written()
        with open(os.devnull, "rb") as nowhere:
            os.dup2(nowhere.fileno(), self.master)
        shown.show(rendering(2))
        shown.close()
        display.restore(self.stream)
        display.say("done", self.stream)
        display.Display(self.stream).show(rendering(3))


class Watched(unittest.TestCase):

    def test_a_guard_may_be_dismissed_again(self):
        guard = Guard(SimpleNamespace(pid=os.getpid(), log_folder="nowhere", may_end_children=False))
        guard.dismiss()
        guard.dismiss()
        self.assertEqual(guard.process.returncode, 0)

    def test_a_guard_is_found_whatever_python_looks_in(self):
        with tempfile.TemporaryDirectory() as folder, mock.patch.dict(os.environ):
            for name in ("select.py", "sunlit_experiment.py"):
                with open(os.path.join(folder, name), "w") as file:
                    file.write("raise SystemExit(7)\n")
            self.addCleanup(os.chdir, os.getcwd())
            os.chdir(folder)
            for look in ({}, {"PYTHONSAFEPATH": "1"}):
                os.environ.update(look)
                guard = Guard(SimpleNamespace(pid=os.getpid(), log_folder="nowhere", may_end_children=False))
                guard.dismiss()
                self.assertEqual(guard.process.returncode, 0)

    def test_a_guard_that_cannot_run_is_told_of_once_and_one_that_is_killed_is_not_started_for_ever(self):
        launch = SimpleNamespace(pid=os.getpid(), log_folder="nowhere", may_end_children=False)
        for begin, status, starts in (("raise SystemExit(3)", 3, 1),
                                      ("import os; os.kill(os.getpid(), 9)", -signal.SIGKILL, guarding.STARTS)):
            with mock.patch.object(guarding, "BEGIN", begin), mock.patch.object(guarding.display, "say") as said:
                guard = Guard(launch)
                for _ in range(guarding.STARTS + 2):
                    guard.process.wait()
                    guard.check()
                self.assertEqual(said.call_count, 1)
                self.assertIn("the guard of this node ended, with status %d:" % status, said.call_args[0][0])
                self.assertEqual(guarding.STARTS - guard.starts_left, starts)
                guard.dismiss()

    def test_a_guard_ends_what_a_roslaunch_started_that_went_before_it_looked(self):
        with tempfile.TemporaryDirectory() as folder:
            waits = [sys.executable, "-c", "import signal; signal.signal(signal.SIGINT, signal.SIG_DFL); print(flush=True); signal.pause()"]
            left = subprocess.Popen(waits + ["__log:=%s/it.log" % folder], preexec_fn=os.setpgrp, stdout=subprocess.PIPE)
            self.addCleanup(left.kill)
            left.stdout.readline()
            left.stdout.close()
            gone = subprocess.Popen(["true"])
            gone.wait()
            guard = Guard(SimpleNamespace(pid=gone.pid, log_folder=folder, may_end_children=True))
            self.assertEqual(left.wait(50), -signal.SIGINT)
            self.assertEqual(guard.process.wait(50), 1)
            guard.process.stdin.close()

    def test_what_a_roslaunch_started_ends_where_it_had_gone_before_the_node_looked(self):
        """As when its master is killed while it starts nodes: it goes at once, and leaves those that it started."""
        with tempfile.TemporaryDirectory() as folder:
            other = subprocess.Popen(["sleep", "60"], preexec_fn=os.setpgrp)  # logs elsewhere
            left = "import signal, time; signal.signal(signal.SIGINT, signal.SIG_DFL); print('up', flush=True); time.sleep(60)"
            node = ("import os, time; from sunlit_experiment.launch import launch_of_parent\n"
                    "while not os.path.exists('%s/gone'): time.sleep(0.01)\n"
                    "launch_of_parent('%s').break_off('interrupted')" % (folder, folder))
            launcher = os.path.join(folder, "roslaunch")
            with open(launcher, "w") as file:
                file.write("import os, subprocess, sys\nfor word in sys.argv[1:]:\n"
                           "  subprocess.Popen([sys.executable, '-c', word, '__log:=%s/it.log'], preexec_fn=os.setpgrp)\n" % folder)
            launched = subprocess.Popen([sys.executable, launcher, left, node], env=FINDING, start_new_session=True,
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            self.assertEqual(launched.stdout.readline(), "up\n")
            launched.wait()
            open(os.path.join(folder, "gone"), "w").close()
            # Its end is seen once both have closed what they wrote to.
            self.assertEqual(launched.communicate(timeout=50), ("", "experiment: FAILED: interrupted\n"))
            self.assertIsNone(other.poll())
            other.kill()
            other.wait()


class InAFile(unittest.TestCase):

    def test_what_nobody_reads_any_more_is_lost_and_the_run_goes_on(self):
        """Also as Python ends, which writes what it still has."""
        words = "import sys; from sunlit_experiment import display; [display.say('x' * 99999, sys.stdout) for _ in range(3)]"
        read, write = os.pipe()
        os.close(read)
        done = subprocess.run([sys.executable, "-c", words], env=FINDING, stdout=write, stderr=subprocess.PIPE, check=False)
        os.close(write)
        self.assertEqual((done.returncode, done.stderr), (0, b""))

    def test_a_run_goes_on_whose_standard_streams_were_closed(self):
        """Also for what it starts. No file gets the descriptor: what others write there would be in it."""
        words = """if True:
            import subprocess, sys
            from sunlit_experiment import display, progress
            closed = [name for _, name in display.STANDARD_STREAMS if getattr(sys, name) is None]
            assert closed == sys.argv[2:]
            display.open_standard_streams()
            with open(sys.argv[1], "w") as file:
                assert file.fileno() > max(display.STANDARD_STREAMS)[0]
            shown = display.Display(sys.stdout)
            shown.show(progress.Status(total=9))
            shown.close()
            display.restore(sys.stdout)
            display.say("done", sys.stdout)
            display.say("done", sys.stderr)
            subprocess.run(["sh", "-c", "echo done; echo done >&2"], check=True)
        """
        for closing, names in ((">&-", ["stdout"]), ("2>&-", ["stderr"]), (">&- 2>&-", ["stdout", "stderr"])):
            with tempfile.TemporaryDirectory() as folder:
                done = subprocess.run(["sh", "-c", 'exec "$@" ' + closing, "sh", sys.executable, "-c", words, os.path.join(folder, "file"), *names],
                                      env=FINDING, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
            self.assertEqual((done.returncode, done.stderr), (0, "" if "stderr" in names else "done\ndone\n"))
            self.assertNotIn("None", done.stdout)
            self.assertEqual(done.stdout.count("done\n"), 0 if "stdout" in names else 2)

    def test_a_line_at_each_turn_and_every_half_minute(self):
        read, write = os.pipe()
        lines = display.Lines(write)
        lines.show(progress.Status(total=9), 0.0)
        lines.show(progress.Status(doing="baking", share=0.1, total=9), 1.0)
        for second in range(2, 62):
            lines.show(progress.Status(doing="baking", share=second / 100, total=9), float(second))
        os.close(write)
        with os.fdopen(read) as said:
            self.assertEqual(said.read().splitlines(),
                             ["experiment: starting: 0 of 9 poses (0 %)", "experiment: baking 10 %: 0 of 9 poses (0 %)",
                              "experiment: baking 31 %: 0 of 9 poses (0 %)", "experiment: baking 61 %: 0 of 9 poses (0 %)"])


if __name__ == "__main__":
    rosunit.unitrun("sunlit", "experiment_progress", "__main__")
