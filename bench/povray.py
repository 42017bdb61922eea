#!/usr/bin/env python3
"""The same scenes by POV-Ray's blob and by Meniscus: povray.py PROGRAM [METHOD...]. Called by povray.sh and by a test.

A blob's component of strength s and radius r is s (1 - d^2 / r^2)^2, which is the kernel poly2; its threshold is L. Lengths are a
thousand times those of a unit scene, for POV-Ray's solver works with lengths that do not shrink with the scene."""
import itertools
import math
import os
import random
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import zlib

from common import fail

WIDTH, HEIGHT, FOV, LEVEL = 320, 240, 45, 0.2
METHODS = ("reference", "list", "tile", "fbvh")
EYE, LOOK_AT = (1700.0, 1300.0, 2300.0), (500.0, 500.0, 500.0)
NEAR, FAR = 1000.0, 4500.0  # what distances POV-Ray's 16 bits a pixel tell
STEP = (FAR - NEAR) / 65535
# name: balls, least and greatest radius, share of balls of negative strength, light
SCENES = {"few": (40, 150, 350, 0, "0.4,0.8,0.5"),
          "many": (400, 60, 140, 0, "point:900,2400,1500"),
          "carved": (120, 120, 260, 0.3, "0.4,0.8,0.5")}


def balls_of(name):
    """x, y, z, radius, strength of each; decimals that both programs read alike."""
    count, least, most, negative, _ = SCENES[name]
    chance = random.Random(7)
    for _ in range(count):
        place = [round(chance.uniform(0, 1000), 3) for _ in range(3)]
        radius = round(chance.uniform(least, most), 3)
        yield (*place, radius, round(chance.uniform(0.5, 1.5), 3) * (-1 if chance.random() < negative else 1))


# ---- Files


def write_csv(path, balls):
    with open(path, "w", encoding="ascii") as file:
        file.write("x,y,z,r,q\n")
        file.writelines(",".join(map(repr, ball)) + "\n" for ball in balls)


def vector(values):
    return "<" + ",".join(map(repr, values)) + ">"


def light_of(text):
    if text.startswith("point:"):
        return f"light_source {{ <{text[6:]}> rgb 1 }}"
    way = [1e6 * float(part) for part in text.split(",")]
    return f"light_source {{ {vector(way)} rgb 1 parallel point_at <0,0,0> }}"


def write_scene(path, name, balls, what):
    """what: depth (the distance as emitted light), lit, or bare (lit, and nothing casts a shadow)."""
    across = 2 * math.degrees(math.atan(math.tan(math.radians(FOV) / 2) * WIDTH / HEIGHT))
    x, y, z = EYE
    distance = f"(sqrt(pow(x-{x},2)+pow(y-{y},2)+pow(z-{z},2))-{NEAR})/{FAR - NEAR}"
    texture = {"depth": f"pigment {{ function {{ {distance} }} color_map {{ [0 rgb 0] [1 rgb 1] }} }}"
                        " finish { emission 1 ambient 0 diffuse 0 }"}
    texture["lit"] = texture["bare"] = "pigment { rgb 1 } finish { ambient 0 diffuse 1 brilliance 1 }"
    with open(path, "w", encoding="ascii") as file:
        file.write("#version 3.7;\nglobal_settings { assumed_gamma 1.0 }\nbackground { rgb 0 }\n"
                   f"camera {{ perspective location {vector(EYE)} right -x*{WIDTH}/{HEIGHT} up y sky y angle {across!r} "
                   f"look_at {vector(LOOK_AT)} }}\n{light_of(SCENES[name][4])}\nblob {{ threshold {LEVEL}\n")
        file.writelines(f"sphere {{ {vector(ball[:3])}, {ball[3]!r}, {ball[4]!r} }}\n" for ball in balls)
        file.write(f"sturm texture {{ {texture[what]} }} {'no_shadow' if what == 'bare' else ''} }}\n")


def read_pnm(path):
    """The red of each pixel of a 16 bit PPM, from 0 to 65535."""
    with open(path, "rb") as file:
        data = file.read()
    head = re.match(rb"P6\s+(?:#[^\n]*\n\s*)*(\d+)\s+(\d+)\s+(\d+)\s", data)
    if not head or [int(word) for word in head.groups()] != [WIDTH, HEIGHT, 65535]:
        fail(f"{path}: expected a PPM of 16 bits, {WIDTH}x{HEIGHT}")
    return struct.unpack(f">{WIDTH * HEIGHT * 3}H", data[head.end():])[::3]


def unpredicted(data):
    """OpenEXR's ZIP: differences, the even bytes before the odd ones."""
    plain = bytes(itertools.accumulate(data, lambda a, b: (a + b - 128) & 255))
    half = (len(plain) + 1) // 2
    mixed = bytearray(len(plain))
    mixed[0::2], mixed[1::2] = plain[:half], plain[half:]
    return bytes(mixed)


def read_exr(path):
    """Float channels by name, rows from the top: of files of scan lines, not compressed or by ZIP."""
    with open(path, "rb") as file:
        data = file.read()
    at, attributes = 8, {}
    while data[at]:
        name, kind = data[at:].split(b"\0", 2)[:2]
        at += len(name) + len(kind) + 2
        size = struct.unpack_from("<i", data, at)[0]
        attributes[name.decode()] = data[at + 4:at + 4 + size]
        at += 4 + size
    names, channels = [], attributes["channels"]
    while channels[0]:
        name, _, rest = channels.partition(b"\0")
        if struct.unpack_from("<i", rest)[0] != 2:
            fail(f"{path}: channel {name.decode()} is not of floats")
        names.append(name.decode())
        channels = rest[16:]
    rows = {0: 1, 2: 1, 3: 16}.get(attributes["compression"][0])
    if not rows:
        fail(f"{path}: expected no compression or ZIP")
    planes = {name: [] for name in names}
    for offset in struct.unpack_from(f"<{(HEIGHT + rows - 1) // rows}Q", data, at + 1):
        _, size = struct.unpack_from("<ii", data, offset)
        block, lines = data[offset + 8:offset + 8 + size], min(rows, HEIGHT - len(planes[names[0]]) // WIDTH)
        whole = lines * len(names) * WIDTH * 4
        if size < whole:
            block = unpredicted(zlib.decompress(block))
        values = struct.unpack(f"<{whole // 4}f", block)
        for line in range(lines):
            for k, name in enumerate(names):
                first = (line * len(names) + k) * WIDTH
                planes[name] += values[first:first + WIDTH]
    return planes


# ---- Runs


def povray(folder, name, balls, what):
    scene, image = (os.path.join(folder, f"{name}-{what}.{end}") for end in ("pov", "ppm"))
    write_scene(scene, name, balls, what)
    command = ["povray", f"+I{scene}", f"+O{image}", f"+W{WIDTH}", f"+H{HEIGHT}", "+FP16", "-A", "-D", "-GA", "File_Gamma=1.0"]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode:
        fail(f"{' '.join(command)}: {done.stderr.strip().splitlines()[-1]}")
    return read_pnm(image)


def meniscus(program, folder, name, method):
    image = os.path.join(folder, f"{name}-{method}.exr")
    command = [program, "render", os.path.join(folder, name + ".csv"), "--kernel", "poly2", "--iso", str(LEVEL), "--size",
               f"{WIDTH}x{HEIGHT}", "--fov", str(FOV), "--eye", ",".join(map(str, EYE)), "--look-at", ",".join(map(str, LOOK_AT)),
               "--light", SCENES[name][4], "--shadows", "--method", method, "--aov", image]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode:
        fail(f"{' '.join(command)}: {done.stderr.strip()}")
    return read_exr(image)


def compared(theirs, ours):
    """What differs: pixels that only one of them hits, distances (in steps of POV-Ray's 16 bits), shadows where light falls."""
    depth, lit, bare = theirs
    pixels = range(WIDTH * HEIGHT)
    hit = [math.isfinite(t) for t in ours["t"]]
    both = [i for i in pixels if hit[i] and depth[i]]
    steps = sorted(abs(NEAR + STEP * depth[i] - (ours["t"][i] + ours["t.lo"][i])) / STEP for i in both)
    facing = [i for i in both if bare[i] > 655]  # a hundredth of the light: the rest faces away, or nearly so
    wrong = sum((lit[i] > bare[i] / 2) != (ours["shadow"][i] > 0.5) for i in facing)
    dark = sum(lit[i] <= bare[i] / 2 for i in facing)
    return {"hits": sum(hit), "only ours": sum(hit[i] and not depth[i] for i in pixels),
            "only theirs": sum(bool(depth[i]) and not hit[i] for i in pixels),
            "median": steps[len(steps) // 2], "p99": steps[len(steps) * 99 // 100], "far": sum(step > 2 for step in steps),
            "lit or dark": len(facing), "dark": dark, "wrong": wrong}


def main():
    if len(sys.argv) < 2:
        fail("expected the program, and methods")
    if not shutil.which("povray"):
        print("povray.py: no povray here; Debian's package is povray", file=sys.stderr)
        sys.exit(77)
    worst = 0
    with tempfile.TemporaryDirectory() as folder:
        print("| scene | method | hits | only ours | only POV-Ray's | distance off, steps: median | p99 | by more than 2 "
              "| facing the light | in shadow | shadow differs |\n|" + "-|" * 11)
        for name in SCENES:
            balls = list(balls_of(name))
            write_csv(os.path.join(folder, name + ".csv"), balls)
            theirs = [povray(folder, name, balls, what) for what in ("depth", "lit", "bare")]
            for method in sys.argv[2:] or METHODS:
                c = compared(theirs, meniscus(sys.argv[1], folder, name, method))
                worst = max(worst, c["only ours"] + c["only theirs"], c["far"], c["wrong"])
                print(f"| `{name}` | `{method}` | {c['hits']} | {c['only ours']} | {c['only theirs']} | {c['median']:.2f} | "
                      f"{c['p99']:.2f} | {c['far']} | {c['lit or dark']} | {c['dark']} | {c['wrong']} |", flush=True)
    if worst > WIDTH * HEIGHT // 10000:
        fail(f"{worst} pixels differ: more than one in ten thousand")


if __name__ == "__main__":
    main()
