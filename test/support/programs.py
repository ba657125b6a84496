"""Where programs of packages lie."""

import functools

import roslib.packages


@functools.lru_cache(maxsize=None)
def located(program, package="sunlit"):
    """As rosrun finds it, but once: looking takes longer than many of these programs run."""
    found = roslib.packages.find_node(package, program)
    if not found:
        raise RuntimeError("no program %s in the package %s" % (program, package))
    return found[0]
