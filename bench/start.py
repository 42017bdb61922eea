#!/usr/bin/env python3
"""From the command to the first image on disk, of a small scene: start.py PROGRAM. Called by start.sh.

The driver's own cache of shaders (Mesa's) and the programs that Meniscus keeps are each left out, cold or warm; every
method, the corners in turn."""
import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time

SCENE, SIZE, ROUNDS, MOST = "scattered:1000", "640x480", 5, 0.5
METHODS = ["auto", "list", "tile", "fbvh"]
# what is shown: Mesa's own cache, ours
CORNERS = [("none", "none"), ("none", "warm"), ("warm", "none"), ("warm", "warm")]


def run(program, method, mesa, ours, folder):
    """Seconds on the clock and of the processors."""
    environment = dict(os.environ, XDG_CACHE_HOME=folder, MESA_SHADER_CACHE_DIR=os.path.join(folder, "mesa"),
                       MESA_SHADER_CACHE_DISABLE="true" if mesa == "none" else "false")
    command = [program, "render", SCENE, "-o", os.path.join(folder, "image.png"), "--size", SIZE, "--method", method]
    if ours == "none":
        command.append("--no-cache")
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    start = time.monotonic()
    subprocess.run(command, env=environment, check=True, stdout=subprocess.DEVNULL)
    clock = time.monotonic() - start
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return clock, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main():
    program = os.path.abspath(sys.argv[1])
    print(f"{SCENE}, {SIZE}, seconds from the command to the PNG, median of {ROUNDS} runs in turn (processor time in "
          f"brackets); at most {MOST} with both caches warm.\n")
    print("| method | " + " | ".join(f"driver's {mesa}, ours {ours}" for mesa, ours in CORNERS) + " | reached |")
    print("|-|" + "-|" * (len(CORNERS) + 1))
    for method in METHODS:
        with tempfile.TemporaryDirectory() as folder:
            for corner in CORNERS:  # fills the caches
                run(program, method, *corner, folder)
            times = {corner: [] for corner in CORNERS}
            for _ in range(ROUNDS):
                for corner in CORNERS:
                    times[corner].append(run(program, method, *corner, folder))
        clock, used = ([statistics.median(t[k] for t in times[corner]) for corner in CORNERS] for k in (0, 1))
        cells = [f"{c:.2f} ({u:.2f})" for c, u in zip(clock, used)]
        print(f"| `{method}` | " + " | ".join(cells) + f" | {'yes' if clock[-1] <= MOST else 'no'} |")


if __name__ == "__main__":
    main()
