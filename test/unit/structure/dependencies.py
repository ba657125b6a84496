#!/usr/bin/env python3
"""What the package needs is said alike to CMake, to rosdep and to scripts/install_dependencies, for Debian 12."""
import ast
import pathlib
import re
import sys
import unittest
import xml.etree.ElementTree

import rosunit
import yaml

SOURCE = pathlib.Path(__file__).resolve().parents[3]

# What CMake looks for and its key of package.xml. Other names, such as those of catkin's components, are keys.
KEYS = {"Eigen3": "eigen", "TBB": "tbb", "OpenCV": "libopencv-dev", "embree3": "embree", "sdformat12": "sdformat", "sdformat9": "sdformat",
        "urdfdom_model": "liburdfdom-dev", "erfa": "liberfa-dev", "erfa.h": "liberfa-dev",
        "console_bridge": "libconsole-bridge-dev", "program_options": "libboost-program-options-dev",
        "xxhash": "libxxhash-dev", "xxhash.h": "libxxhash-dev", "nlohmann_json": "nlohmann-json-dev", "OSMesa": "libosmesa6-dev",
        "GL/osmesa.h": "libosmesa6-dev", "assimp/scene.h": "assimp", "meshoptimizer": "libmeshoptimizer-dev", "JPEG": "libjpeg",
        "draco": "libdraco-dev", "draco/compression/decode.h": "libdraco-dev",
        "urdf_model/model.h": "liburdfdom-dev", "urdf_parser/urdf_parser.h": "liburdfdom-dev", "EGL": "libegl-dev", "EGL/egl.h": "libegl-dev", "GL": "libgl-dev"}
# What Python imports, likewise.
KEYS_OF_MODULES = {"PIL": "python3-pil", "cv2": "python3-opencv", "jinja2": "python3-jinja2",
                   "matplotlib": "python3-matplotlib", "numpy": "python3-numpy", "psutil": "python3-psutil",
                   "rospkg": "python3-rospkg", "yaml": "python3-yaml"}
OF_COMPILER = {"Threads"}
OURS = {"sunlit"}  # which the example of a package beside it looks for
OPTIONAL = {"benchmark"}  # absent: no benchmarks


def keys():
    root = xml.etree.ElementTree.parse(SOURCE / "package.xml").getroot()
    return [element.text for element in root if element.tag.endswith("depend")]


def public_keys():
    """Of test/golden: key -> Debian packages."""
    return yaml.safe_load((SOURCE / "test/golden/rosdep_keys.yaml").read_text())


def own_keys():
    """Of doc/rosdep.yaml, likewise."""
    rules = yaml.safe_load((SOURCE / "doc/rosdep.yaml").read_text())
    return {key: rule["debian"]["bookworm"] for key, rule in rules.items()}


def installed_packages():
    script = (SOURCE / "scripts/install_dependencies").read_text()
    names = re.findall(r"^(?:packages|ros_of_debian)=\(\n(.*?)^\)", script, re.MULTILINE | re.DOTALL)
    return set(re.sub(r"#.*", "", " ".join(names)).split())


def cmake_files():
    yield SOURCE / "CMakeLists.txt"
    for folder in ("src", "bench", "test", "cmake"):
        for pattern in ("CMakeLists.txt", "*.cmake"):
            yield from (SOURCE / folder).rglob(pattern)


def looked_for(text):
    """Names of what the text of a CMake file asks for."""
    text = re.sub(r"#.*", "", text)
    for function, arguments in re.findall(r"\b(find_package|find_library|find_path|pkg_check_modules)\s*\(([^)]*)\)", text):
        words = arguments.split()
        if function == "find_package":
            components = words[words.index("COMPONENTS") + 1:] if words[0] in ("catkin", "Boost") else []
            yield from [name for name in components if not name.startswith("$")] or words[:1]
            if words[0] == "catkin":
                yield "catkin"
        else:
            yield next(word for word in words[1:] if word not in ("NAMES", "REQUIRED", "QUIET"))


def python_files(folder):
    for file in sorted((SOURCE / folder).rglob("*")):
        if file.is_file() and (file.suffix == ".py" or file.read_bytes().startswith(b"#!/usr/bin/env python3")):
            yield file


def imported(text):
    """First names of the modules that a Python file imports, anywhere in it."""
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Import):
            yield from (alias.name.split(".")[0] for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.level == 0:
            yield node.module.split(".")[0]


class Dependencies(unittest.TestCase):
    def test_each_key_has_a_rule_and_only_one(self):
        self.assertGreater(len(keys()), 30)
        public, own = public_keys(), own_keys()
        odd = [key for key in keys() if (key in public) == (key in own)]
        self.assertEqual(odd, [], "each key of package.xml must be in doc/rosdep.yaml, or be known to the public lists for "
                                  "Debian 12 and named in test/golden/rosdep_keys.yaml; not both")

    def test_no_key_is_asked_for_twice(self):
        root = xml.etree.ElementTree.parse(SOURCE / "package.xml").getroot()
        asked = [(element.tag, element.text) for element in root if element.tag.endswith("depend")]
        self.assertEqual(sorted(asked), sorted(set(asked)))

    def test_doc_rosdep_gives_no_rule_that_nobody_needs(self):
        self.assertEqual(sorted(set(own_keys()) - set(keys())), [])

    def test_packages_of_all_keys_are_installed_by_the_script(self):
        rules = {**public_keys(), **own_keys()}
        wanted = {package for key in keys() for package in rules[key]}
        self.assertEqual(sorted(wanted - installed_packages()), [])

    def test_package_xml_names_all_that_cmake_looks_for(self):
        asked = set(keys())
        found = {}
        for file in cmake_files():
            for name in set(looked_for(file.read_text())) - OF_COMPILER - OURS - OPTIONAL:
                found[KEYS.get(name, name)] = str(file.relative_to(SOURCE))
        self.assertEqual({key: file for key, file in found.items() if key not in asked}, {})
        self.assertGreaterEqual(set(found), {"roscpp", "eigen", "liberfa-dev", "catkin", "rostest"})

    @unittest.skipIf(sys.version_info < (3, 10), "Python does not know which modules are its own before 3.10")
    def test_package_xml_names_all_that_python_imports(self):
        asked = set(keys())
        own = {"sunlit"} | {path.stem for folder in ("scripts", "test") for path in (SOURCE / folder).rglob("*")}
        found = {}
        for folder in ("scripts", "test"):
            for file in python_files(folder):
                for name in set(imported(file.read_text())) - own - set(sys.stdlib_module_names):
                    found[KEYS_OF_MODULES.get(name, name)] = str(file.relative_to(SOURCE))
        self.assertEqual({key: file for key, file in found.items() if key not in asked}, {})
        self.assertGreaterEqual(set(found), {"rospy", "python3-numpy", "rosunit"})

    def test_reads_what_cmake_looks_for(self):
        text = """find_package(catkin REQUIRED COMPONENTS roscpp
          tf2)  # find_package(Comment)
        find_package(Boost 1.71 REQUIRED COMPONENTS program_options)
        find_package(embree 3 REQUIRED) find_library(A_LIBRARY NAMES a REQUIRED)"""
        self.assertEqual(list(looked_for(text)), ["roscpp", "tf2", "catkin", "program_options", "embree", "a"])


if __name__ == "__main__":
    rosunit.unitrun("sunlit", "dependencies", Dependencies, sysargs=sys.argv)
