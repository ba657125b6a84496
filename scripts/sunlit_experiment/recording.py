"""The bags of an output folder: what they shall hold, what they do hold, and what a kill left of them.

rosbag is imported where it is needed, since that takes longer than all the rest of a plan.
"""

import collections
import contextlib
import dataclasses
import errno
import fcntl
import os
import shutil
import struct
import time

import psutil

PREFIX = "recording_"
NODE = "recorder"     # who records
ACTIVE = ".bag.active"  # as rosbag record calls a bag that it still writes
PATIENCE_S = 20.0       # for a recorder that closes its bag while its experiment has gone
LOOK_EVERY_S = 0.1


class RecordingError(Exception):
    """A bag that cannot be dealt with, and why."""


def topics(conditions, compressed=False, stereo=False):
    """What is recorded; of each topic below .../camera/ one message a pose."""
    names = ["/clock", "/tf", "/tf_static", "/path", "/camera/pose", "/camera/depth/image_raw", "/camera/depth/camera_info"]
    image = "image_raw/compressed" if compressed else "image_raw"
    right = ("camera/right/" + image, "camera/right/camera_info") if stereo else ()
    for condition in conditions:
        names += [f"/{condition}/{topic}" for topic in
                  ("sun", "moon", "celestial", "camera/" + image, "camera/camera_info", "camera/capture", *right)]
    return names


def of_each_pose(names):
    return [name for name in names if "/camera/" in name]


@dataclasses.dataclass
class Clock:
    """Which stamp a pose has: start + pose / rate."""
    start_stamp: float  # s
    frame_rate: float   # Hz

    def pose(self, seconds, nanoseconds):
        return round((seconds + 1e-9 * nanoseconds - self.start_stamp) * self.frame_rate)


def bags(folder):
    return sorted(entry.path for entry in os.scandir(folder)
                  if entry.name.startswith(PREFIX) and entry.name.endswith(".bag"))


def poses_in(bag, names, clock):
    """Of each topic how often each pose is in a bag, by the stamps in the headers."""
    import rosbag  # pylint: disable=import-outside-toplevel
    found = {name: collections.Counter() for name in names}
    try:
        with rosbag.Bag(bag) as messages:
            for topic, (_, data, *_), _ in messages.read_messages(topics=names, raw=True):
                _, seconds, nanoseconds = struct.unpack_from("<III", data)  # each begins with a std_msgs/Header
                found[topic][clock.pose(seconds, nanoseconds)] += 1
    except (OSError, rosbag.ROSBagException, struct.error) as error:
        raise RecordingError(f"{bag} cannot be read: {error}") from None
    return found


def holds_poses(bag, names):
    """Whether any message of a pose is in a bag, by its index; True where that cannot be read."""
    import rosbag  # pylint: disable=import-outside-toplevel
    try:
        with rosbag.Bag(bag) as messages:
            return messages.get_message_count(of_each_pose(names)) > 0
    except (OSError, rosbag.ROSBagException, struct.error):
        return True


class Union:
    """What all bags of a folder hold together."""

    def __init__(self, folder, names, clock, poses):
        self.topics = of_each_pose(names)
        self.poses = poses
        self.by_bag = {}
        self.unreadable = []
        for bag in bags(folder):
            try:
                self.by_bag[os.path.basename(bag)] = poses_in(bag, self.topics, clock)
            except RecordingError as error:
                self.unreadable.append(str(error))

    def _counts(self, topic):
        return sum((found[topic] for found in self.by_bag.values()), collections.Counter())

    def missing(self):
        """Poses by topic, of those topics that lack any."""
        lacking = {}
        for topic in self.topics:
            held = self._counts(topic)
            absent = [pose for pose in range(self.poses) if not held[pose]]
            if absent:
                lacking[topic] = absent
        return lacking

    def first_missing(self):
        return min((absent[0] for absent in self.missing().values()), default=self.poses)

    def twice(self):
        """Poses that some topic holds more than once: what one run recorded and the next rendered again."""
        return {pose for topic in self.topics for pose, count in self._counts(topic).items() if count > 1}

    def table(self):
        """(bag, first pose, last pose, how many poses) of each bag, by the poses that are whole in it."""
        rows = []
        for bag, found in self.by_bag.items():
            whole = set.intersection(*(set(found[topic]) for topic in self.topics)) if self.topics else set()
            rows.append((bag, min(whole, default=None), max(whole, default=None), len(whole)))
        return rows


def ranges(numbers):
    """[0, 1, 2, 5] -> '0-2, 5'"""
    parts = []
    for number in sorted(numbers):
        if parts and number == parts[-1][1] + 1:
            parts[-1][1] = number
        else:
            parts.append([number, number])
    return ", ".join(str(a) if a == b else f"{a}-{b}" for a, b in parts)


def _writer_of(path):
    """Another process that has a file open; None where none of ours has."""
    path = os.path.realpath(path)  # as the kernel tells what is open, whatever links the folder has
    for process in psutil.process_iter():
        with contextlib.suppress(psutil.Error):
            if process.pid != os.getpid() and any(open_file.path == path for open_file in process.open_files()):
                return process.pid
    return None


def _await(is_free, refusal):
    """Until nobody else needs a file any more, by what `is_free` says."""
    deadline = time.monotonic() + PATIENCE_S
    while not is_free():
        if time.monotonic() > deadline:
            raise RecordingError(refusal())
        time.sleep(LOOK_EVERY_S)


def _is_locked(descriptor):
    """Now, by us."""
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError as error:
        return error.errno != errno.EWOULDBLOCK  # not all file systems can
    return True


@contextlib.contextmanager
def _ours(path):
    """Whether a file is still there, once its recorder has closed it and nobody else is about to mend it, as the planner of
    another experiment in the same folder may be."""
    def refusal():
        pid = _writer_of(path)
        return f"{path} is still being written or reindexed, by {f'process {pid}' if pid else 'another user'}"
    _await(lambda: _writer_of(path) is None, refusal)
    try:
        # Some file systems lock only what may be written to.
        descriptor = os.open(path, os.O_RDWR if os.access(path, os.W_OK) else os.O_RDONLY)
    except FileNotFoundError:
        yield False
        return
    try:
        _await(lambda: _is_locked(descriptor), refusal)
        yield os.path.exists(path)
    finally:
        os.close(descriptor)


def _reindexed(active, bag):
    """What `rosbag reindex` does, on a copy: the original stays until the new one can be read to its end."""
    import rosbag  # pylint: disable=import-outside-toplevel
    draft = bag + ".part"
    try:
        shutil.copyfile(active, draft)
        with rosbag.Bag(draft, "a", allow_unindexed=True) as copy:
            for _ in copy.reindex():
                pass
        with rosbag.Bag(draft) as copy:
            for _ in copy.read_messages(raw=True):
                pass
        os.replace(draft, bag)
    finally:
        with contextlib.suppress(FileNotFoundError):
            os.remove(draft)
    os.remove(active)


def _mend(path, tell):
    try:
        with _ours(path) as is_there:
            if not is_there:
                return  # its recorder was only late, or another has mended it
            tell(f"{path} was left by a run that was killed: reindexing it")
            _reindexed(path, path[:-len(".active")])
    except RecordingError:
        raise
    except Exception as error:  # whatever a torn file makes of its reader
        tell(f"{path} cannot be reindexed ({error}): it is left as it is, and its poses are rendered again")


@contextlib.contextmanager
def _alone_in(folder):
    """As the evaluator locks a folder that it writes into: what is recorded beside it, by another user's recorder or in another
    container, is open where nobody here can see it."""
    descriptor = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
    try:
        _await(lambda: _is_locked(descriptor), lambda: f"another experiment is writing into {folder}: choose another output folder")
        yield
    finally:
        os.close(descriptor)


def mend(folder, tell):
    """Makes ordinary bags of those that a kill left behind as .bag.active. `tell`: is given a line about each."""
    left = sorted(entry.path for entry in os.scandir(folder) if entry.name.startswith(PREFIX) and entry.name.endswith(ACTIVE))
    if not left:
        return
    with _alone_in(folder):
        for path in left:
            _mend(path, tell)
