#!/usr/bin/env python3
"""The tables of times: list.py ratios|phases PROGRAM. Called by list.sh, which sets LIMIT, LIMIT_VECTORS, SCENES."""
import os
import statistics
import sys

from common import REPEAT, camera, draw, fail, machine, median_ms, scene_path, yardstick_ms

ROUNDS = 3
PHASES = ["sort", "bin", "upload", "core_depth", "gather", "build", "cast", "normal", "trace"]
# scene: file, most times the yardstick (exact)
RATIOS = {
    "S10k": ("S1_10k", 1.6), "S100k": ("S1_100k", 3.3), "S1M": ("S1_1M", 9.8),
    "D10k": ("S2_10k", 3.0), "D100k": ("S2_100k", 3.5), "D1M": ("S2_1M", 9.6),
}


def frame_ms(stats):
    ms = median_ms(stats)
    return sum(ms.get(name, 0.0) for name in PHASES)


def print_ratios(program):
    """Yardstick, exact and cubic in turn, ROUNDS times; medians of the rounds."""
    rows, renderer = [], ""
    for name, (file, most) in RATIOS.items():
        path = scene_path(file)
        options = ["--kernel", "poly3", "--iso", "0.2", *camera(name[0])]
        times = {"yardstick": [], "exact": [], "cubic": []}
        for _ in range(ROUNDS):
            times["yardstick"].append(yardstick_ms(path, name[0], "640x480"))
            for solver in ("exact", "cubic"):
                stats = draw(program, path, "640x480", "list", ["--solver", solver, *options])
                times[solver].append(frame_ms(stats))
                renderer = stats["renderer"]
        limit, exact, cubic = (statistics.median(times[key]) for key in ("yardstick", "exact", "cubic"))
        rows.append(f"| {name} | {limit:.1f} | {exact:.1f} | {cubic:.1f} | {exact / limit:.2f} | {most} | "
                    f"{exact / cubic:.2f} |")
    print(f"{machine(renderer)}; 640x480, medians of {ROUNDS} rounds of {REPEAT} moving frames, milliseconds.\n")
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
            stats = draw(program, scene, size, "list", options)
            ms, lists, renderer = median_ms(stats), stats["lists"], stats["renderer"]
            cells = [f"{ms.get(phase, 0.0):.1f}" for phase in shown]
            rest = sum(ms.get(phase, 0.0) for phase in PHASES if phase not in shown)
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
