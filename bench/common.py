"""What the scripts of the tables share: views, drawing by the program, the yardstick's times.

Their shell scripts set LIMIT, LIMIT_VECTORS and SCENES (bench/yardstick.sh)."""
import json
import os
import re
import subprocess
import sys
import tempfile

REPEAT = 7
CENTRE = {"S": (0.5, 0.5, 0.5), "D": (1.0, 0.25, 0.5)}


def fail(text):
    sys.exit(os.path.basename(sys.argv[0]) + ": " + text)


def camera(kind):
    """The yardstick's view: the eye at centre + (0, 0.6, 2.2), looking at the centre."""
    x, y, z = CENTRE[kind]
    return ["--eye", f"{x},{y + 0.6},{z + 2.2}", "--look-at", f"{x},{y},{z}"]


def scene_path(file):
    return os.path.join(os.environ["SCENES"], file + ".csv")


def draw(program, scene, size, method, options, repeat=REPEAT):
    """Medians of the phases over `repeat` moving frames, and the rest of the statistics, of one process."""
    with tempfile.TemporaryDirectory() as folder:
        stats = os.path.join(folder, "stats.json")
        command = [program, "render", scene, "-o", os.path.join(folder, "image.png"), "--method", method, "--size",
                   size, "--repeat", str(repeat), "--moving", "--stats", stats, *options]
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode:
            fail(f"{' '.join(command)}: {done.stderr.strip()}")
        with open(stats, encoding="utf-8") as file:
            return json.load(file)


def median_ms(stats):
    """Milliseconds of the phases and of the total; 0 for what did not run."""
    return {name: ms or 0.0 for name, ms in stats["repeat"]["median"]["ms"].items()}


def yardstick_ms(path, kind, size):
    """The yardstick's build + trace."""
    command = [os.environ["LIMIT"], path, "1", *(str(v) for v in CENTRE[kind]), "3", "0.2", *size.split("x"), "primary",
               "5"]
    said = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    build, trace = re.search(r"build=([\d.]+)ms trace med=([\d.]+)ms", said).groups()
    return float(build) + float(trace)


def machine(renderer):
    return f"{renderer}, {os.cpu_count()} processors; the yardstick with {os.environ['LIMIT_VECTORS']}"
