#!/usr/bin/env python3
"""The tables of speed.md: speed.py ratios|paper|large|growth PROGRAM [SCENE...]. Called by speed.sh, which sets LIMIT,
LIMIT_VECTORS, SCENES."""
import statistics
import sys

from common import REPEAT, camera, draw, fail, machine, median_ms, scene_path, yardstick_ms

ROUNDS = 3
SIZES = {"640x480": 1.0, "1024x768": 1.1}  # and what the bars are times there
# scene: file, goal and bar of tile over yardstick at 640x480
RATIOS = {
    "S1k": ("S1_1k", 0.9, 1.0), "S10k": ("S1_10k", 0.9, 1.0), "S100k": ("S1_100k", 0.9, 1.1), "S1M": ("S1_1M", 1.0, 1.4),
    "mixed": ("S3_10k", 0.9, 1.1), "D10k": ("S2_10k", 0.9, 1.0), "D100k": ("S2_100k", 1.0, 1.1),
    "D1M": ("S2_1M", 1.0, 1.3),
}
# scene: file, how many times faster than the paper's passes at least
PAPER = {"S100k": ("S1_100k", 3), "S1M": ("S1_1M", 6), "D100k": ("S2_100k", 3), "D1M": ("S2_1M", 6)}
LARGE_MOST_MS = 1000  # 1,600,000 balls, dense, 1024x768
GROWTH = [100_000, 400_000, 1_600_000, 6_400_000, 16_000_000]  # scattered balls
GROWTH_REPEAT = 7
PAPER_ROUNDS, PAPER_REPEAT = 3, {"list": 3, "tile": 7}
GROWTH_MOST_MIB = 6 * 1024  # the whole program, of the last


def kind_of(name):
    return "D" if name[0] == "D" else "S"


def options_of(name):
    return ["--kernel", "poly3", "--iso", "0.2", *camera(kind_of(name))]


def verdict(value, goal, bar):
    return "goal" if value <= goal else "bar" if value <= bar else "misses the bar"


def print_tally(verdicts):
    """The last line of a table: how many rows came to what."""
    print("\nOf {} rows: {}.".format(len(verdicts), ", ".join(f"{verdicts.count(v)} {v}" for v in sorted(set(verdicts)))))


def print_ratios(program, wanted):
    """Yardstick and tile in turn, ROUNDS times; medians of the rounds."""
    rows, verdicts, renderer = [], [], ""
    for size, more in SIZES.items():
        for name in wanted:
            file, goal, bar = RATIOS[name]
            limit, tile = [], []
            for _ in range(ROUNDS):
                limit.append(yardstick_ms(scene_path(file), kind_of(name), size))
                stats = draw(program, scene_path(file), size, "tile", options_of(name))
                tile.append(median_ms(stats))
                renderer = stats["renderer"]
            phases = [statistics.median(ms.get(phase, 0.0) for ms in tile)
                      for phase in ("sort", "bin", "upload", "cast", "total")]
            unit = statistics.median(limit)
            ratio = phases[-1] / unit
            verdicts.append(verdict(ratio, goal * more, bar * more))
            cells = [name, size, f"{unit:.1f}", *(f"{ms:.1f}" for ms in phases), f"{ratio:.2f}", f"{goal * more:.2f}",
                     f"{bar * more:.2f}", verdicts[-1]]
            rows.append("| " + " | ".join(cells) + " |")
    print(f"{machine(renderer)}; `exact`, medians of {ROUNDS} rounds of {REPEAT} moving frames, milliseconds.\n")
    print("| scene | size | yardstick, build + trace | sort | bin | upload | cast | `total` | `total` / yardstick | goal | "
          "at most | reached |\n|-|-|-|-|-|-|-|-|-|-|-|-|")
    print("\n".join(rows))
    print_tally(verdicts)


def print_paper(program, wanted):
    """The paper's passes and tile in turn."""
    rows, verdicts, renderer = [], [], ""
    for name in wanted:
        if name not in PAPER:
            continue
        file, least = PAPER[name]
        times = {"list": [], "tile": []}
        for _ in range(PAPER_ROUNDS):
            for method, more in (("list", ["--gather", "paper"]), ("tile", [])):
                stats = draw(program, scene_path(file), "640x480", method, [*options_of(name), *more],
                             PAPER_REPEAT[method])
                times[method].append(median_ms(stats)["total"])
                renderer = stats["renderer"]
        paper, tile = (statistics.median(times[method]) for method in ("list", "tile"))
        verdicts.append("goal" if paper / tile >= least else "misses the bar")
        rows.append(f"| {name} | {paper:.1f} | {tile:.1f} | {paper / tile:.2f} | {least} | {verdicts[-1]} |")
    print(f"{renderer}; 640x480, medians of {PAPER_ROUNDS} rounds of {PAPER_REPEAT['list']} and "
          f"{PAPER_REPEAT['tile']} moving frames, `total` in milliseconds.\n")
    print("| scene | `list --gather paper` | `tile` | times faster | at least | reached |\n|-|-|-|-|-|-|")
    print("\n".join(rows))
    print_tally(verdicts)


def print_large(program, _):
    stats = draw(program, "dense:1600000", "1024x768", "tile", options_of("D"))
    ms, peak = median_ms(stats), stats["memory"]["peak_rss_bytes"] / 2**20
    print(f"{stats['renderer']}; 1,600,000 balls, dense, 1024x768, median of {REPEAT} moving frames.\n")
    print("| sort | bin | upload | cast | `total` | at most | peak memory, MiB | reached |\n|-|-|-|-|-|-|-|-|")
    times = " | ".join(f"{ms[phase]:.1f}" for phase in ("sort", "bin", "upload", "cast", "total"))
    print(f"| {times} | {LARGE_MOST_MS} | {peak:.0f} | {verdict(ms['total'], LARGE_MOST_MS, LARGE_MOST_MS)} |")


def print_growth(program, _):
    """From row to row a ball may cost no more than it did among fewer."""
    rows, verdicts, renderer, most = [], [], "", None
    for count in GROWTH:
        stats = draw(program, f"scattered:{count}", "640x480", "tile", options_of("S"), GROWTH_REPEAT)
        renderer, total = stats["renderer"], median_ms(stats)["total"]
        peak, load = stats["memory"]["peak_rss_bytes"] / 2**20, stats["ms"]["load"] / 1000
        each = 1e6 * total / count
        most = most or each
        good = each <= most and peak <= GROWTH_MOST_MIB
        verdicts.append("goal" if good else "misses the bar")
        rows.append(f"| {count:,} | {load:.2f} | {total:.1f} | {each:.0f} | {most:.0f} | {peak:.0f} | {GROWTH_MOST_MIB} | "
                    f"{verdicts[-1]} |")
        most = each
    print(f"{renderer}; `scattered`, 640x480, median of {GROWTH_REPEAT} moving frames.\n")
    print("| balls | load, s | frame, ms | a ball, ns | at most | peak memory, MiB | at most | reached |\n"
          "|-|-|-|-|-|-|-|-|")
    print("\n".join(rows))
    print_tally(verdicts)


TABLES = {"ratios": print_ratios, "paper": print_paper, "large": print_large, "growth": print_growth}

if __name__ == "__main__":
    if len(sys.argv) < 3 or sys.argv[1] not in TABLES:
        fail(f"expected {', '.join(TABLES)}, the program and scenes")
    scenes = sys.argv[3:] or list(RATIOS)
    for unknown in set(scenes) - set(RATIOS):
        fail(f"no scene '{unknown}'; known: {', '.join(RATIOS)}")
    TABLES[sys.argv[1]](sys.argv[2], scenes)
