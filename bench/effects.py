#!/usr/bin/env python3
"""The tables of effects.md: effects.py effects|yardstick|truth PROGRAM. Called by effects.sh, which sets LIMIT, LIMIT_VECTORS, SCENES."""
import csv
import json
import math
import os
import re
import statistics
import subprocess
import sys
import tempfile

from common import CENTRE, camera, fail, machine, scene_path

SIZE = os.environ.get("SIZE", "640x480")
ONLY = os.environ.get("ONLY", "").split()  # scenes of the first table; none: all
ROUNDS = 2  # of fbvh, which the goals are for; the others take their turn in the first
YARDSTICK_ROUNDS = 5
REPEAT = 5  # of which the first two may wait for a compiler
REPEAT_SLOW = 3  # of frames of many seconds
METHODS = ("list", "tile", "fbvh", "bvh")  # what finds the first hit; the tree of every ray after it is bvh's own, else the fitted one
MIRROR = "--mirror 0.5 --reflections"
# name: options ("LIGHT" is the scene's light), what its cost is over, the most it may be; all costs are in frames of plain casting by fbvh
EFFECTS = {
    "cast": ("", None, None),
    "hard shadows": ("LIGHT --shadows", "cast", 0.35),
    "+ 1 reflection": (f"LIGHT --shadows {MIRROR} 1", "hard shadows", 1.0),
    "+ 3 reflections": (f"LIGHT --shadows {MIRROR} 3", "hard shadows", None),
    "64 occlusion rays": ("--occlusion 64", "cast", None),
    "Fresnel": ("--index 1.333 --reflections 1 --environment sky", "cast", None),
}
SLOW = "64 occlusion rays"
SLOW_METHODS = ("tile", "fbvh", "bvh")
PAPER = ["cast", "hard shadows", "+ 1 reflection", "+ 3 reflections"]
# scene: its frames, and what the paper's shadows and first reflection cost over its casting
SCENES = {"molecule:10000": (PAPER + [SLOW], ("0.26", "0.49")), "tornado:4000": (PAPER, ("0.16", "0.51")),
          "tornado:128000": (PAPER, ("", "")), "pool:10000": (PAPER + ["Fresnel"], ("", ""))}
SHARE_LEAST = 0.6  # of the hits that cast a shadow ray
OURS = ("list", "tile", "fbvh")  # beside the yardstick
YARDSTICK = {"S1k": "S1_1k", "S10k": "S1_10k", "S100k": "S1_100k", "D10k": "S2_10k", "D100k": "S2_100k"}
MOST_OVER_YARDSTICK = 1.2
TRUTH_SIZE = os.environ.get("TRUTH_SIZE", "160x120")
# Scenes to hold against the truth; None: the view and light of the first table.
DAM = {"input": os.path.abspath("examples/dam.06500.lammpstrj.gz"), "field": {"kernel": "poly2", "iso": 0.35, "radius": 2.2},
       "camera": {"eye": [112, -14, 66], "look_at": [12, 43, 25], "up": [0, 0, 1], "fov": 40}, "light": {"direction": [1, -1, 2]}}
TRUTHS = {"molecule:10000": None, "tornado:4000": None, "pool:10000": None, "scattered:10000": None, "dam break": DAM}


def run(command):
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode:
        fail(f"{' '.join(command)}: {done.stderr.strip()}")
    return done.stdout


def draw(program, scene, method, options, repeat=REPEAT):
    """The statistics of a frame that stands still, drawn again and again."""
    with tempfile.TemporaryDirectory() as folder:
        stats = os.path.join(folder, "stats.json")
        run([program, "render", scene, "-o", os.path.join(folder, "image.png"), "--size", SIZE, "--method", method, "--repeat", str(repeat),
             "--stats", stats, *options])
        with open(stats, encoding="utf-8") as file:
            return json.load(file)


def total(stats):
    return stats["repeat"]["median"]["ms"]["total"]


def view(program, scene):
    """An eye that sees the box of the effective spheres whole, and a light 50 degrees off its axis, to the right and above."""
    number = r"([-+\d.e]+) to ([-+\d.e]+)"
    said = re.search(r"effective spheres: x " + ", . ".join([number] * 3), run([program, "info", scene]))
    ends = [float(text) for text in said.groups()]
    centre = [(ends[k] + ends[k + 1]) / 2 for k in (0, 2, 4)]
    away = 1.1 * math.dist(ends[0::2], ends[1::2])
    turn = math.radians(50)
    light = [math.sin(turn) * math.sqrt(0.5), math.sin(turn) * math.sqrt(0.5), math.cos(turn)]
    eye = [centre[0], centre[1], centre[2] + away]
    return (["--eye", ",".join(map(str, eye)), "--look-at", ",".join(map(str, centre))], "--light " + ",".join(map(str, light)))


def methods_of(name, turn):
    if turn > 0:
        return () if name == SLOW else ("fbvh",)
    return SLOW_METHODS if name == SLOW else METHODS


def frames_of(program, scene):
    """Milliseconds a method and frame, rays beyond the first hits a hit, and the renderer."""
    where, light = view(program, scene)
    times, rays, renderer = {}, {}, ""
    for turn in range(ROUNDS):
        for name in SCENES[scene][0]:
            for method in methods_of(name, turn):
                options = where + EFFECTS[name][0].replace("LIGHT", light).split()
                stats = draw(program, scene, method, options, REPEAT_SLOW if name == SLOW else REPEAT)
                times.setdefault((method, name), []).append(total(stats))
                rays[name] = stats["counts"]["effects_rays"] / stats["counts"]["pixels_hit"]
                renderer = stats["renderer"]
    return {key: statistics.median(ms) for key, ms in times.items()}, rays, renderer


def verdict(value, most):
    return f"{most:.2f}: {'reached' if value <= most else 'missed'}" if most else ""


def print_effects(program):
    """Tables 1 and 2 of the paper: frames a second, and what each effect costs in frames of plain casting by fbvh."""
    rows, renderer = [], ""
    for scene in ONLY or SCENES:
        names, published = SCENES[scene]
        ms, rays, renderer = frames_of(program, scene)
        unit = ms["fbvh", "cast"]
        for name in names:
            _, before, most = EFFECTS[name]
            cells = [f"{ms[m, name]:.0f} ({1e3 / ms[m, name]:.2f})" if (m, name) in ms else "" for m in METHODS]
            cost = {m: (ms[m, name] - ms[m, before]) / unit for m in METHODS if (m, name) in ms} if before else {}
            goal = verdict(cost["fbvh"], most) if before and scene in ("molecule:10000", "tornado:4000") else ""
            paper = dict(zip(PAPER[1:3], published)).get(name, "")
            share = f"{rays[name]:.2f}" if before else ""
            if name == "hard shadows":
                share += " of at least " + f"{SHARE_LEAST}: {'reached' if rays[name] >= SHARE_LEAST else 'missed'}"
            rows.append([f"`{scene}`", name, *cells, *(f"{cost[m]:.2f}" if m in cost else "" for m in METHODS), goal, paper, share])
    print(f"{renderer}; {SIZE}, `poly3`, frames that stand still, in turn: medians of {REPEAT} frames ({SLOW}: of {REPEAT_SLOW}), of `fbvh` "
          f"of {ROUNDS} rounds of them: milliseconds (frames a second). A cost is over the frame without the effect, of reflections over "
          "that with shadows, in frames of plain casting by `fbvh`; the goal is for `fbvh`.\n")
    print("| scene | frame | " + " | ".join(f"`{m}`" for m in METHODS) + " | " + " | ".join(f"cost, `{m}`" for m in METHODS) +
          " | at most | published | rays a hit |\n|-|-|" + "-|" * (2 * len(METHODS) + 3))
    for row in rows:
        print("| " + " | ".join(row) + " |")


def limit_ms(path, kind, mode):
    """The yardstick's tracing, its tree built."""
    said = run([os.environ["LIMIT"], path, "1", *(str(v) for v in CENTRE[kind]), "3", "0.2", *SIZE.split("x"), mode, "5"])
    return float(re.search(r"trace med=([\d.]+)ms", said).group(1))


def yardstick_times(program, name, file):
    """Medians of a scene's frames, {mode: {"yardstick" or method: milliseconds}}, all in turn, and the renderer."""
    kind, path = name[0], scene_path(file)
    x, y, z = CENTRE[kind]
    light = ["--light", f"point:{x + 2},{y + 3},{z + 2}", "--shadows"]
    times, renderer = {}, ""
    for _ in range(YARDSTICK_ROUNDS):
        for mode, options in (("primary", []), ("shadow", light), ("mirror", [*light, *f"{MIRROR} 1".split()])):
            taken = times.setdefault(mode, {m: [] for m in ("yardstick", *OURS)})
            taken["yardstick"].append(limit_ms(path, kind, mode))
            for method in OURS:
                stats = draw(program, path, method, ["--kernel", "poly3", "--iso", "0.2", *camera(kind), *options])
                taken[method].append(total(stats))
                renderer = stats["renderer"]
    return {mode: {m: statistics.median(ms) for m, ms in taken.items()} for mode, taken in times.items()}, renderer


def print_yardstick(program):
    """Hard shadows of a point light, and a mirror with them, in turn with the yardstick's."""
    rows, renderer = [], ""
    for name, file in YARDSTICK.items():
        ms, renderer = yardstick_times(program, name, file)
        for mode, before in (("primary", None), ("shadow", "primary"), ("mirror", "shadow")):
            best = min(ms[mode][m] for m in OURS) / ms[mode]["yardstick"]
            cost = [f"{(ms[mode][m] - ms[before][m]) / ms['primary'][m]:.2f}" if before else "" for m in ("yardstick", "fbvh")]
            told = "" if not before else "reached" if best <= MOST_OVER_YARDSTICK else "missed"
            rows.append([name, "cast" if mode == "primary" else mode, *(f"{v:.1f}" for v in ms[mode].values()), f"{best:.2f}", told, *cost])
    print(f"{machine(renderer)}; {SIZE}, milliseconds of frames that stand still (the yardstick: tracing alone), medians of {YARDSTICK_ROUNDS} "
          "rounds. A cost is over the frame above, in frames of one's own casting.\n")
    print("| scene | frame | yardstick | " + " | ".join(f"`{m}`" for m in OURS) + f" | least / yardstick | at most {MOST_OVER_YARDSTICK} | "
          "cost, yardstick | cost, `fbvh` |\n|-|-|-|" + "-|" * (len(OURS) + 4))
    for row in rows:
        print("| " + " | ".join(row) + " |")


def scene_of(program, name):
    where, light = view(program, name)
    numbers = [[float(v) for v in text.split(",")] for text in (where[1], where[3], light.split()[1])]
    return {"input": name, "camera": {"eye": numbers[0], "look_at": numbers[1]}, "light": {"direction": numbers[2]}}


def truth_of(program, scene):
    """The rows of `compare`: shadows and one reflection by every method, against the certified tracer."""
    with tempfile.TemporaryDirectory() as folder:
        file = os.path.join(folder, "scene.json")
        with open(file, "w", encoding="utf-8") as out:
            json.dump({**scene, "effects": {"shadows": True, "mirror": 0.5, "reflections": 1}}, out)
        runs = ",".join(f"{method}:exact" for method in METHODS)
        run([program, "compare", file, "--runs", runs, "--size", TRUTH_SIZE, "-o", os.path.join(folder, "out")])
        with open(os.path.join(folder, "out", "results.csv"), encoding="utf-8", newline="") as table:
            return list(csv.DictReader(table))


def print_truth(program):
    """Pixels whose shadow or reflection is wrong, apart from undecided ones."""
    wrong = 0
    print(f"{TRUTH_SIZE}, shadows and one reflection; pixels whose terms are not those of `--method reference`, apart from undecided "
          "ones.\n")
    print("| scene | method | compared | shadow wrong | reflection wrong | undecided |\n|-|-|-|-|-|-|")
    for name, scene in TRUTHS.items():
        for row in truth_of(program, scene or scene_of(program, name)):
            wrong += int(row["shadow_wrong"]) + int(row["mirror_wrong"])
            print("| " + " | ".join([name, f"`{row['method']}`", row["effects_compared"], row["shadow_wrong"], row["mirror_wrong"],
                                     row["effects_undecided"]]) + " |", flush=True)
    print(f"\n{wrong} pixels are wrong.")


TABLES = {"effects": print_effects, "yardstick": print_yardstick, "truth": print_truth}

if __name__ == "__main__":
    if len(sys.argv) != 3 or sys.argv[1] not in TABLES:
        fail(f"expected {', '.join(TABLES)}, and the program")
    TABLES[sys.argv[1]](sys.argv[2])
