"""What RViz is given to show."""
import os
import subprocess
import tempfile

import yaml

SOURCE = os.path.normpath(os.path.join(os.path.dirname(os.path.realpath(__file__)), "..", "..", ".."))


def displays(config, kind, text):
    """Of one of our files, as the launch files start RViz with it; `kind`: hours or conditions, `text`: as typed."""
    with tempfile.TemporaryDirectory() as folder:
        rviz = os.path.join(folder, "rviz")
        with open(rviz, "w") as fake:
            fake.write("#!/bin/sh\ncat \"$2\"\n")
        os.chmod(rviz, 0o755)
        shown = subprocess.check_output(["/usr/bin/python3", os.path.join(SOURCE, "scripts", "conditions_rviz"),
                                         os.path.join(SOURCE, "rviz", config), kind, text],
                                        env=dict(os.environ, PATH=folder + ":" + os.environ["PATH"]))
    return yaml.safe_load(shown)["Visualization Manager"]["Displays"]


def topics(config, kind, text):
    """What those displays subscribe to."""
    found = set()
    for display in displays(config, kind, text):
        found |= {"/" + topic for key, topic in display.items() if key.endswith("Topic")}
        if display["Class"] == "rviz/DepthCloud":
            found.add("/" + os.path.dirname(display["Depth Map Topic"]) + "/camera_info")
    return found
