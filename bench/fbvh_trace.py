#!/usr/bin/env python3
"""What walking the trees takes: fbvh_trace.py static|counters PROGRAM. Called by fbvh.sh, which sets LIMIT and SCENES."""
import json
import os
import re
import resource
import statistics
import subprocess
import sys
import tempfile

from common import camera, fail, scene_path

ROUNDS = 3
FRAMES = 12
STATIC = {"S10k": "S1_10k", "S100k": "S1_100k", "S1M": "S1_1M"}
MOST = 1.5
SCENES = ["scattered:30000", "scattered:100000", "tornado:4000", "tornado:128000", "examples/1tii.pdb", "pool:10000"]


def render(program, scene, method, options):
    """The statistics of one process, and the processor time it took, in milliseconds."""
    with tempfile.TemporaryDirectory() as folder:
        stats = os.path.join(folder, "stats.json")
        command = [program, "render", scene, "--stats", stats, "--method", method, "--size", "640x480", *options]
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        done = subprocess.run(command, capture_output=True, text=True, env={**os.environ, "OMP_WAIT_POLICY": "passive"})
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        if done.returncode:
            fail(f"{' '.join(command)}: {done.stderr.strip()}")
        spent = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        with open(stats, encoding="utf-8") as file:
            return json.load(file), 1e3 * spent


def frame(program, scene, method, options):
    """Of a static frame: median milliseconds, and half its processor time (a processor's, of two), from the difference of a long
    run and a short one."""
    _, few = render(program, scene, method, [*options, "--repeat", "2"])
    stats, many = render(program, scene, method, [*options, "--repeat", str(2 + FRAMES)])
    return stats["repeat"]["median"]["ms"]["trace"], (many - few) / FRAMES / 2, stats["renderer"]


def yardstick(path):
    command = [os.environ["LIMIT"], path, "1", "0.5", "0.5", "0.5", "3", "0.2", "640", "480", "primary", "5"]
    said = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    return [float(value) for value in re.search(r"trace med=([\d.]+)ms.*cpu/2=([\d.]+)ms", said).groups()]


def print_static(program):
    """The yardstick and fbvh in turn; medians of the rounds."""
    rows, renderer = [], ""
    load = os.getloadavg()[0]
    for name, file in STATIC.items():
        path, theirs, ours = scene_path(file), [], []
        options = ["--kernel", "poly3", "--iso", "0.2", *camera(name[0])]
        for _ in range(ROUNDS):
            theirs.append(yardstick(path))
            *times, renderer = frame(program, path, "fbvh", options)
            ours.append(times)
        wall, spent = ([statistics.median(t[k] for t in times) for times in (theirs, ours)] for k in (0, 1))
        ratios = [statistics.median(o[k] / t[k] for o, t in zip(ours, theirs)) for k in (0, 1)]
        rows.append(f"| {name} | {wall[0]:.1f} | {wall[1]:.1f} | {ratios[0]:.2f} | {spent[0]:.1f} | {spent[1]:.1f} | "
                    f"{ratios[1]:.2f} | {MOST} |")
    print(f"{renderer}, {os.cpu_count()} processors, load average {load:.1f} before; the yardstick with "
          f"{os.environ['LIMIT_VECTORS']}; 640x480, medians of {ROUNDS} rounds.\n")
    print("| scene | yardstick's trace, ms | `fbvh`, ms | ratio | its processor ms / 2 | `fbvh`'s | ratio | at most |\n"
          "|" + "-|" * 8)
    print("\n".join(rows))


def print_counters(program):
    print("| scene | method | nodes | leaves | balls | rounds |\n|" + "-|" * 6)
    for scene in SCENES:
        for method in ("bvh", "fbvh"):
            stats, _ = render(program, scene, method, ["--counters"])
            work = stats["work"]
            cells = [f"{work[key]:.2f}" for key in ("nodes", "leaves", "balls", "rounds")]
            print(f"| `{scene}` | `{method}` | " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    if len(sys.argv) != 3 or sys.argv[1] not in ("static", "counters"):
        fail("expected static or counters, and the program")
    print_static(sys.argv[2]) if sys.argv[1] == "static" else print_counters(sys.argv[2])
