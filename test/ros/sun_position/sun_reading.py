"""What the tests of the sun_position node share: waiting for a message that fits, and calling by hand."""
import subprocess
import threading

import rospy
import yaml

TIMEOUT_S = 60.0  # how long a machine under load may take for what should be moments


class Latest:
    """The newest message of a topic, and waiting for one that fits."""

    def __init__(self, topic, kind, also=None):
        """`also` is called with every message, before anybody who waits sees it."""
        self.topic = topic
        self.also = also
        self.message = None
        self.count = 0
        self.changed = threading.Condition()
        self.subscriber = rospy.Subscriber(topic, kind, self.on_message)

    def on_message(self, message):
        with self.changed:
            if self.also:
                self.also(message)
            self.message = message
            self.count += 1
            self.changed.notify_all()

    def wait(self, fits=lambda message: True, nudge=None):
        """The first message from now on, or the last one, that fits. `nudge` is called every 0.1 s meanwhile."""
        with self.changed:
            for _ in range(int(TIMEOUT_S / 0.1)):
                if self.message is not None and fits(self.message):
                    return self.message
                if nudge:
                    nudge()
                self.changed.wait(0.1)
            raise AssertionError("no message on %s fits; the last was\n%s" % (self.topic, self.message))

    def next(self):
        """A message that arrives after this call."""
        count = self.count
        return self.wait(lambda message: self.count > count)


def by_hand(service, request):
    """What a person types: `rosservice call`. The answer as a dictionary."""
    done = subprocess.run(["rosservice", "call", service, request], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          universal_newlines=True, timeout=TIMEOUT_S)
    assert done.returncode == 0, done.stderr
    return yaml.safe_load(done.stdout)
