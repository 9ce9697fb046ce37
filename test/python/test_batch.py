# SPDX-License-Identifier: BSD-3-Clause
"""Many clouds: every one exactly once, whatever is killed; the lines of one process."""
import json
import os
import random
import signal
import subprocess
import sys
import time

import numpy as np
import pytest

from conftest import numbers, write_xyz

CLOUDS = 60


@pytest.fixture(scope="module")
def manifest(bottle, tmp_path_factory):
    """Clouds, two of them bad, and the manifest that names them."""
    folder = tmp_path_factory.mktemp("clouds")
    names = []
    for i in range(CLOUDS):
        path = folder / ("cloud %02d.xyz" % i)
        names.append(str(path))
        if i in (7, 23):
            path.write_text("no numbers\n" if i == 7 else "")
            continue
        write_xyz(path, bottle[1][i % 5::12] * (1 + 0.01 * i))
    path = folder / "manifest.txt"
    path.write_text("# clouds\n\n" + "\n".join(names) + "\n")
    return path, names


def command(manifest, out, *more):
    return [sys.executable, "-m", "pcl_sq.batch", str(manifest), "--out", str(out),
            "--shard-size", "5"] + list(more)


def lines_of(out):
    records = []
    for name in sorted(os.listdir(out / "shards")):
        assert name.endswith(".jsonl"), name
        with open(out / "shards" / name) as file:
            records += [json.loads(line) for line in file]
    return records


def without_batch():
    return subprocess.run([sys.executable, "-c", "import distributed"],
                          capture_output=True).returncode != 0


needs_dask = pytest.mark.skipif(without_batch(), reason="python3-distributed is not installed")


def children_of(pid):
    found = []
    for name in os.listdir("/proc"):
        if name.isdigit():
            try:
                with open("/proc/%s/stat" % name) as file:
                    parent = int(file.read().rpartition(")")[2].split()[1])
            except (OSError, IndexError):
                continue
            if parent == pid:
                found += [int(name)] + children_of(int(name))
    return found


def is_worker(pid):
    try:
        with open("/proc/%d/cmdline" % pid) as file:
            return "spawn_main" in file.read()
    except OSError:
        return False


@needs_dask
def test_every_cloud_is_there_once_after_kills_of_workers_and_client(manifest, tmp_path, program):
    path, names = manifest
    out = tmp_path / "out"
    chance = random.Random(1)
    for _ in range(2):  # the client is killed while it works
        run = subprocess.Popen(command(path, out, "--local", "2"), stderr=subprocess.DEVNULL,
                               stdout=subprocess.DEVNULL, start_new_session=True)
        deadline = time.time() + 60
        before = len(os.listdir(out / "shards")) if (out / "shards").exists() else 0
        while time.time() < deadline and run.poll() is None:
            if (out / "shards").exists() and len(os.listdir(out / "shards")) > before:
                break
            time.sleep(0.02)
        workers = [pid for pid in children_of(run.pid) if is_worker(pid)]
        if workers and run.poll() is None:  # a worker first
            try:
                os.kill(chance.choice(workers), signal.SIGKILL)
            except ProcessLookupError:
                pass
            time.sleep(0.2)
        if run.poll() is None:
            os.killpg(run.pid, signal.SIGKILL)
        run.wait()
    done = subprocess.run(command(path, out, "--local", "2"), capture_output=True, text=True)
    assert done.returncode == 1, done.stdout + done.stderr  # two clouds have no model
    records = lines_of(out)
    assert [r["input"]["path"] for r in records] == names
    assert [i for i, r in enumerate(records) if "error" in r] == [7, 23]
    summary = json.loads((out / "summary.json").read_text())
    assert (summary["clouds"], summary["fitted"], summary["failed"]) == (CLOUDS, CLOUDS - 2, 2)
    assert summary["failed_clouds"] == [names[7], names[23]]
    # as one process makes them
    program("pcl_sq_fit", "--manifest", path, "--jsonl", "-q", "-o", tmp_path / "one.jsonl",
            check=False)
    for record, line in zip(records, (tmp_path / "one.jsonl").read_text().splitlines()):
        if "error" in record:
            assert record == json.loads(line)
        else:
            assert numbers(json.dumps(record)) == numbers(line)
    # nothing is done again
    stamps = {n: os.stat(out / "shards" / n).st_mtime_ns for n in os.listdir(out / "shards")}
    again = subprocess.run(command(path, out, "--local", "2"), capture_output=True, text=True)
    assert again.returncode == 1 and "0 of them now" in again.stdout
    assert stamps == {n: os.stat(out / "shards" / n).st_mtime_ns for n in stamps}


@needs_dask
def test_nothing_lacks_after_kills_of_scheduler_worker_and_client(tmp_path, bottle):
    """benchmarks/cluster.py with few clouds: it begins anew what it has killed."""
    source = os.environ["PCL_SQ_SOURCE_DIR"]
    binaries = os.environ.get("PCL_SQ_BIN_DIR", "")
    if not os.path.exists(os.path.join(binaries, "pcl_sq_fit")):
        pytest.skip("pcl_sq_fit is not built")
    cloud = write_xyz(tmp_path / "bottle.xyz", bottle[1])
    done = subprocess.run([sys.executable, "-B", os.path.join(source, "benchmarks/cluster.py"),
                           "kills", binaries, str(cloud), "--clouds", "60", "--kills", "1",
                           "--", "--parts", "1"], capture_output=True, text=True, timeout=540)
    assert done.returncode == 0, done.stdout + done.stderr
    assert done.stdout.count("60 lines, 0 of them errors; as one process") == 2, done.stdout


def test_what_makes_no_sense_is_refused(manifest, tmp_path):
    path, _ = manifest

    def run(*arguments):
        return subprocess.run([sys.executable, "-m", "pcl_sq.batch"] + [str(a) for a in arguments],
                              capture_output=True, text=True)
    assert run().returncode == 2
    assert run(path, "--out", tmp_path / "x", "--local", "0").returncode == 2
    bad = run(path, "--out", tmp_path / "x", "--", "--parts", "99")
    assert bad.returncode == 2 and "--parts" in bad.stderr and not (tmp_path / "x").exists()
    none = run(tmp_path / "none.txt", "--out", tmp_path / "x")
    assert none.returncode == 1 and "manifest" in none.stderr
    (tmp_path / "empty.txt").write_text("# nothing\n")
    assert run(tmp_path / "empty.txt", "--out", tmp_path / "x").returncode == 1


@needs_dask
def test_another_manifest_does_not_mix_with_what_is_there(manifest, tmp_path, bottle):
    out = tmp_path / "out"
    good = write_xyz(tmp_path / "a.xyz", bottle[1][::8])
    (tmp_path / "one.txt").write_text("%s\n" % good)
    assert subprocess.run(command(tmp_path / "one.txt", out, "--local", "1", "-q")).returncode == 0
    other = subprocess.run(command(manifest[0], out), capture_output=True, text=True)
    assert other.returncode == 1 and "another" in other.stderr


def test_shards_of_pcl_sq_fit_are_all_clouds_and_resume_keeps_what_is_there(manifest, tmp_path,
                                                                            program):
    path, names = manifest
    found = []
    for i in (1, 2, 3):
        out = tmp_path / ("%d.jsonl" % i)
        line = ["--manifest", path, "--jsonl", "--shard", "%d/3" % i, "--resume", "-q", "-o", out]
        program("pcl_sq_fit", *line, check=False)
        whole = out.read_text()
        cut = whole[:len(whole) // 2]  # as after a kill: a line without its end
        out.write_text(cut)
        program("pcl_sq_fit", *line, check=False)
        text = out.read_text()
        assert text.startswith(cut[:cut.rindex("\n") + 1])
        records = [json.loads(l) for l in text.splitlines()]
        assert sorted(r["input"]["path"] for r in records) == sorted(names[i - 1::3])
        before = out.stat().st_mtime_ns
        program("pcl_sq_fit", *line, check=False)
        assert out.stat().st_mtime_ns == before
        found += records
    assert sorted(r["input"]["path"] for r in found) == sorted(names)
    assert sum("error" in r for r in found) == 2


@pytest.mark.parametrize("arguments, sentence, code", [
    (["--shard", "0/3"], "--shard", 2), (["--shard", "4/3"], "--shard", 2),
    (["--resume"], "-o", 2), (["--shard", "x"], "--shard", 2)])
def test_shares_that_are_none_are_refused(manifest, program, arguments, sentence, code):
    done = program("pcl_sq_fit", "--manifest", manifest[0], "--jsonl", *arguments, check=False)
    assert done.returncode == code and sentence in done.stderr


def test_resume_does_not_touch_a_file_that_is_none_of_ours(manifest, program, tmp_path):
    (tmp_path / "notes.txt").write_text("dear diary\n")
    done = program("pcl_sq_fit", "--manifest", manifest[0], "--jsonl", "--resume", "-o",
                   tmp_path / "notes.txt", check=False)
    assert done.returncode == 1 and "--resume" in done.stderr
    assert (tmp_path / "notes.txt").read_text() == "dear diary\n"
