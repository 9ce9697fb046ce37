#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Thousands of clouds on several workers: what is killed, and what it costs.

usage: cluster.py kills BIN CLOUD... [--clouds 5000] [--kills 5] [--seed 0] [--keep DIR]
                  [-- OPTION...]
       cluster.py speed BIN CLOUD... [--clouds 600] [--workers 1,2,4] [--rounds 3]
                  [-- OPTION...]

BIN holds pcl_sq_fit, which gets the OPTIONs; PYTHONPATH the module. Each CLOUD is one object; the clouds that are
fitted are random thousands of its points, turned about the camera's axis; one in 500 is no
cloud at all.

kills: a Dask scheduler, two workers and python3 -m pcl_sq.batch as processes of their own.
So many times, at random moments, one of each kind is ended by SIGKILL, in random order, and
begun anew as a queue of jobs would. Then every cloud must be there exactly once, with what one
process of pcl_sq_fit makes of it. The same for pcl_sq_fit --shard I/2 --resume.
speed: clouds a second of N processes of pcl_sq_fit --shard I/N, and of pcl_sq.batch --local N
beside them, in turns; the seconds of processor for a cloud tell the same on a busy machine.

Exit code 1 where a cloud lacks, stands twice, or differs.
"""
import argparse
import json
import os
import pathlib
import random
import resource
import signal
import socket
import subprocess
import sys
import tempfile
import time

import numpy as np

import pcl_sq

PYTHON = sys.executable
POINTS = 1000


def make_clouds(folder, sources, count, seed):
    """Writes the clouds; returns their names."""
    chance = np.random.default_rng(seed)
    objects = [pcl_sq.read_cloud(s).points.reshape(-1, 3) for s in sources]
    names = []
    for i in range(count):
        name = folder / ("%05d.pcd" % i)
        names.append(str(name))
        if i % 500 == 250:
            name.write_text("no cloud\n")
            continue
        points = objects[i % len(objects)]
        points = points[np.isfinite(points).all(axis=1)]
        points = points[chance.permutation(len(points))[:POINTS]]
        a = chance.uniform(0, 2 * np.pi)
        turn = [[np.cos(a), -np.sin(a), 0], [np.sin(a), np.cos(a), 0], [0, 0, 1]]
        points = (points @ np.array(turn).T).astype("<f4")
        name.write_bytes(("VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n"
                          "WIDTH %d\nHEIGHT 1\nPOINTS %d\nDATA binary\n" % (
                              len(points), len(points))).encode() + points.tobytes())
    (folder / "manifest.txt").write_text("\n".join(names) + "\n")
    return names


def fit_command(arguments, manifest, share, out):
    return [arguments.bin + "/pcl_sq_fit", "--manifest", manifest, "--jsonl", "--shard", share,
            "--resume", "--threads", "1", "-q", "-o", out] + arguments.words


def batch_command(arguments, manifest, out, *more):
    return [PYTHON, "-m", "pcl_sq.batch", manifest, "--out", out, "-q",
            "--shard-size", str(max(1, arguments.clouds // 100))] + list(more) + [
                "--"] + arguments.words


def quiet(command, session=True):
    """A process that says nothing, of its own group if it is to be killed."""
    return subprocess.Popen([str(c) for c in command], stdout=subprocess.DEVNULL,
                            stderr=subprocess.DEVNULL, start_new_session=session)


def end(process):
    """SIGKILL for a process and all that it has begun."""
    try:
        os.killpg(process.pid, signal.SIGKILL)
    except ProcessLookupError:
        pass
    process.wait()


def records_of(paths):
    records = []
    for path in paths:
        with open(path) as file:
            records += [json.loads(line) for line in file]
    return records


def compare(found, expected, names):
    """What is wrong with the lines, sentences. Times differ, nothing else may."""
    wrong = []
    seen = [r["input"]["path"] for r in found]
    if sorted(seen) != sorted(names):
        wrong.append("%d lines for %d clouds, %d of them lack" % (
            len(seen), len(names), len(set(names) - set(seen))))
    by_name = {r["input"]["path"]: r for r in expected}
    differ = 0
    for record in found:
        other = by_name.get(record["input"]["path"], {})
        differ += any(record.get(key) != other.get(key)
                      for key in record.keys() | other.keys() if key != "timings_ms")
    if differ:
        wrong.append("%d lines differ from one process's" % differ)
    return wrong


def lines_in(folder):
    """Clouds done so far."""
    total = 0
    for path in folder.glob("*.jsonl"):
        with open(path, "rb") as file:
            total += file.read().count(b"\n")
    return total


class Service:
    """A process that is begun anew whenever it has ended."""

    def __init__(self, command):
        self.command = command
        self.process = quiet(command)

    def revive(self):
        if self.process.poll() is not None:
            self.process = quiet(self.command)

    def kill(self):
        end(self.process)


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def run_with_kills(services, victims, finished, progress, arguments, chance):
    """Runs until finished(); kills the victims in random order at random shares of the work.
    Returns how many processes were killed."""
    moments = sorted(chance.uniform(0.03, 0.9) * arguments.clouds for _ in range(arguments.kills))
    killed = 0
    while not finished():
        time.sleep(0.2)
        for service in services:
            service.revive()
        if moments and progress() >= moments[0]:
            moments.pop(0)
            for service in chance.sample(victims, len(victims)):
                service.kill()
                killed += 1
                time.sleep(chance.uniform(0, 1))
                if chance.random() < 0.5:
                    service.revive()
    if moments:
        print("the work was done before %d of the kills" % len(moments))
    return killed


def kills_of_batch(arguments, manifest, out, chance):
    """The batch with a scheduler, two workers and the client, all of them killed."""
    address = "tcp://127.0.0.1:%d" % free_port()
    scheduler = Service([PYTHON, "-m", "distributed.cli.dask_scheduler", "--no-dashboard",
                         "--host", "127.0.0.1", "--port", address.rpartition(":")[2]])
    workers = [Service([PYTHON, "-m", "distributed.cli.dask_worker", address, "--nthreads", "1",
                        "--no-dashboard"]) for _ in range(2)]
    client = Service(batch_command(arguments, manifest, out, "--scheduler", address))
    services = [scheduler, client] + workers
    try:
        return run_with_kills(
            services, services[:3], lambda: (out / "summary.json").exists(),
            lambda: lines_in(out / "shards"), arguments, chance)
    finally:
        for service in services:
            service.kill()


def kills_of_fit(arguments, manifest, out, chance):
    """Two processes of pcl_sq_fit, killed; done when both have ended by themselves."""
    out.mkdir()
    services = [Service(fit_command(arguments, manifest, "%d/2" % i, out / ("%d.jsonl" % i)))
                for i in (1, 2)]
    try:
        return run_with_kills(services, services, lambda: lines_in(out) >= arguments.clouds,
                              lambda: lines_in(out), arguments, chance)
    finally:
        for service in services:
            service.kill()


def kills(arguments, folder):
    chance = random.Random(arguments.seed)
    names = make_clouds(folder, arguments.cloud, arguments.clouds, arguments.seed)
    manifest = folder / "manifest.txt"
    start = time.time()
    quiet(fit_command(arguments, manifest, "1/1", folder / "one.jsonl")).wait()
    print("one process: %d clouds in %.0f s" % (len(names), time.time() - start), flush=True)
    expected = records_of([folder / "one.jsonl"])
    failed = compare(expected, expected, names)
    for title, run in (
            ("pcl_sq.batch, two workers", lambda: kills_of_batch(
                arguments, manifest, folder / "batch", chance)),
            ("pcl_sq_fit --shard I/2 --resume", lambda: kills_of_fit(
                arguments, manifest, folder / "fit", chance))):
        start = time.time()
        killed = run()
        paths = sorted((folder / "batch" / "shards").iterdir()) if "batch" in title else \
            sorted((folder / "fit").iterdir())
        found = records_of(paths)
        wrong = compare(found, expected, names)
        failed += wrong
        print("%s: %d processes killed in %.0f s; %d lines, %d of them errors; %s" % (
            title, killed, time.time() - start, len(found),
            sum("error" in r for r in found), "; ".join(wrong) or "as one process"), flush=True)
    return 1 if failed else 0


def timed(commands):
    """(seconds, seconds of processor) of processes beside each other."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    start = time.time()
    # in one session: Linux shares the processor among sessions before processes
    running = [quiet(c, session=False) for c in commands]
    for process in running:
        if process.wait() not in (0, 1):
            sys.exit("a process has failed: %s" % process.args)
    seconds = time.time() - start
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return seconds, (after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)


def speed(arguments, folder):
    make_clouds(folder, arguments.cloud, arguments.clouds, arguments.seed)
    manifest = folder / "manifest.txt"
    for workers in [int(w) for w in arguments.workers.split(",")]:
        rows = {"pcl_sq_fit": [], "pcl_sq.batch": []}
        for k in range(arguments.rounds):
            for name in sorted(rows, reverse=k % 2 == 1):  # in turns, so is who begins
                out = folder / ("%s-%d-%d" % (name, workers, k))
                if name == "pcl_sq_fit":
                    out.mkdir()
                    commands = [fit_command(arguments, manifest, "%d/%d" % (i, workers),
                                            out / ("%d.jsonl" % i))
                                for i in range(1, workers + 1)]
                else:
                    commands = [batch_command(arguments, manifest, out, "--local", str(workers))]
                rows[name].append(timed(commands))
        seconds, cpu = ({name: sum(r[i] for r in row) / len(row) for name, row in rows.items()}
                        for i in (0, 1))
        for name in rows:
            print("%-13s %d workers: %6.1f clouds/s, %6.2f ms of processor a cloud" % (
                name, workers, arguments.clouds / seconds[name],
                1e3 * cpu[name] / arguments.clouds))
        print("  batch over fit: throughput %.3f, of processor time %.3f" % (
            seconds["pcl_sq_fit"] / seconds["pcl_sq.batch"],
            cpu["pcl_sq_fit"] / cpu["pcl_sq.batch"]), flush=True)
    return 0


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("what", choices=["kills", "speed"])
    parser.add_argument("bin")
    parser.add_argument("cloud", nargs="+")
    parser.add_argument("--clouds", type=int)
    parser.add_argument("--kills", type=int, default=5)
    parser.add_argument("--workers", default="1,2,4")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--keep", type=pathlib.Path)
    words = sys.argv[1:]
    split = words.index("--") if "--" in words else len(words)
    arguments = parser.parse_args(words[:split])
    arguments.words = words[split + 1:]
    arguments.clouds = arguments.clouds or (5000 if arguments.what == "kills" else 600)
    arguments.bin = os.path.abspath(arguments.bin)
    work = {"kills": kills, "speed": speed}[arguments.what]
    if arguments.keep:
        arguments.keep.mkdir(parents=True)
        return work(arguments, arguments.keep.absolute())
    with tempfile.TemporaryDirectory() as folder:
        return work(arguments, pathlib.Path(folder))


if __name__ == "__main__":
    sys.exit(main())
