#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""records.py LIGHTWELL SCRATCH SCENE...
Bakes each scene of the truth with a regular grid of 32 nodes, once for each record. Prints a row for each: bytes of the light
for a valid node, and by how much the irradiance at the truth's points of free space and surfaces differs from that of the same
grid in floats, root mean square in percent of the mean."""
import json
import math
import subprocess
import sys

lightwell, scratch, scenes = sys.argv[1], sys.argv[2], sys.argv[3:]
records = ["floats", "moments", "shared-exponent", "direction-colour", "direction-magnitude"]


def run(*arguments):
    return subprocess.run([lightwell, *arguments], check=True, capture_output=True, text=True).stdout


def irradiance(pack, scene):
    found = []
    for points in ("free", "surf"):
        file = scene.replace(".glb", f".{points}.indirect.csv")
        rows = run("probe", pack, "--points", file, "--integrator", "ivg", "--quiet").split("\n")[1:]
        found += [float(x) for row in rows if row for x in row.split(",")[6:9]]
    return found


print("| scene | record | bytes a valid node | added error % |")
print("|---|---|---|---|")
for scene in scenes:
    pack, exact = f"{scratch}/records.lw.glb", None
    for record in records:
        figures = json.loads(run("bake", scene, "--grid", "32", "--record", record, "-o", pack, "--quiet", "--json"))
        found = irradiance(pack, scene)
        exact = exact or found
        mean = sum(exact) / len(exact)
        error = math.sqrt(sum((a - b) ** 2 for a, b in zip(found, exact)) / len(exact)) / mean
        valid = figures["nodes"] - figures["invalid_nodes"]
        name = scene.rsplit("/", 1)[-1].rsplit(".", 1)[0]
        print(f"| {name} | {record} | {figures['bytes']['light'] / valid:.2f} | {100 * error:.2f} |", flush=True)
