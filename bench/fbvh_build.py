#!/usr/bin/env python3
"""What building the trees takes: fbvh_build.py BENCH_FBVH_BUILD. Called by fbvh.sh, which sets LIMIT and SCENES."""
import os
import re
import statistics
import subprocess
import sys

ROUNDS = 5
REPEAT = 5
# yardstick's scene: file, eye's target, most times its build
RATIOS = {"S10k": ("S1_10k", None), "S100k": ("S1_100k", None), "S1M": ("S1_1M", 11), "D10k": ("S2_10k", None),
          "D100k": ("S2_100k", None), "D1M": ("S2_1M", 31)}
GOALS = {"tornado:128000": 80, "scattered:1000000": 500, "dense:1000000": 1200}
SIZES = [10000, 30000, 100000, 300000, 1000000]
SWITCHES = ["", "cost-n", "no-fit", "no-tight", "no-discard", "no-tight,no-discard", "no-deep", "middle-levels=-1",
            "bvh", "bvh,cost-n"]


def build(program, scene, options=""):
    said = subprocess.run([program, scene, options, str(REPEAT)], capture_output=True, text=True, check=True).stdout
    return {name: float(value) for name, value in re.findall(r"(\w+)=([\d.]+)", said.split(" ", 2)[2])}


def yardstick(path):
    command = [os.environ["LIMIT"], path, "1", "0.5", "0.5", "0.5", "3", "0.2", "64", "48", "primary", "1"]
    said = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    return float(re.search(r"build=([\d.]+)ms", said).group(1))


def table(heads, rows):
    print("| " + " | ".join(heads) + " |")
    print("|" + "-|" * len(heads))
    for row in rows:
        print("| " + " | ".join(row) + " |")
    print()


def ratios(program):
    rows = []
    for name, (file, most) in RATIOS.items():
        path = os.path.join(os.environ["SCENES"], file + ".csv")
        ours, theirs, shares = [], [], []
        for _ in range(ROUNDS):
            theirs.append(yardstick(path))
            ours.append(build(program, path)["median"])
            shares.append(ours[-1] / theirs[-1])
        rows.append([name, f"{statistics.median(theirs):.1f}", f"{statistics.median(ours):.1f}",
                     f"{statistics.median(shares):.2f}", str(most or "")])
    table(["scene", "yardstick's build, ms", "FBVH, ms", "ratio", "at most"], rows)


def goals(program):
    rows = []
    for scene, most in GOALS.items():
        b = build(program, scene)
        rows.append([f"`{scene}`", f"{b['median']:.0f}", f"{b['processor']:.0f}", f"{b['sort']:.0f}", str(most),
                     f"{b['leaves']:.0f}", f"{b['mean']:.1f}", f"{b['depth']:.0f}"])
    table(["scene", "ms", "processor ms, all threads", "of it sort and pack", "at most", "leaves", "balls a leaf", "depth"],
          rows)


def growth(program):
    rows = []
    for name in ("scattered", "dense", "tornado"):
        for size in SIZES:
            b = build(program, f"{name}:{size}")
            rows.append([f"`{name}`", f"{size:,}", f"{b['median']:.1f}", f"{1e3 * b['processor'] / size:.2f}",
                         f"{b['references']:.2f}", f"{b['bytes']:.0f}", f"{b['scratch']:.0f}"])
    table(["scene", "balls", "ms", "processor us a ball", "references a ball", "bytes a ball, GPU", "besides, builder"], rows)


def switches(program):
    rows = []
    for scene in ("pool:10000", "tornado:128000", "molecule:5684", "scattered:100000"):
        for options in SWITCHES:
            b = build(program, scene, options)
            rows.append([f"`{scene}`", f"`{options}`" if options else "default", f"{b['median']:.1f}",
                         f"{b['processor']:.1f}", f"{b['leaves']:.0f}", f"{b['mean']:.1f}", f"{b['references']:.2f}",
                         f"{b['discarded']:.0f}", f"{b['depth']:.0f}"])
    table(["scene", "switches", "ms", "processor ms", "leaves", "balls a leaf", "references a ball", "discarded", "depth"], rows)


def main():
    program = sys.argv[1]
    print(f"{os.cpu_count()} processors, load average {os.getloadavg()[0]:.1f} before; medians of {REPEAT} builds"
          f" (the ratios: of {ROUNDS} rounds of them, in turn with the yardstick).\n")
    ratios(program)
    goals(program)
    growth(program)
    switches(program)


if __name__ == "__main__":
    main()
