#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What each number of the single-view method moves.

usage: sensitivity.py BUILD SET... [--only NAME] [--factors 0.5,2] [--output TABLE.md]

A copy of the sources is made in BUILD in which every named number of the folders below is
read through a function that scales it by what the environment says; it is built once, and
then each number is scaled by one half and by two over all sets. A set is the arguments of
single_view_evaluation, as one word: "--no-mask scenes". Prints, for each number, the largest
change of the mean IoU and of the share of exact counts over the sets, the largest first.
"""
import argparse
import os
import pathlib
import re
import shutil
import subprocess
import sys

FOLDERS = ["observe", "sensor", "table", "view_fit", "parts"]
TYPES = r"(double|float|int|std::size_t|Eigen::Index)"
DECLARATION = re.compile(r"^(inline )?constexpr " + TYPES + r" ([A-Z][A-Z_0-9]*\s*=[^;]*);", re.M)
HEADER = """#pragma once
#include <cstdlib>
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
    (source / "src/tuned_numbers.h").write_text(HEADER)
    for folder in FOLDERS:
        for path in sorted((source / "src" / folder).iterdir()):
            text = path.read_text()
            fixed = set()  # sizes of arrays stay constants
            for used in re.findall(r"(?:array<[^;>]*,|\[|Matrix<[^;>]*,) *([A-Z][A-Z_0-9]+)", text):
                fixed.add(used)

            def scaled(match):
                kind, rest = match.group(2), match.group(3)
                parts = [p.split("=", 1) for p in rest.split(",")] if "(" not in rest else \
                    [rest.split("=", 1)]
                own = [n.strip() for n, _ in parts]
                derived = re.search(r"=[^;]*\b[A-Z][A-Z_]{2,}", rest)
                if derived or any(n in fixed for n in own) or any(
                        re.search(r"\b" + n + r"\b", text[match.end():]) and
                        re.search(r"constexpr [^;=]*=[^;]*\b" + n + r"\b", text) for n in own):
                    return match.group(0)
                declared = []
                for (name, value), n in zip(parts, own):
                    key = f"{path.stem}.{n}"
                    names.append(key)
                    declared.append(f'{n} = pclSqTuned<{kind}>("{key}", {value.strip()})')
                return f"{match.group(1) or ''}const {kind} " + ", ".join(declared) + ";"

            changed = DECLARATION.sub(scaled, text)
            if changed != text:
                at = changed.index("#include") if "#include" in changed else 0
                changed = changed[:at] + '#include "tuned_numbers.h"\n' + changed[at:]
                path.write_text(changed)
    return names


def measure(program, sets, tune=None):
    """Mean IoU and share of exact counts of each set."""
    environment = dict(os.environ)
    environment.pop("PCL_SQ_TUNE", None)
    if tune:
        environment["PCL_SQ_TUNE"] = tune
    figures = []
    for arguments in sets:
        run = subprocess.run([program] + arguments.split(), env=environment, text=True,
                             capture_output=True, timeout=600)
        row = [line for line in run.stdout.splitlines() if line.startswith("~all")]
        if not row:
            return None
        fields = row[0].split()
        figures.append((float(fields[2]), float(fields[7].rstrip("%"))))
    return figures


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
    subprocess.run(["cmake", "--build", build / "build", "--target",
                    "single_view_evaluation"], check=True, stdout=subprocess.DEVNULL)
    program = str(build / "build/bin/single_view_evaluation")
    before = measure(program, options.sets)
    if not before:
        sys.exit("sensitivity.py: single_view_evaluation printed no table; are the sets right?")
    rows = []
    for done, name in enumerate(names):
        moved = []
        for factor in options.factors.split(","):
            after = measure(program, options.sets, f"{name}*{factor}")
            if not after:
                moved.append((1.0, 100.0))
                continue
            iou = max((a[0] - b[0] for a, b in zip(after, before)), key=abs)
            exact = max((a[1] - b[1] for a, b in zip(after, before)), key=abs)
            moved.append((iou, exact))
        rows.append((max(abs(m[0]) for m in moved), name, moved))
        if sys.stderr.isatty():
            print(f"\r{done + 1} of {len(names)}", end="", file=sys.stderr)
        else:
            print(name, moved, file=sys.stderr, flush=True)
    rows.sort(reverse=True)
    factors = options.factors.split(",")
    lines = ["| number | " + " | ".join(f"x {f}: IoU, exact" for f in factors) + " |",
             "|---" * (1 + len(factors)) + "|"]
    for _, name, moved in rows:
        lines.append(f"| `{name}` | " +
                     " | ".join(f"{iou:+.4f}, {exact:+.0f} %" for iou, exact in moved) + " |")
    text = "\n".join(lines) + "\n"
    if options.output:
        pathlib.Path(options.output).write_text(text)
    print(text)


if __name__ == "__main__":
    main()
