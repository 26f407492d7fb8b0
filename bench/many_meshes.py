#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""many_meshes.py FILE.glb [COUNT]: a scene of so many meshes (2,000), bumpy sheets of 400 vertices each of its own, in ten materials."""
import json
import random
import struct
import sys

SIDE = 20  # vertices
ROW = 45  # meshes
GAP = 1.2
MATERIALS = 10
UNSIGNED_SHORT, FLOAT = 5123, 5126


def chunk(kind, data, padding):
    data += padding * (-len(data) % 4)
    return struct.pack("<I4s", len(data), kind) + data


class Writer:
    def __init__(self):
        self.bin, self.views, self.accessors = bytearray(), [], []

    def add(self, form, numbers, **accessor):
        data = struct.pack(f"<{len(numbers)}{form}", *numbers)
        self.views.append({"buffer": 0, "byteOffset": len(self.bin), "byteLength": len(data)})
        self.bin += data + bytes(-len(data) % 4)
        self.accessors.append({"bufferView": len(self.views) - 1, **accessor})
        return len(self.accessors) - 1

    def faces(self):
        corners = []
        for j in range(SIDE - 1):
            for i in range(SIDE - 1):
                a = j * SIDE + i
                corners += [a, a + 1, a + SIDE + 1, a, a + SIDE + 1, a + SIDE]
        return self.add("H", corners, componentType=UNSIGNED_SHORT, type="SCALAR", count=len(corners))

    def sheet(self):
        last = SIDE - 1
        places = [(i / last, random.uniform(0, 0.1), j / last) for j in range(SIDE) for i in range(SIDE)]
        numbers = [number for place in places for number in place]
        return self.add("f", numbers, componentType=FLOAT, type="VEC3", count=len(places), min=[0, 0, 0], max=[1, 0.1, 1])


def main(path, count=2000):
    random.seed(1)
    writer = Writer()
    faces = writer.faces()
    count = int(count)
    meshes = [{"name": f"mesh {m}", "primitives": [{"attributes": {"POSITION": writer.sheet()}, "indices": faces, "material": m % MATERIALS}]}
              for m in range(count)]
    nodes = [{"name": f"node {m}", "mesh": m, "translation": [m % ROW * GAP, 0, m // ROW * GAP]} for m in range(count)]
    materials = [{"pbrMetallicRoughness": {"baseColorFactor": [m / MATERIALS, 0.5, 0.5, 1]}} for m in range(MATERIALS)]
    gltf = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": list(range(count))}], "nodes": nodes, "meshes": meshes,
            "materials": materials, "accessors": writer.accessors, "bufferViews": writer.views, "buffers": [{"byteLength": len(writer.bin)}]}
    body = chunk(b"JSON", json.dumps(gltf).encode(), b" ") + chunk(b"BIN\0", bytes(writer.bin), b"\0")
    with open(path, "wb") as file:
        file.write(struct.pack("<4sII", b"glTF", 2, 12 + len(body)) + body)


if __name__ == "__main__":
    main(*sys.argv[1:])
