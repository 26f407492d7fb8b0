#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes a GLB whose first primitive two joints bend and a morph target stretches.

    bend.py IN.glb OUT.glb

Positions of the input are floats, tightly packed, as `lightwell export` writes them. The upper joint turns what lies above the middle by 0.6 radians about
the z axis; the morph target, at weight 1, doubles the length of the lowest 30 percent along x.
"""
import array
import json
import math
import struct
import sys

GLB, JSON, BIN = 0x46546C67, 0x4E4F534A, 0x4E4942


def read_glb(path):
    with open(path, "rb") as file:
        data = file.read()
    length = struct.unpack("<I", data[12:16])[0]
    return json.loads(data[20:20 + length]), bytearray(data[28 + length:])


def write_glb(path, document, data):
    data += b"\0" * (-len(data) % 4)
    document["buffers"][0]["byteLength"] = len(data)
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    with open(path, "wb") as file:
        file.write(struct.pack("<5I", GLB, 2, 28 + len(text) + len(data), len(text), JSON) + text)
        file.write(struct.pack("<2I", len(data), BIN) + data)


def bend(document, data):
    primitive = document["meshes"][0]["primitives"][0]
    accessor = document["accessors"][primitive["attributes"]["POSITION"]]
    view = document["bufferViews"][accessor["bufferView"]]
    start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
    places = array.array("f", bytes(data[start:start + 12 * accessor["count"]]))
    low, high = accessor["min"], accessor["max"]
    size = [h - l for l, h in zip(low, high)]

    def add(values, component, kind, **more):
        data.extend(b"\0" * (-len(data) % 4))
        document["bufferViews"].append({"buffer": 0, "byteOffset": len(data), "byteLength": len(values.tobytes())})
        data.extend(values.tobytes())
        document["accessors"].append({"bufferView": len(document["bufferViews"]) - 1, "componentType": component,
                                      "count": accessor["count"], "type": kind, **more})
        return len(document["accessors"]) - 1

    joints, weights, moves = array.array("B"), array.array("f"), array.array("f")
    for i in range(accessor["count"]):
        x, y = ((places[3 * i + k] - low[k]) / size[k] for k in (0, 1))
        upper = min(1, max(0, 4 * (y - 0.4)))
        joints.extend((0, 1, 0, 0))
        weights.extend((1 - upper, upper, 0, 0))
        moves.extend((min(0, x - 0.3) * size[0], 0, 0))
    primitive["attributes"]["JOINTS_0"] = add(joints, 5121, "VEC4")
    primitive["attributes"]["WEIGHTS_0"] = add(weights, 5126, "VEC4")
    least = min(moves[::3])
    primitive["targets"] = [{"POSITION": add(moves, 5126, "VEC3", min=[least, 0, 0], max=[0, 0, 0])}]
    document["meshes"][0]["weights"] = [1]

    first = len(document["nodes"])
    x, y, z = ((l + h) / 2 for l, h in zip(low, high))
    cosine, sine = math.cos(0.6), math.sin(0.6)
    document["nodes"] += [{}, {"rotation": [0, 0, math.sin(0.3), math.cos(0.3)],
                               "translation": [x - cosine * x + sine * y, y - sine * x - cosine * y, 0]}]
    document["skins"] = [{"joints": [first, first + 1]}]
    for node in document["nodes"]:
        if "mesh" in node:
            node["skin"] = 0
    document["scenes"][0]["nodes"] += [first, first + 1]


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    document, data = read_glb(sys.argv[1])
    bend(document, data)
    write_glb(sys.argv[2], document, data)
