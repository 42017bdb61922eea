#!/usr/bin/env python3
"""The stiff suite's results as Markdown tables: bench/stiff.py FOLDER/results.json"""
import json
import sys

VERDICTS = ("holds", "fails", "outside", "refused")


def milliseconds(run):
    return "" if run["ms"] is None else f"{run['ms']:.3g} ms"


def cell(run):
    if run["verdict"] == "refused":
        return "refused"
    words = [run["verdict"], milliseconds(run)]
    words += [f"{run[key]} {text}" for key, text in
              (("missed", "missed"), ("invented", "invented"), ("wrong_root", "wrong root"), ("undecided", "undecided"))
              if run[key]]
    return ", ".join(word for word in words if word)


def summary(cases, names):
    print("| run | " + " | ".join(f"{where}: {verdict}" for where in ("inside", "beyond") for verdict in VERDICTS
                                    if (where, verdict) not in (("inside", "outside"), ("inside", "refused"), ("beyond", "fails"))) + " |")
    print("|-|-|-|-|-|-|")
    for name in names:
        count = {(inside, verdict): 0 for inside in (True, False) for verdict in VERDICTS}
        for one in cases:
            run = next(run for run in one["runs"] if run["name"] == name)
            count[one["inside"], run["verdict"]] += 1
        figures = [count[True, "holds"], count[True, "fails"], count[False, "holds"], count[False, "outside"], count[False, "refused"]]
        print(f"| {name} | " + " | ".join(map(str, figures)) + " |")


def table(cases, names):
    print("| case | why | " + " | ".join(names) + " |")
    print("|-|-|" + "-|" * len(names))
    for one in cases:
        beyond = f" (beyond: {', '.join(one['limits'])})" if one["limits"] else ""
        runs = {run["name"]: run for run in one["runs"]}
        print(f"| {one['name']}{beyond} | {one['why']} | " + " | ".join(cell(runs[name]) for name in names) + " |")


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        results = json.load(file)
    cases = results["suite"]["cases"]
    names = [run["name"] for run in cases[0]["runs"]]
    command = results["command"].split(" -o ")[0] + " -o FOLDER"
    print(f"`{command}`, {results['renderer']}, {results['machine']['cpu']}, {results['machine']['cores']} processors; "
          f"{len(cases)} cases.\n")
    summary(cases, names)
    print()
    table(cases, names)


main()
