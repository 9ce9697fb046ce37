#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What a call from Python costs by itself: arguments and results with next to no work.

usage: PYTHONPATH=build/python python_calls.py

Prints microseconds a call, the best of seven rounds. The import is timed in processes of their
own, and what it loads is counted.
"""
import subprocess
import sys
import timeit

import numpy as np

import pcl_sq

body = pcl_sq.Superquadric([0.04, 0.04, 0.05], epsilon=(0.2, 1.0))
union = pcl_sq.MultiSuperquadric([body, body])
model = pcl_sq.Model.from_parts([body, body])
point, ten = np.zeros(3), np.random.default_rng(0).random((10, 3))


def refused(call, *arguments):
    """A call that ends at once because its points allow no result."""
    def run():
        try:
            call(*arguments)
        except pcl_sq.Error:
            return
        raise AssertionError("it was not refused")
    return run


CALLS = {
    "body.center": lambda: body.center,
    "body.sides": lambda: body.sides,
    "body.bounds": lambda: body.bounds,
    "Superquadric(...)": lambda: pcl_sq.Superquadric([0.04, 0.04, 0.05], epsilon=(0.2, 1.0)),
    "body.contains(point)": lambda: body.contains(point),
    "body.contains(10 points)": lambda: body.contains(ten),
    "body.contains(10 float32)": lambda: body.contains(ten.astype(np.float32)),
    "body.distance(point, method='fast')": lambda: body.distance(point, method="fast"),
    "body.normal(point)": lambda: body.normal(point),
    "union.contains(point)": lambda: union.contains(point),
    "union[0]": lambda: union[0],
    "model.contains(point)": lambda: model.contains(point),
    "model.confidence": lambda: model.confidence,
    "model.to_json()": model.to_json,
    "fit_superquadric(1 point), refused": refused(pcl_sq.fit_superquadric, point[None]),
    "estimate(1 point), refused": refused(pcl_sq.estimate, point[None]),
}


def main():
    for name, call in CALLS.items():
        rounds = timeit.repeat(call, number=1000, repeat=7)
        print("%-38s %6.2f us" % (name, 1e3 * min(rounds)))
    loaded = "import sys, pcl_sq; print(sum('vtk' in l or 'opencv' in l " \
        "for l in open('/proc/self/maps')))"
    count = subprocess.run([sys.executable, "-c", loaded], capture_output=True, text=True,
                           check=True).stdout.strip()
    seconds = [min(timeit.repeat(lambda: subprocess.run([sys.executable, "-c", "import " + name],
                                                        check=True), number=1, repeat=7))
               for name in ("numpy", "pcl_sq")]
    print("import pcl_sq: %.0f ms after numpy; maps VTK or OpenCV: %s" % (
        1e3 * (seconds[1] - seconds[0]), count))


if __name__ == "__main__":
    main()
