#!/usr/bin/env python3
"""The table of card.md: card.py PROGRAM draws still and moving frames by three methods. Called by card.sh."""
import json
import os
import subprocess
import sys
import tempfile

from common import fail

SIZE = os.environ.get("SIZE", "1024x768")
REPEAT = os.environ.get("REPEAT", "40")
SCENES = ("molecule:10000", "scattered:100000", "dense:100000")
METHODS = ("list", "tile", "fbvh")
PHASES = ("sort", "bin", "upload", "build", "core_depth", "gather", "cast", "trace", "shade")


def frame(program, scene, method, moving):
    """The renderer, and the median milliseconds of a frame's phases, of one process."""
    with tempfile.TemporaryDirectory() as folder:
        stats = os.path.join(folder, "stats.json")
        command = [program, "render", scene, "-o", os.path.join(folder, "image.png"), "--size", SIZE, "--method", method, "--repeat", REPEAT,
                   "--stats", stats, *(["--moving"] if moving else [])]
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode:
            fail(f"{' '.join(command)}: {done.stderr.strip()}")
        with open(stats, encoding="utf-8") as file:
            said = json.load(file)
    return said["renderer"], said["repeat"]["median"]["ms"]


def main():
    renderer, rows = "", []
    for scene in SCENES:
        for moving in (False, True):
            for method in METHODS:
                renderer, ms = frame(sys.argv[1], scene, method, moving)
                phases = ", ".join(f"{name} {ms[name]:.1f}" for name in PHASES if ms.get(name) and ms[name] >= 0.05)
                rows.append(f"| `{scene}` | {'moving' if moving else 'still'} | `{method}` | {ms['total']:.1f} | {phases} |")
    print(f"{renderer}; {SIZE}, medians of {REPEAT} frames, milliseconds.\n")
    print("| scene | frames | method | a frame | phases |\n|-|-|-|-|-|")
    print("\n".join(rows))


main()
