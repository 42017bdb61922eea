#!/usr/bin/env python3
"""The tables of times: list.py ratios|phases PROGRAM. Called by list.sh, which sets LIMIT, LIMIT_VECTORS, SCENES."""
import json
import os
import re
import statistics
import subprocess
import sys
import tempfile

ROUNDS = 3
REPEAT = 7
PHASES = ["sort", "bin", "upload", "core_depth", "gather", "build", "cast", "normal", "trace"]
CENTRE = {"S": (0.5, 0.5, 0.5), "D": (1.0, 0.25, 0.5)}
# scene: file, most times the yardstick (exact)
RATIOS = {
    "S10k": ("S1_10k", 1.6), "S100k": ("S1_100k", 3.3), "S1M": ("S1_1M", 9.8),
    "D10k": ("S2_10k", 3.0), "D100k": ("S2_100k", 3.5), "D1M": ("S2_1M", 9.6),
}


def fail(text):
    sys.exit("list.py: " + text)


def camera(kind):
    """The yardstick's view: the eye at centre + (0, 0.6, 2.2), looking at the centre."""
    x, y, z = CENTRE[kind]
    return ["--eye", f"{x},{y + 0.6},{z + 2.2}", "--look-at", f"{x},{y},{z}"]


def draw(program, scene, size, options):
    """Medians of the phases over REPEAT moving frames, and the rest of the statistics, of one process."""
    with tempfile.TemporaryDirectory() as folder:
        stats = os.path.join(folder, "stats.json")
        command = [program, "render", scene, "-o", os.path.join(folder, "image.png"), "--method", "list", "--size",
                   size, "--repeat", str(REPEAT), "--moving", "--stats", stats, *options]
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode:
            fail(f"{' '.join(command)}: {done.stderr.strip()}")
        with open(stats, encoding="utf-8") as file:
            return json.load(file)


def phase_ms(stats):
    return {name: stats["repeat"]["median"]["ms"].get(name) or 0.0 for name in PHASES + ["total"]}


def frame_ms(stats):
    ms = phase_ms(stats)
    return sum(ms[name] for name in PHASES)


def yardstick_ms(path, kind):
    centre = [str(v) for v in CENTRE[kind]]
    command = [os.environ["LIMIT"], path, "1", *centre, "3", "0.2", "640", "480", "primary", "5"]
    said = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    build, trace = re.search(r"build=([\d.]+)ms trace med=([\d.]+)ms", said).groups()
    return float(build) + float(trace)


def print_ratios(program):
    """Yardstick, exact and cubic in turn, ROUNDS times; medians of the rounds."""
    rows, renderer = [], ""
    for name, (file, most) in RATIOS.items():
        path = os.path.join(os.environ["SCENES"], file + ".csv")
        options = ["--kernel", "poly3", "--iso", "0.2", *camera(name[0])]
        times = {"yardstick": [], "exact": [], "cubic": []}
        for _ in range(ROUNDS):
            times["yardstick"].append(yardstick_ms(path, name[0]))
            for solver in ("exact", "cubic"):
                stats = draw(program, path, "640x480", ["--solver", solver, *options])
                times[solver].append(frame_ms(stats))
                renderer = stats["renderer"]
        limit, exact, cubic = (statistics.median(times[key]) for key in ("yardstick", "exact", "cubic"))
        rows.append(f"| {name} | {limit:.1f} | {exact:.1f} | {cubic:.1f} | {exact / limit:.2f} | {most} | "
                    f"{exact / cubic:.2f} |")
    print(f"{renderer}, {os.cpu_count()} processors; the yardstick with {os.environ['LIMIT_VECTORS']}; 640x480, "
          f"medians of {ROUNDS} rounds of {REPEAT} moving frames, milliseconds.\n")
    print("| scene | yardstick, build + trace | `exact` | `cubic` | `exact` / yardstick | at most | "
          "`exact` / `cubic` (at most 1.2) |\n|-|-|-|-|-|-|-|")
    print("\n".join(rows))


def phase_scenes():
    """name, input, options, sizes"""
    sizes = ["640x480", "1024x768"]
    for kind, generator in (("S", "scattered"), ("D", "dense")):
        for name, count in (("1k", 1000), ("10k", 10000), ("100k", 100000), ("1M", 1000000)):
            yield kind + name, f"{generator}:{count}", camera(kind), sizes
    yield "molecule", "examples/1tii.pdb", [], sizes
    yield ("dam break", "examples/dam.06500.lammpstrj.gz",
           ["--radius", "2.2", "--kernel", "poly2", "--iso", "0.35", "--eye", "112,-14,66", "--look-at", "12,43,26",
            "--up", "0,0,1", "--fov", "40"], sizes)
    for kind, generator in (("S", "scattered"), ("D", "dense")):
        yield kind + "1.6M", f"{generator}:1600000", camera(kind), sizes


def print_phases(program):
    shown = ["sort", "upload", "core_depth", "gather", "cast", "normal"]
    rows, renderer = [], ""
    for name, scene, options, sizes in phase_scenes():
        for size in sizes:
            stats = draw(program, scene, size, options)
            ms, lists, renderer = phase_ms(stats), stats["lists"], stats["renderer"]
            cells = [f"{ms[phase]:.1f}" for phase in shown]
            rest = sum(ms[phase] for phase in PHASES if phase not in shown)
            cells += [f"{rest:.1f}", f"{ms['total']:.1f}", f"{lists['mean']:.1f}", f"{lists['p99']:.0f}",
                      f"{lists['max']}", f"{stats['memory']['peak_rss_bytes'] / 2**20:.0f}"]
            rows.append(f"| {name} | {size} | {stats['counts']['balls']} | " + " | ".join(cells) + " |")
    print(f"{renderer}, {os.cpu_count()} processors; `exact`, medians of {REPEAT} moving frames, milliseconds; peak "
          "memory (VmHWM) of the whole process.\n")
    print("| scene | size | balls | " + " | ".join(shown) + " | other | total | list mean | p99 | max | MiB |\n"
          "|" + "-|" * (len(shown) + 9))
    print("\n".join(rows))


if __name__ == "__main__":
    if len(sys.argv) != 3 or sys.argv[1] not in ("ratios", "phases"):
        fail("expected ratios or phases, and the program")
    print_ratios(sys.argv[2]) if sys.argv[1] == "ratios" else print_phases(sys.argv[2])
