"""The roslaunch process of an experiment, seen from outside: what it started, and how to end all of it.

roslaunch has no way to hand on the failure of a node: it ends with status 0 whatever became of them. So at a failure all its
nodes are ended in order, and then roslaunch itself by SIGUSR1, which a shell sees as status 138.
"""

import contextlib
import http.client
import os
import signal
import sys
import time
import xml.parsers.expat
import xmlrpc.client

import psutil

from sunlit_experiment import display

NO_ANSWER = (OSError, http.client.HTTPException, xml.parsers.expat.ExpatError)  # the last: it ended in mid-answer
GRACE_S = 20.0  # a process that has not ended so long after SIGINT is killed
BEGIN_S = 60.0  # roslaunch has started its nodes well within it
LOOKS, LOOK_AGAIN_S = 100, 0.01  # at a parent: one that may not be looked at is none of our business
GONE = 0  # instead of the process id of a roslaunch that went before anybody looked


class Failure(Exception):
    """Why the experiment cannot be finished."""


def is_alive(process):
    """Neither ended nor only waiting for its parent to notice."""
    try:
        return process.is_running() and process.status() not in (psutil.STATUS_ZOMBIE, psutil.STATUS_DEAD)
    except psutil.Error:
        return False


def leads_its_group(process):
    """As roslaunch has it for each child, so that a whole group can be ended."""
    with contextlib.suppress(ProcessLookupError):
        return os.getpgid(process.pid) == process.pid
    return False


def words_of(process):
    try:
        return process.cmdline()
    except psutil.Error:  # it ended while we looked
        return []


def is_roslaunch(process):
    return any(os.path.basename(word) in ("roslaunch", "roscore") for word in words_of(process))


def launch_of_parent(log_folder):
    """What started us. Of a parent that ends while we look nobody can tell any more what it was: we are inherited next."""
    for _ in range(LOOKS):
        launch = Launch(pid_of_parent(log_folder), log_folder)
        is_ending = launch.process is None or not words_of(launch.process)
        if launch.pid == GONE or (launch.pid == os.getppid() and not is_ending):
            break
        time.sleep(LOOK_AGAIN_S)
    return launch


def pid_of_parent(log_folder):
    """Of who started us; GONE where that was a roslaunch, since we log where its nodes do, and somebody inherited us."""
    pid = os.getppid()
    with contextlib.suppress(psutil.Error, OSError):
        inherited = pid <= 1 or os.getsid(pid) != os.getsid(0)  # roslaunch's nodes are of its session
        ancestors = psutil.Process().parents()
        by_rostest = any("rostest" in os.path.basename(word) for word in words_of(ancestors[0])) if ancestors else False
        if log_folder and inherited and not by_rostest and not any(is_roslaunch(ancestor) for ancestor in ancestors):
            return GONE
    return pid


class Launch:
    """The roslaunch process `pid`, and what it started but for ourselves."""

    def __init__(self, pid, log_folder):
        """`pid`: of a parent, or GONE. `log_folder`: where its nodes log, of which roslaunch has one a master."""
        self.pid = pid
        self.log_folder = log_folder
        self.process, self.began = None, time.time() - BEGIN_S
        if pid != GONE:
            with contextlib.suppress(psutil.Error):
                self.process = psutil.Process(pid)
                self.began = self.process.create_time()
        self.server = None
        self.children = set()
        # Whoever else it is, its children are none of our business. Process 1 inherits those of others.
        self.may_end_children = pid == GONE or (pid > 1 and self.is_roslaunch())
        self.look()

    def look(self):
        """Remembers who was started by now: once roslaunch has gone, nobody can tell any more."""
        self._living_children()

    def is_gone(self):
        return self.process is None or not is_alive(self.process)

    def is_roslaunch(self):
        """Not so under rostest, which judges by itself how its nodes ended."""
        return self.process is not None and is_roslaunch(self.process)

    def nodes(self, uris):
        """Names of living and of dead nodes, without a leading slash. `uris`: of all the roslaunch servers that are known."""
        self.server = self.server or self._find_server(uris)
        self.look()
        try:
            processes = self.server.list_processes()[2]
        except NO_ANSWER:
            raise Failure("roslaunch has gone") from None
        alive, dead = ({name.rsplit("-", 1)[0] for name, _ in names} for names in processes)
        return alive, dead

    def _find_server(self, uris):
        for uri in uris:
            server = xmlrpc.client.ServerProxy(uri)
            try:
                if server.get_pid()[2] == self.pid:
                    return server
            except NO_ANSWER:
                pass  # an earlier roslaunch that has gone
        # One that is being killed closes its sockets before it counts as gone.
        if self.may_end_children or self.is_gone():
            raise Failure("roslaunch has gone")
        raise Failure("this node was not started by roslaunch; what else was started may still run")

    def _living_children(self):
        """(process, whether it is the master) of all but us. Remembered, since they change parents when roslaunch goes."""
        if not self.may_end_children:
            return []
        if self.is_gone():
            self.children |= set(self._orphans())
        else:
            with contextlib.suppress(psutil.Error):
                self.children |= {child for child in self.process.children() if leads_its_group(child)}
        return [(child, any("rosmaster" in word for word in words_of(child))) for child in self.children
                if child.pid != os.getpid() and is_alive(child)]

    def _orphans(self):
        """Nodes that roslaunch started as it went, which nobody saw as its children. Those of another roslaunch on the same
        master log to the same folder; their parent lives, or they are older."""
        mark = f"__log:={self.log_folder}{os.sep}"
        for process in psutil.process_iter():
            if any(word.startswith(mark) for word in words_of(process)) and leads_its_group(process):
                with contextlib.suppress(psutil.Error):
                    parent = process.parent()
                    is_of_another = parent is not None and is_roslaunch(parent)
                    if not is_of_another and process.create_time() >= self.began:
                        yield process

    def _end_children(self, masters):
        """SIGINT, and SIGKILL for those that do not listen."""
        for number in (signal.SIGINT, signal.SIGKILL):
            for child, is_master in self._living_children():
                if is_master == masters:
                    with contextlib.suppress(ProcessLookupError):  # it ended just now
                        os.killpg(child.pid, number)
            deadline = time.monotonic() + GRACE_S
            while any(is_master == masters for _, is_master in self._living_children()):
                if time.monotonic() > deadline:
                    break
                time.sleep(0.05)
            else:
                return

    def _send(self, number):
        """To roslaunch, if it still is."""
        if not self.is_gone():
            with contextlib.suppress(ProcessLookupError):  # it ended just now
                os.kill(self.pid, number)

    def break_off(self, reason):
        """Ends all nodes, then the master, then roslaunch with a status that is not 0. The reason is the last line but
        for what a shell says. Does not come back where there is a roslaunch to end."""
        said = f"experiment: FAILED: {reason}"
        if not self.may_end_children:
            display.say(said, sys.stderr)
            return
        self._send(signal.SIGSTOP)  # or it would end by itself, with status 0, once its nodes have
        self._end_children(masters=False)
        self._end_children(masters=True)
        display.say(said, sys.stderr)
        self._send(signal.SIGUSR1)
        self._send(signal.SIGCONT)
        os._exit(1)  # at once: there is no master any more to say goodbye to

    def finish(self):
        """Lets roslaunch end everything, as at Ctrl-C, which gives status 0."""
        if self.is_gone():
            raise Failure("roslaunch has gone")
        if self.is_roslaunch():
            self._send(signal.SIGINT)
