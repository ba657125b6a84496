"""What a machine does to an experiment but killing it: a disk that fills up, a clock that jumps, a cache that vanishes or turns
read-only, a second experiment that shares the cold cache. Each gives rows (what, result), and what is wrong begins with HOLE.
"""
import contextlib
import os
import shutil
import struct
import subprocess
import threading
import time

from trial import HERE, Trial, files_below, left_running

NO_SPACE = "No space left on device"
KILOBYTE = 1024
OFFSETS_S = (0, 7200, -7200, 86400, -3600)
LOOK_EVERY_S = 0.05


def mount(*words):
    """Whether it could be."""
    return subprocess.run(["mount", *words], stderr=subprocess.DEVNULL, check=False).returncode == 0


class SmallDisk:
    """A file system in memory, of so many bytes, at a folder, until the end of the block; `is_there` tells whether it may be."""

    def __init__(self, folder, size):
        self.folder = folder
        os.makedirs(folder)
        self.is_there = mount("-t", "tmpfs", "-o", "size=%d" % size, "tmpfs", folder)

    def grow(self):
        mount("-o", "remount,size=1g", self.folder)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.is_there:
            subprocess.run(["umount", "-l", self.folder], check=False)


def end(run):
    status = run.end()
    left = left_running(run)
    return status, run.said(), ["left running: " + command for command in left]


def fault_of(trial, reference, status, said, faults):
    """Of an experiment that has to have completed."""
    if status != 0:
        return "HOLE: status %d\n%s" % (status, said)
    faults = faults + ["not as undisturbed: " + name for name in trial.differs_from(reference)]
    faults += ["left in the cache: " + name for name in trial.leftovers()]
    return "HOLE: " + "; ".join(faults) if faults else ""


def completed(trial, reference, what):
    return fault_of(trial, reference, *end(trial.start())) or what


def full_output(folder, reference, share, size):
    """A disk that has room for a share of what an experiment writes."""
    with SmallDisk(os.path.join(folder, "disk"), int(share * size)) as disk:
        if not disk.is_there:
            return "not tried: a file system can be mounted by root alone"
        trial = Trial(folder, output=os.path.join(disk.folder, "output"))
        status, said, faults = end(trial.start())
        if status == 0:
            return fault_of(trial, reference, status, said, faults) or "had room enough"
        if faults:
            return "HOLE: " + "; ".join(faults)
        told = [line for line in said.splitlines() if NO_SPACE in line]
        if not any(disk.folder in line for line in told):
            return "HOLE: no file is named with the reason\n" + said
        if not any("make room" in line for line in told):
            return "HOLE: it is not said what to do: " + told[0]
        disk.grow()
        return completed(trial, reference, "named %s; after making room as undisturbed" % first_file(told, disk.folder))


def first_file(lines, folder):
    line = next(line for line in lines if folder in line)
    return line[line.index(folder) + len(folder) + 1:].split(":")[0].split(" ")[0]


def full_cache(folder, reference, size):
    """The cache alone has no room: it is done without."""
    with SmallDisk(os.path.join(folder, "disk"), size) as disk:
        if not disk.is_there:
            return "not tried: a file system can be mounted by root alone"
        trial = Trial(folder, cache=disk.folder)
        status, said, faults = end(trial.start())
        told = [line for line in said.splitlines() if disk.folder in line and "not kept" in line]
        return fault_of(trial, reference, status, said, faults) or (
            "as undisturbed; told: " + told[0][told[0].index(disk.folder):][:90] if told else "HOLE: nothing is said of it\n" + said)


def disk(folder, reference):
    """The disk of the output fills up, early and late."""
    size = sum(os.path.getsize(os.path.join(reference.output, name)) for name in files_below(reference.output))
    for percent in (3, 10, 20, 30, 40, 60, 80, 95):
        yield "output full at %d %%" % percent, full_output(fresh(folder), reference, percent / 100.0, size)


def fresh(folder):
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    return folder


def while_running(trial, disturb):
    """Runs it, and `disturb` again and again until it has ended."""
    run = trial.start()
    ended = threading.Event()

    def again_and_again():
        while not ended.wait(LOOK_EVERY_S):
            disturb()

    thread = threading.Thread(target=again_and_again)
    thread.start()
    try:
        return end(run)
    finally:
        ended.set()
        thread.join()


def vanishing(trial, wait_for):
    """A function that removes the cache folder once `wait_for` is true of it, and ever after."""
    began = []

    def disturb():
        if began or wait_for():
            began.append(True)
            shutil.rmtree(trial.cache, ignore_errors=True)
    return disturb


def cache(folder, reference):
    """Its disk is full; it vanishes as the bake begins, and later; or nobody may write to it any more."""
    for kilobytes in (16, 512, 1400):
        yield "cache full at %d kB" % kilobytes, full_cache(fresh(folder), reference, kilobytes * KILOBYTE)
    for what, moment in (("while baking", lambda trial: trial.cached(".lock")),
                         ("while rendering", lambda trial: trial.rows() > 20)):
        trial = Trial(fresh(folder))
        status, said, faults = while_running(trial, vanishing(trial, lambda t=trial, m=moment: m(t)))
        yield "cache vanishes " + what, fault_of(trial, reference, status, said, faults) or "as undisturbed"
    for what, moment in (("from the start", lambda trial: True), ("while baking", lambda trial: trial.cached(".lock")),
                         ("while rendering", lambda trial: trial.rows() > 20)):
        yield "cache read-only " + what, read_only(fresh(folder), reference, moment)


def read_only(folder, reference, moment):
    with SmallDisk(os.path.join(folder, "disk"), 1 << 30) as kept:
        if not kept.is_there:
            return "not tried: a file system can be mounted by root alone"
        trial = Trial(folder, cache=kept.folder)
        done = []

        def disturb():
            if not done and moment(trial) and mount("-o", "remount,ro", kept.folder):  # refused while a file is written
                done.append(True)
        if moment(trial):
            disturb()
        status, said, faults = while_running(trial, disturb)
        with contextlib.suppress(OSError):
            mount("-o", "remount,rw", kept.folder)
        # What nobody could remove stays, until somebody can.
        left = [name for name in trial.leftovers() if not name.endswith(".lock")]
        if left:
            faults = faults + ["left in the cache: " + name for name in left]
        trial.leftovers = lambda: []
        return fault_of(trial, reference, status, said, faults) or ("as undisturbed" if done else "never came to it")


def shared(folder, reference):
    """Two experiments at once, one cold cache."""
    fresh(folder)
    kept = os.path.join(folder, "cache")
    trials = [Trial(folder, cache=kept, output=os.path.join(folder, name)) for name in ("first", "second")]
    runs = [trial.start() for trial in trials]
    for trial, run in zip(trials, runs):
        yield "cold cache shared, " + os.path.basename(trial.output), fault_of(trial, reference, *end(run)) or "as undisturbed"
    yield "bakes in the end", "%d kept, %d files left over" % (len(trials[0].cached(".light")), len(trials[0].leftovers()))


def jumping_clock(folder):
    """The library that makes the time of day jump; None where no compiler is at hand."""
    library = os.path.join(folder, "jumping_clock.so")
    built = subprocess.run(["cc", "-O1", "-shared", "-fPIC", "-o", library, os.path.join(HERE, "jumping_clock.c")], check=False)
    return library if built.returncode == 0 else None


def clock(folder, reference):
    """The time of day jumps by up to a day, back and forth, twice a second, for every process."""
    trial = Trial(fresh(folder))
    library, offset = jumping_clock(folder), os.path.join(folder, "offset")
    if not library:
        yield "clock jumps", "not tried: there is no compiler"
        return
    jumps = [0, 0]

    def jump():
        if jumps[0] % 10 == 0:
            jumps[1] += 1
            with open(offset, "r+b" if os.path.exists(offset) else "wb") as file:  # the same file: it is mapped
                file.write(struct.pack("l", OFFSETS_S[jumps[1] % len(OFFSETS_S)]))
        jumps[0] += 1

    jump()
    trial.surroundings.update(LD_PRELOAD=library, JUMPING_CLOCK=offset)
    began = time.monotonic()
    status, said, faults = while_running(trial, jump)
    yield "clock jumps by up to a day", fault_of(trial, reference, status, said, faults) or \
        "as undisturbed, %d jumps in %.0f s" % (jumps[1], time.monotonic() - began)


ALL = {"disk": disk, "cache": cache, "shared": shared, "clock": clock}
