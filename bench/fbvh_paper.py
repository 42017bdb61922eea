#!/usr/bin/env python3
"""Gourmel et al.'s tables 1, 4, 5 and figure 7 again, and the list against the FBVH: fbvh_paper.py paper|against|moving PROGRAM.
Called by fbvh.sh."""
import json
import math
import os
import re
import statistics
import subprocess
import sys
import tempfile

from common import fail

SIZE = "640x480"
STATIONS = 2  # frames of a moving field, places of the eye around one that stands still
SCENES = ["scattered:30000", "scattered:100000", "tornado:4000", "tornado:128000", "examples/1tii.pdb", "pool:10000"]
MOVING = ("tornado", "pool")
SEQUENCES, SEQUENCE = ["tornado:4000", "tornado:128000", "pool:10000", "pool:100000"], 7  # and how many frames
PUBLISHED = {"scattered:30000": 9.4 / 7.4, "scattered:100000": 4.3 / 3.3, "tornado:4000": 11 / 4.6, "tornado:128000": 2.4 / 1.0,
             "examples/1tii.pdb": 17.7 / 5.8, "pool:10000": 7.1 / 1.9}
# what is compared, of the scene that the paper tells it of: without it, with it, and their ratio there
SWITCHES = [("n2 over n", "pool:10000", "cost-n", "", 7.1 / 5.1),
            ("fitting", "pool:10000", "no-fit,no-tight,no-discard", "no-tight,no-discard", 6.5 / 3.2),
            ("fitting", "examples/1tii.pdb", "no-fit,no-tight,no-discard", "no-tight,no-discard", 14.6 / 12.7),
            ("tighter boxes", "pool:10000", "no-tight,no-discard", "no-discard", 6.7 / 6.5),
            ("tighter boxes", "examples/1tii.pdb", "no-tight,no-discard", "no-discard", 15.3 / 14.6),
            ("discarding", "pool:10000", "no-tight,no-discard", "no-tight", 6.8 / 6.5),
            ("discarding", "examples/1tii.pdb", "no-tight,no-discard", "no-tight", 16.7 / 14.6),
            ("both", "pool:10000", "no-tight,no-discard", "", 7.1 / 6.5),
            ("both", "examples/1tii.pdb", "no-tight,no-discard", "", 17.7 / 14.6)]


def table(heads, rows):
    print("| " + " | ".join(heads) + " |\n|" + "-|" * len(heads))
    for row in rows:
        print("| " + " | ".join(row) + " |")
    print(flush=True)


def run(command, most=0):
    """What a command says; `most`: the highest exit status that is no failure."""
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode > most:
        fail(f"{' '.join(command)}: {done.stderr.strip()}")
    return done.stdout


def frames(program, scene, options):
    """The statistics of each frame drawn in one process; of the second draw of it where it is drawn more than once."""
    with tempfile.TemporaryDirectory() as folder:
        stats = os.path.join(folder, "stats.json")
        run([program, "render", *scene, "--stats", stats, "--size", SIZE, *options])
        with open(stats, encoding="utf-8") as file:
            document = json.load(file)
        return document.get("frames") or [document]


def places(program, scene):
    """Eyes around the box of the effective spheres, far enough to see it whole, and its middle."""
    number = r"([-+\d.e]+) to ([-+\d.e]+)"
    said = re.search(r"effective spheres: x " + ", . ".join([number] * 3), run([program, "info", scene]))
    ends = [float(text) for text in said.groups()]
    centre = [(ends[k] + ends[k + 1]) / 2 for k in (0, 2, 4)]
    size = math.dist(ends[0::2], ends[1::2])
    for i in range(STATIONS):
        turn = 2 * math.pi * i / STATIONS
        eye = [centre[0] + size * math.sin(turn) * 1.1, centre[1] + 0.4 * size, centre[2] + size * math.cos(turn) * 1.1]
        yield ["--eye", ",".join(map(str, eye)), "--look-at", ",".join(map(str, centre))]


def stations(program, scene, options):
    """Statistics of every station: of a moving field its frames, the next one's tree built ahead; else places of the eye."""
    if scene.split(":")[0] in MOVING:
        return frames(program, [f"{scene}:1:{STATIONS}"], ["--frame", f"0:{STATIONS - 1}", "--repeat", "3", *options])
    return [frames(program, [scene], ["--repeat", "3", *place, *options])[0] for place in places(program, scene)]


def rate(stats):
    """Frames a second by the traversal alone: what the paper tells, its construction being hidden."""
    return [1e3 / s["repeat"]["median"]["ms"]["trace"] for s in stats]


def rates(program, scene, options):
    return rate(stations(program, scene, options))


def print_first(program):
    """Table 1."""
    rows = []
    for scene in SCENES:
        for solver in ("secant", "exact"):
            mean = {}
            for method in ("bvh", "fbvh"):
                stats = stations(program, scene, ["--method", method, "--solver", solver])
                fps = rate(stats)
                mean[method] = statistics.mean(fps)
                build = statistics.median(s["tree"]["build_ms"] for s in stats)
                ratio = [f"{mean['fbvh'] / mean['bvh']:.2f}", f"{PUBLISHED[scene]:.2f}"] if method == "fbvh" else ["", ""]
                rows.append([f"`{scene}`", f"`{method}:{solver}`", f"{build:.1f}", f"{min(fps):.2f}", f"{max(fps):.2f}",
                             f"{mean[method]:.2f}", *ratio])
    table(["scene", "run", "build, ms", "frames/s, least", "most", "mean", "FBVH over BVH", "published"], rows)


def print_switches(program):
    """Tables 4 and 5, and the cost n^2 of section 6."""
    known, rows = {}, []
    for solver in ("secant", "exact"):
        for name, scene, without, given, published in SWITCHES:
            mean = []
            for tree in (without, given):
                key = (solver, scene, tree)
                if key not in known:
                    options = ["--method", "fbvh", "--solver", solver] + (["--tree", tree] if tree else [])
                    known[key] = statistics.mean(rates(program, scene, options))
                mean.append(known[key])
            rows.append([name, f"`{scene}`", f"`{solver}`", f"{mean[0]:.2f}", f"{mean[1]:.2f}", f"{mean[1] / mean[0]:.2f}",
                         f"{published:.2f}"])
    table(["what", "scene", "solver", "frames/s without", "with", "ratio", "published"], rows)


def compared(program, scene):
    """meniscus compare's results of the list, tiles and the FBVH."""
    with tempfile.TemporaryDirectory() as folder:
        run([program, "compare", scene, "--size", SIZE, "--runs", "list:exact,tile:exact,fbvh:exact", "--frames", "5", "-o", folder])
        with open(os.path.join(folder, "results.json"), encoding="utf-8") as file:
            return json.load(file)["runs"]


def agreement(program, scene):
    """The list's and the FBVH's pictures pixel by pixel, in compare's words."""
    with tempfile.TemporaryDirectory() as folder:
        names = [os.path.join(folder, method + ".exr") for method in ("list", "fbvh")]
        for method, name in zip(("list", "fbvh"), names):
            run([program, "render", scene, "--size", SIZE, "--method", method, "-o", name])
        return re.sub(r"^\S+: ", "", run([program, "compare", *names], most=1).strip().splitlines()[-1])


def print_compared(program):
    """A/B on every scene: a moving frame's phases, errors against the truth, agreement with one another."""
    rows, said = [], []
    for scene in SCENES:
        for result in compared(program, scene):
            phases = ", ".join(f"{name} {ms:.1f}" for name, ms in result["ms"]["phases"].items() if ms and ms >= 0.05)
            e = result["errors"]
            wrong = e["missed_decided"] + e["invented_decided"] + e["wrong_root"]
            rows.append([f"`{scene}`", f"`{result['name']}`", f"{result['ms']['median']:.1f}", phases, str(wrong), str(e["undecided"]),
                         f"{e['t']['p99']:.1e}"])
        said.append(f"- `{scene}`: {agreement(program, scene)}")
    table(["scene", "run", "moving frame, ms", "phases, ms", "wrong pixels", "undecided", "t p99"], rows)
    print("`fbvh` against `list`, pixel by pixel:\n\n" + "\n".join(said) + "\n", flush=True)


def print_wins(program):
    """Where each wins: as the count, the density, the frame and the movement change."""
    for method in ("list", "tile", "fbvh"):  # the driver keeps what it has compiled
        frames(program, ["scattered:1000"], ["--method", method, "--repeat", "3"])
    rows = []
    for kind in ("scattered", "dense"):
        for count in (1000, 10000, 100000, 1000000):
            for size in ("320x240", "1280x960"):
                cells = []
                for moving in ([], ["--moving"]):
                    ms = {}
                    for method in ("list", "tile", "fbvh"):
                        options = ["--method", method, "--repeat", "3", "--size", size, *moving]
                        ms[method] = frames(program, [f"{kind}:{count}"], options)[0]["repeat"]["median"]["ms"]["total"]
                    cells += [f"{ms[m]:.1f}" for m in ms] + [min(ms, key=ms.get)]
                rows.append([f"`{kind}:{count}`", size, *cells])
    heads = ["list", "tile", "fbvh", "least"]
    table(["scene", "size"] + [f"static {h}" for h in heads] + [f"moving {h}" for h in heads], rows)


def print_moving(program):
    """The paper's figure 7: frames one after another, each with its own build, and with the next one's tree built beside it."""
    rows, last = [], SEQUENCE - 1
    for scene in SEQUENCES:
        whole = f"{scene}:1:{SEQUENCE}"
        alone = [frames(program, [whole], ["--method", "fbvh", "--frame", str(i)])[0] for i in range(1, last)]
        beside = frames(program, [whole], ["--method", "fbvh", "--frame", f"0:{last}"])[1:last]  # none is built beside the last
        build = statistics.median(s["ms"]["build"] for s in alone)
        draw = statistics.median(s["ms"]["total"] - s["ms"]["build"] for s in alone)
        total = statistics.median(s["ms"]["total"] for s in beside)
        waits = statistics.median(s["ms"]["build"] for s in beside)
        rows.append([f"`{scene}`", f"{build:.1f}", f"{draw:.1f}", f"{build + draw:.1f}", f"{total:.1f}", f"{waits:.1f}",
                     f"{total / (build + draw):.2f}"])
    table(["scene", "build, ms", "draw, ms", "their sum", "total, the next built beside", "of it waiting for a tree", "ratio"],
          rows)


TABLES = {"paper": [print_first, print_switches], "against": [print_compared, print_wins], "moving": [print_moving]}

if __name__ == "__main__":
    if len(sys.argv) != 3 or sys.argv[1] not in TABLES:
        fail("expected paper, against or moving, and the program")
    for one in TABLES[sys.argv[1]]:
        one(sys.argv[2])
