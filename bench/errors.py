"""The section "Errors against time" of errors.md from folders of meniscus compare: errors.py FILE.md FOLDER..."""
import json
import pathlib
import sys

HEADING = "## Errors against time"
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
    yield f"`{results['command']}`\n"
    yield (f"{results['input']['count']} balls, `{results['input']['kernel']}`, L = {results['input']['iso']:g}; "
           f"{view['width']}x{view['height']}; {truth['hits']} pixels hit, {truth['undecided']} undecided in the truth, which "
           f"took {truth['ms'] / 1000:.1f} s; medians of {results['runs'][0]['frames']} moving frames, milliseconds. "
           f"{results['renderer']}; {machine['cores']} processors.\n")
    for cells in [COLUMNS, ["-"] * len(COLUMNS)] + [row(run) for run in results["runs"]]:
        yield "| " + " | ".join(cells) + " |"


INTRODUCTION = """\
`bench/errors.sh` writes these tables and draws the charts; [docs/errors.md](../docs/errors.md) defines every figure. Pixels missed
and invented are the decided ones. The line on a chart is the Pareto front: no other run is both faster and nearer to the truth.
"""


def section(folders):
    lines = [HEADING + "\n", INTRODUCTION]
    for folder in folders:
        document = json.loads((folder / "results.json").read_text())
        document["command"] = document["command"].replace(str(folder), folder.name)
        lines += [f"### {folder.name}\n", f"![error against time](errors/{folder.name}.svg)\n", *table(document), ""]
    return "\n".join(lines)


def main():
    """Puts the section in the place of the file's own, or behind the rest."""
    path = pathlib.Path(sys.argv[1])
    new = section([pathlib.Path(name) for name in sys.argv[2:]])
    text = path.read_text()
    before, found, rest = text.partition(HEADING + "\n")
    behind = rest.find("\n## ") if found else -1
    path.write_text(before.rstrip("\n") + "\n\n" + new + (rest[behind:] if behind >= 0 else ""))


main()
