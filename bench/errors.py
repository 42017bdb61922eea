"""The tables of errors.md from folders of meniscus compare: errors.py FOLDER..."""
import json
import pathlib
import sys

COLUMNS = ["run", "ms", "least", "most", "missed", "invented", "wrong root", "undecided", "t median", "p99", "p99.9", "max",
           "RMS", "footprints p99", "residual p99", "normal p99, degrees", "PSNR, dB", "front"]


def figure(value, form="{:.1e}"):
    return "-" if value is None else form.format(value)


def row(run):
    ms, e = run["ms"], run["errors"]
    cells = [run["name"]] + [f"{ms[key]:.1f}" for key in ("median", "min", "max")]
    cells += [str(e[key]) for key in ("missed_decided", "invented_decided", "wrong_root", "undecided")]
    cells += [figure(e["t"][key]) for key in ("median", "p99", "p999", "max", "rms")]
    cells += [figure(e["footprint"]["p99"]), figure(e["residual"]["p99"]), figure(e["normal"]["p99"], "{:.2g}"),
              figure(e["psnr"], "{:.1f}"), "yes" if run["pareto"] else ""]
    return cells


def table(results):
    truth, view, machine = results["truth"], results["view"], results["machine"]
    print(f"`{results['command']}`\n")
    print(f"{results['input']['count']} balls, `{results['input']['kernel']}`, L = {results['input']['iso']:g}; "
          f"{view['width']}x{view['height']}; {truth['hits']} pixels hit, {truth['undecided']} undecided in the truth, which "
          f"took {truth['ms'] / 1000:.1f} s; medians of {results['runs'][0]['frames']} moving frames, milliseconds. "
          f"{results['renderer']}; {machine['cores']} processors.\n")
    for cells in [COLUMNS, ["-"] * len(COLUMNS)] + [row(run) for run in results["runs"]]:
        print("| " + " | ".join(cells) + " |")


for folder in map(pathlib.Path, sys.argv[1:]):
    document = json.loads((folder / "results.json").read_text())
    document["command"] = document["command"].replace(str(folder), folder.name)
    print(f"### {folder.name}\n\n![error against time](errors/{folder.name}.svg)\n")
    table(document)
    print()
