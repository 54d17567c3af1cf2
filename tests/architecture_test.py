#!/usr/bin/env python3
"""Checks who may include whom: cores know nothing of LCM, processes or clocks, and nothing points up the flow."""
import os
import re
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
PARTS = ("lcmtypes", "runtime", "drivers", "perception", "mapping", "planner", "tools")

# Each part and the project's folders that it may include; the first that fits a file's path holds.
ALLOWED = (
    ("runtime/geometry/", ("runtime/geometry/",)),
    ("runtime/process/", ("runtime/", "lcmtypes/", "floornav/")),
    ("lcmtypes/", ("lcmtypes/", "floornav/")),
    ("perception/node/", ("perception/", "runtime/", "lcmtypes/", "floornav/")),
    ("perception/", ("perception/", "runtime/geometry/")),
    ("mapping/node/", ("mapping/", "perception/", "runtime/", "lcmtypes/", "floornav/")),
    ("mapping/", ("mapping/", "perception/", "runtime/geometry/")),
    ("planner/node/", ("planner/", "mapping/", "perception/", "runtime/", "lcmtypes/", "floornav/")),
    ("planner/", ("planner/", "mapping/", "runtime/geometry/")),
    ("drivers/", ("drivers/", "runtime/", "lcmtypes/", "floornav/")),
    ("tools/", ("tools/", "drivers/", "planner/", "mapping/", "perception/", "runtime/", "lcmtypes/", "floornav/")),
)
CORE = re.compile(r"(runtime/geometry|perception|mapping|planner)/(?!node/)")
CORE_LIBRARIES = re.compile(r"Eigen/|nanoflann\.hpp$|hwy/|[a-z0-9_]+$")  # the last: the standard library
GEOMETRY_LIBRARIES = re.compile(r"Eigen/|[a-z0-9_]+$")
CORE_NEVER_INCLUDES = {"chrono", "ctime", "thread", "future", "iostream"}
CORE_NEVER_SAYS = re.compile(
    r"\b(steady_clock|system_clock|high_resolution_clock|gettimeofday|clock_gettime|random_device|jthread|"
    r"pthread_create|printf|fprintf|puts|cout|cerr|clog)\b|std::(thread|async|time)\b")


def without_comments(text):
    return re.sub(r"//[^\n]*|/\*.*?\*/", "", text, flags=re.DOTALL)


def faults_of(path, text):
    text = without_comments(text)
    faults = []
    is_core = CORE.match(path) is not None
    allowed = next(folders for part, folders in ALLOWED if path.startswith(part))
    for included in re.findall(r'^\s*#\s*include\s+"([^"]+)"', text, re.MULTILINE):
        if not included.startswith(allowed):
            faults.append(f'includes "{included}"')
        elif is_core and not CORE.match(included):
            faults.append(f'is a core and includes the shell "{included}"')
    if not is_core:
        return faults
    libraries = GEOMETRY_LIBRARIES if path.startswith("runtime/geometry/") else CORE_LIBRARIES
    for included in re.findall(r"^\s*#\s*include\s+<([^>]+)>", text, re.MULTILINE):
        if not libraries.match(included) or included in CORE_NEVER_INCLUDES:
            faults.append(f"is a core and includes <{included}>")
    faults += [f"is a core and says {m.group(0)}" for m in CORE_NEVER_SAYS.finditer(text)]
    return faults


def sources():
    for part in PARTS:
        for folder, _, names in os.walk(os.path.join(ROOT, part)):
            for name in sorted(names):
                if name.endswith((".hpp", ".cpp", ".h", ".c")):
                    yield os.path.relpath(os.path.join(folder, name), ROOT)


# What the check must find, and what it must let through.
REFUSED = (
    ("perception/a.cpp", '#include "runtime/process/node.hpp"'),
    ("perception/a.cpp", '#include "floornav/surfels_t.hpp"'),
    ("perception/a.cpp", '#include "perception/node/perception_node.hpp"'),
    ("perception/a.cpp", '#include "mapping/grid_map.hpp"'),
    ("perception/a.cpp", "#include <lcm/lcm-cpp.hpp>"),
    ("perception/a.cpp", "#include <yaml-cpp/yaml.h>"),
    ("perception/a.cpp", "#include <chrono>"),
    ("mapping/a.hpp", "auto now = std::chrono::steady_clock::now();"),
    ("planner/search/a.cpp", "std::thread worker;"),
    ("planner/search/a.cpp", 'std::printf("x");'),
    ("mapping/a.cpp", '#include "planner/planner.hpp"'),
    ("mapping/node/a.cpp", '#include "planner/node/planner_node.hpp"'),
    ("runtime/geometry/a.cpp", '#include "perception/evidence.hpp"'),
    ("runtime/geometry/a.cpp", "#include <nanoflann.hpp>"),
    ("runtime/process/a.cpp", '#include "mapping/grid_map.hpp"'),
    ("drivers/kinect/a.cpp", '#include "perception/evidence.hpp"'),
    ("planner/node/a.cpp", '#include "tools/pictures/canvas.hpp"'),
    ("tools/a.cpp", '#include "tests/real_data.hpp"'),
)
TAKEN = (
    ("mapping/a.cpp", '#include "perception/evidence.hpp"\n#include <Eigen/Core>\n#include <cmath>'),
    ("planner/node/a.cpp", '#include "mapping/node/grid_map_message.hpp"\n#include <lcm/lcm.h>\n#include <chrono>'),
    ("perception/a.cpp", "// no steady_clock here, and no printf\n/* std::thread */"),
)


def main():
    for path, text in REFUSED:
        if not faults_of(path, text):
            sys.exit(f"the check is blind: {path} may say {text}")
    for path, text in TAKEN:
        if faults_of(path, text):
            sys.exit(f"the check is too strict: {path}: {faults_of(path, text)}")
    count = dict.fromkeys(PARTS, 0)
    failed = False
    for path in sources():
        count[path.split("/")[0]] += 1
        with open(os.path.join(ROOT, path), encoding="utf-8") as file:
            for fault in faults_of(path, file.read()):
                print(f"{path} {fault}")
                failed = True
    for part in ("lcmtypes", "runtime", "perception", "mapping", "planner"):
        if count[part] == 0:
            sys.exit(f"{part}/: no source found")
    sys.exit(1 if failed else 0)


main()
