#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What each number of the single-view method (src/tuning) moves.

usage: sensitivity.py BUILD SET... [--only NAME] [--factors 0.5,2] [--output TABLE.md]

A copy of the sources is made in BUILD in which each number is read through a function that
scales it by what the environment says; it is built once, and then each number is scaled by
one half and by two over all sets. A set is a name, "=" and a command of the shell with {bin}
for the folder of the programs, whose last line of output ends in the figure of the set:

  scenes="{bin}/single_view_evaluation scenes | awk '/^~all/ { print $3 }'"

Prints for each number by how much it moves the figure of each set, the largest first.
Numbers that move no figure by more than .001 share a line at the end.
"""
import argparse
import os
import pathlib
import re
import shutil
import subprocess
import sys

LEAST = 0.001
# arrays have these sizes: they stay constants of the compiler
SIZES = {"observe_bare::NEIGHBOUR", "observe_points::REACH", "observe_surroundings::OCCLUDER_REACH"}
LINE = re.compile(r"(?:namespace (\w+) \{|inline constexpr (\S+) (\w+) = ([^;]+);)")
READER = """#include <cstdlib>
#include <cstring>
inline double pclSqScale(const char* name) {
  const char* told = std::getenv("PCL_SQ_TUNE");
  const char* factor = told ? std::strchr(told, '*') : nullptr;
  const bool mine = factor && std::strlen(name) == std::size_t(factor - told) &&
                    std::strncmp(name, told, std::size_t(factor - told)) == 0;
  return mine ? std::atof(factor + 1) : 1.0;
}
template <typename T>
T pclSqTuned(const char* name, T value) {
  const double scaled = pclSqScale(name) * double(value);
  return T(T(0.5) == T(0) ? (scaled < 1.0 && value >= 1 ? 1.0 : scaled + 0.5) : scaled);
}
"""


def instrument(source):
    """Rewrites the numbers of a copy of the sources. Returns their names."""
    names = []
    for path in sorted((source / "src/tuning").iterdir()):
        group = ""

        def scaled(match):
            nonlocal group
            if match.group(1):
                group = match.group(1)
                return match.group(0)
            kind, name, value = match.group(2, 3, 4)
            if f"{group}::{name}" in SIZES:
                return match.group(0)
            names.append(f"{group}::{name}")
            return f'inline const {kind} {name} = pclSqTuned<{kind}>("{names[-1]}", {value});'

        text = LINE.sub(scaled, path.read_text())
        path.write_text(text.replace("#pragma once", '#pragma once\n#include "reader.h"', 1))
    (source / "src/reader.h").write_text("#pragma once\n" + READER)
    # what is made of a number is no constant of the compiler any more
    for path in (source / "src").rglob("*.cpp"):
        text = path.read_text()
        changed = re.sub(r"constexpr (double [A-Z_]+ =[^;]*\b[A-Z][A-Z_]+\b|"
                         r"int [A-Z_]+ =[^;]*tuning::)", r"const \1", text) \
            if "tuning::" in text else text
        if changed != text:
            path.write_text(changed)
    return names


def measure(commands, tune=None):
    """The figure of each set, or None where a command fails."""
    environment = dict(os.environ)
    environment.pop("PCL_SQ_TUNE", None)
    if tune:
        environment["PCL_SQ_TUNE"] = tune
    figures = []
    for command in commands:
        run = subprocess.run(command, shell=True, env=environment, text=True,
                             stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        numbers = re.findall(r"-?[0-9.]+", (run.stdout.strip().splitlines() or [""])[-1])
        figures.append(float(numbers[-1]) if run.returncode == 0 and numbers else None)
    return figures


def table(rows, sets, factors):
    """Markdown: a line for each number that moves something, and one for the rest."""
    head = [f"{s} x {f}" for f in factors for s in sets]
    lines = ["| number | " + " | ".join(head) + " |", "|---" * (1 + len(head)) + "|"]
    still = []
    for most, name, moved in sorted(rows, reverse=True):
        if most <= LEAST:
            still.append(f"`{name}`")
            continue
        cells = ["fails" if m is None else f"{m:+.3f}" for m in moved]
        lines.append(f"| `{name}` | " + " | ".join(cells) + " |")
    return "\n".join(lines) + f"\n\nAt most {LEAST}: " + ", ".join(sorted(still)) + ".\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build")
    parser.add_argument("sets", nargs="+")
    parser.add_argument("--only", default="")
    parser.add_argument("--factors", default="0.5,2")
    parser.add_argument("--output")
    options = parser.parse_args()
    root = pathlib.Path(__file__).resolve().parent.parent
    build = pathlib.Path(options.build).resolve()
    source = build / "source"
    shutil.rmtree(source, ignore_errors=True)
    shutil.copytree(root, source, ignore=shutil.ignore_patterns("build*", ".git", "demo"))
    names = [n for n in instrument(source) if options.only in n]
    subprocess.run(["cmake", "-S", source, "-B", build / "build", "-G", "Ninja",
                    "-DCMAKE_BUILD_TYPE=Release", "-DPCL_SQ_BUILD_BENCHMARKS=ON",
                    "-DPCL_SQ_BUILD_TESTS=OFF"], check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", build / "build", "--target", "pcl_sq_fit",
                    "single_view_evaluation"], check=True, stdout=subprocess.DEVNULL)
    sets, commands = zip(*(s.split("=", 1) for s in options.sets))
    commands = [c.replace("{bin}", str(build / "build/bin")) for c in commands]
    before = measure(commands)
    if None in before:
        sys.exit(f"sensitivity.py: no figure of {sets[before.index(None)]}; is its command right?")
    print("unscaled:", dict(zip(sets, before)), file=sys.stderr, flush=True)
    factors = options.factors.split(",")
    rows = []
    for done, name in enumerate(names):
        moved = [None if a is None else a - b for f in factors
                 for a, b in zip(measure(commands, f"{name}*{f}"), before)]
        rows.append((max(1.0 if m is None else abs(m) for m in moved), name, moved))
        end = "" if sys.stderr.isatty() else f" {name} {moved}\n"
        print(f"\r{done + 1} of {len(names)}", end=end, file=sys.stderr, flush=True)
    text = table(rows, sets, factors)
    if options.output:
        pathlib.Path(options.output).write_text(text)
    print(text)


if __name__ == "__main__":
    main()
