#!/usr/bin/env python3
"""What bags of a broken off run are worth, on bags made up here."""

import os
import select
import struct
import subprocess
import sys
import tempfile
import unittest
from unittest import mock

import genpy
import rosbag
import rosunit
from sensor_msgs.msg import CameraInfo
from std_msgs.msg import UInt32

sys.dont_write_bytecode = True
SOURCE = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", ".."))
sys.path.insert(0, os.path.join(SOURCE, "scripts"))

from sunlit_experiment import recording  # noqa: E402
from sunlit_experiment.idle import wait_until_idle  # noqa: E402

FINDING = dict(os.environ, PYTHONPATH=os.pathsep.join([os.path.join(SOURCE, "scripts"), os.environ.get("PYTHONPATH", "")]))
A, B = "/a/camera/camera_info", "/b/camera/camera_info"
TOPICS = ["/clock", A, B]
CLOCK = recording.Clock(1000.0, 10.0)
CHUNK = 4096  # bytes, some ten messages


class Recording(unittest.TestCase):

    def setUp(self):
        kept = tempfile.TemporaryDirectory()
        self.addCleanup(kept.cleanup)
        self.folder = kept.name
        self.told = []

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, poses, topics=(A, B)):
        with rosbag.Bag(self.path(name), "w", chunk_threshold=CHUNK) as bag:
            bag.write("/clock", UInt32(), genpy.Time(1, 0))
            for pose in poses:
                for topic in topics:
                    message = CameraInfo()
                    message.header.stamp = genpy.Time(1000 + pose // 10, pose % 10 * 100000000)
                    bag.write(topic, message, genpy.Time(5000, 0))  # when it came does not matter

    def kill(self, name, share=1.0):
        """Leaves what `rosbag record` does when it is killed: no index, and a last chunk that may be torn."""
        with rosbag.Bag(self.path(name)) as bag:
            index = bag._index_data_pos
        with open(self.path(name), "r+b") as file:
            file.truncate(int(index * share))
            content = file.read(4096)
            at = content.index(b"index_pos=") + len(b"index_pos=")
            file.seek(at)
            file.write(struct.pack("<Q", 0))
        os.rename(self.path(name), self.path(name + ".active"))

    def union(self, poses):
        return recording.Union(self.folder, TOPICS, CLOCK, poses)

    def mend(self):
        recording.mend(self.folder, self.told.append)

    def test_several_bags_count_together(self):
        self.write("recording_1.bag", range(0, 12))
        self.write("recording_2.bag", range(9, 20))
        union = self.union(20)
        self.assertEqual(union.missing(), {})
        self.assertEqual(union.first_missing(), 20)
        self.assertEqual(union.twice(), {9, 10, 11})
        self.assertEqual(union.table(), [("recording_1.bag", 0, 11, 12), ("recording_2.bag", 9, 19, 11)])

    def test_a_pose_that_one_topic_lacks_is_missing(self):
        self.write("recording_1.bag", range(0, 5))
        self.write("recording_2.bag", range(5, 8), topics=(A,))
        union = self.union(8)
        self.assertEqual(union.missing(), {B: [5, 6, 7]})
        self.assertEqual(union.first_missing(), 5)

    def test_without_bags_all_is_missing(self):
        self.write("someone_elses.bag", range(8))
        self.assertEqual(self.union(8).first_missing(), 0)

    def test_a_bag_that_was_left_open_is_mended(self):
        self.write("recording_1.bag", range(40))
        self.kill("recording_1.bag")
        self.mend()
        self.assertEqual(sorted(os.listdir(self.folder)), ["recording_1.bag"])
        self.assertEqual(self.union(40).first_missing(), 40)
        self.assertIn("reindexing", self.told[0])

    def test_of_a_torn_bag_the_whole_chunks_are_kept(self):
        self.write("recording_1.bag", range(40))
        self.kill("recording_1.bag", share=0.6)
        self.mend()
        self.assertEqual(sorted(os.listdir(self.folder)), ["recording_1.bag"])
        first = self.union(40).first_missing()
        self.assertTrue(0 < first < 40, first)

    def test_the_original_stays_where_nothing_can_be_made_of_it(self):
        with open(self.path("recording_1.bag.active"), "wb") as file:
            file.write(b"no bag at all")
        self.mend()
        self.assertEqual(os.listdir(self.folder), ["recording_1.bag.active"])
        self.assertIn("cannot be reindexed", self.told[-1])

    def test_a_bag_that_cannot_be_read_is_named_and_holds_nothing(self):
        with open(self.path("recording_1.bag"), "wb") as file:
            file.write(b"no bag at all")
        self.write("recording_2.bag", range(8))
        union = self.union(8)
        self.assertEqual(union.missing(), {})
        self.assertIn("recording_1.bag cannot be read", union.unreadable[0])

    def test_a_bag_that_is_still_being_written_is_waited_for(self):
        """A recorder outlives its experiment by the time that it needs to close its bag."""
        self.check_that_a_writer_is_waited_for()

    def test_two_that_mend_at_once_do_it_once(self):
        """As where the same experiment is started again before the planner of the first has ended."""
        self.write("recording_1.bag", range(40))
        self.kill("recording_1.bag")
        mend = ("import sys; from sunlit_experiment import recording\n"
                "recording.mend(sys.argv[1], lambda line: print(line, flush=True) or sys.stdin.readline())")
        first, other = (subprocess.Popen([sys.executable, "-c", mend, self.folder], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                         env=FINDING) for _ in range(2))
        told = [first.stdout, other.stdout]
        ready, _, _ = select.select(told, [], [], 60)
        begun = ready[0]
        self.assertIn(b"reindexing", begun.readline())
        busy, waits = (first, other) if begun is first.stdout else (other, first)
        self.assertEqual(select.select([waits.stdout], [], [], 1.0)[0], [])
        busy.communicate(b"\n")
        self.assertEqual((waits.communicate()[0], busy.returncode, waits.returncode), (b"", 0, 0))
        self.assertEqual(sorted(os.listdir(self.folder)), ["recording_1.bag"])
        self.assertEqual(self.union(40).first_missing(), 40)

    def test_one_in_a_folder_that_an_experiment_writes_into_stays(self):
        """Whoever records it may be another user, or in another container: nobody here sees what is open there."""
        self.write("recording_1.bag", range(3))
        self.kill("recording_1.bag")
        before = sorted(os.listdir(self.folder))
        with subprocess.Popen(["flock", self.folder, "sh", "-c", "echo; read _"], stdin=subprocess.PIPE, stdout=subprocess.PIPE) as holder:
            holder.stdout.readline()
            with mock.patch.object(recording, "PATIENCE_S", 0.3), self.assertRaises(recording.RecordingError) as refused:
                self.mend()
            holder.communicate(b"\n")
        self.assertEqual(str(refused.exception),
                         f"another experiment is writing into {self.folder}: choose another output folder")
        self.assertEqual(sorted(os.listdir(self.folder)), before)
        self.mend()
        self.assertEqual(sorted(os.listdir(self.folder)), ["recording_1.bag"])

    def test_one_that_another_is_about_is_waited_for_until_patience_ends(self):
        self.write("recording_1.bag", range(3))
        active = self.path("recording_1.bag.active")
        os.rename(self.path("recording_1.bag"), active)
        with subprocess.Popen(["flock", active, "sh", "-c", "echo; read _"], stdin=subprocess.PIPE, stdout=subprocess.PIPE) as holder:
            holder.stdout.readline()
            with mock.patch.object(recording, "PATIENCE_S", 0.3), self.assertRaises(recording.RecordingError) as refused:
                self.mend()
            # Seen or not, as where it is another user's.
            with mock.patch.object(recording, "PATIENCE_S", 0.3), mock.patch.object(recording, "_writer_of", lambda _: None), \
                    self.assertRaises(recording.RecordingError) as refused_unseen:
                self.mend()
            holder.communicate(b"\n")
        self.assertRegex(str(refused.exception), "is still being written or reindexed, by process [0-9]+$")
        self.assertRegex(str(refused_unseen.exception), "is still being written or reindexed, by another user$")
        self.assertEqual((self.told, os.listdir(self.folder)), ([], ["recording_1.bag.active"]))

    def test_what_was_killed_while_it_mended_is_done_again(self):
        self.write("recording_1.bag", range(40))
        self.kill("recording_1.bag")
        with open(self.path("recording_1.bag.part"), "wb") as draft:
            draft.write(b"x" * 10**6)
        self.mend()
        self.assertEqual(sorted(os.listdir(self.folder)), ["recording_1.bag"])
        self.assertEqual(self.union(40).first_missing(), 40)

    def test_nor_is_one_taken_away_whose_folder_is_linked(self):
        linked = self.folder + "_linked"
        os.symlink(self.folder, linked)
        self.addCleanup(os.remove, linked)
        self.folder = linked
        self.check_that_a_writer_is_waited_for()

    def check_that_a_writer_is_waited_for(self):
        self.write("recording_1.bag", range(3))
        active = self.path("recording_1.bag.active")
        os.rename(self.path("recording_1.bag"), active)
        writer = subprocess.Popen([sys.executable, "-c", "import os, sys\nheld = open(sys.argv[1], 'ab')\nprint(flush=True)\n"
                                   "sys.stdin.read()\nos.rename(sys.argv[1], sys.argv[1][:-7])", active],
                                  stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        writer.stdout.readline()  # it has it open
        looks = []

        def let_it_end(_):
            looks.append(True)
            writer.communicate(b"")
        sleep, recording.time.sleep = recording.time.sleep, let_it_end
        try:
            self.mend()
        finally:
            recording.time.sleep = sleep
        self.assertEqual((looks, self.told, os.listdir(self.folder)), ([True], [], ["recording_1.bag"]))

    def test_a_process_is_idle_once_all_its_threads_wait(self):
        with subprocess.Popen([sys.executable, "-c", "import os, sys, threading\nthreading.Thread(target=sys.stdin.read).start()\n"
                               "print(flush=True)\nwhile not os.path.exists(sys.argv[1]):\n    pass", self.path("done")],
                              stdin=subprocess.PIPE, stdout=subprocess.PIPE) as working:
            working.stdout.readline()
            self.assertFalse(wait_until_idle(working.pid, 0.3))
            open(self.path("done"), "wb").close()
            self.assertTrue(wait_until_idle(working.pid, 30.0))
            self.assertIsNone(working.poll())
            working.communicate(b"")

    def test_ranges(self):
        self.assertEqual(recording.ranges([2, 0, 1, 5, 7, 8]), "0-2, 5, 7-8")
        self.assertEqual(recording.ranges([]), "")


if __name__ == "__main__":
    rosunit.unitrun("sunlit", "experiment_recording", "__main__")
