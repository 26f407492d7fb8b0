#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""many_parts.py KIND COUNT FILE: scenes of very many parts, as exports and scripts make them.

KIND  spread      COUNT boxes side by side, a primitive and a node each, of one material
      coincident  the same boxes all in one place
      materials   boxes side by side with a material each
      instances   COUNT instances side by side of one mesh of a million triangles
      obj         an OBJ of one triangle and its own material each, with FILE.mtl beside it
"""
import json
import math
import os
import struct
import sys

CORNERS = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
FACES = [(0, 2, 1), (1, 2, 3), (4, 5, 6), (5, 7, 6), (0, 1, 4), (1, 5, 4), (2, 6, 3), (3, 6, 7), (0, 4, 2), (2, 4, 6), (1, 3, 5), (3, 7, 5)]


def place(number, count):
    side = math.ceil(math.sqrt(count))
    return 2 * (number % side), 2 * (number // side)


class Glb:
    """A GLB whose primitives each have accessors and bytes of their own."""

    def __init__(self):
        self.bin = bytearray()
        self.json = {'asset': {'version': '2.0'}, 'accessors': [], 'bufferViews': [], 'meshes': [], 'nodes': [], 'materials': []}

    def accessor(self, data, component, kind, count, **more):
        self.json['bufferViews'].append({'buffer': 0, 'byteOffset': len(self.bin), 'byteLength': len(data)})
        self.bin += data
        self.json['accessors'].append({'bufferView': len(self.json['bufferViews']) - 1, 'componentType': component, 'type': kind, 'count': count, **more})
        return len(self.json['accessors']) - 1

    def mesh(self, corners, faces, material):
        """Returns the number of its node."""
        box = {'min': [min(p[i] for p in corners) for i in range(3)], 'max': [max(p[i] for p in corners) for i in range(3)]}
        positions = self.accessor(b''.join(struct.pack('<3f', *p) for p in corners), 5126, 'VEC3', len(corners), **box)
        indices = self.accessor(b''.join(struct.pack('<3I', *f) for f in faces), 5125, 'SCALAR', 3 * len(faces))
        self.json['meshes'].append({'primitives': [{'attributes': {'POSITION': positions}, 'indices': indices, 'material': material}]})
        self.json['nodes'].append({'mesh': len(self.json['meshes']) - 1})

    def write(self, file):
        self.json['buffers'] = [{'byteLength': len(self.bin)}]
        self.json['scenes'] = [{'nodes': list(range(len(self.json['nodes'])))}]
        text = json.dumps(self.json).encode()
        text += b' ' * (-len(text) % 4)
        self.bin += b'\0' * (-len(self.bin) % 4)
        with open(file, 'wb') as out:
            out.write(struct.pack('<4sII', b'glTF', 2, 28 + len(text) + len(self.bin)))
            out.write(struct.pack('<I4s', len(text), b'JSON') + text)
            out.write(struct.pack('<I4s', len(self.bin), b'BIN\0') + self.bin)


def write_boxes(count, file, coincident, own_materials):
    glb = Glb()
    for number in range(count):
        x, z = (0, 0) if coincident else place(number, count)
        if own_materials or number == 0:
            shade = (number + 1) / (count + 1)
            glb.json['materials'].append({'name': str(number), 'pbrMetallicRoughness': {'baseColorFactor': [shade, shade, shade, 1], 'metallicFactor': 0}})
        glb.mesh([(x + a, b, z + c) for a, b, c in CORNERS], FACES, number if own_materials else 0)
    glb.json['materials'].append({'name': 'lamp', 'emissiveFactor': [1, 1, 1]})
    glb.mesh([(0, 3, 0), (1, 3, 0), (0, 3, 1)], [(0, 1, 2)], len(glb.json['materials']) - 1)
    glb.write(file)


def write_instances(count, file):
    cells = 708  # on each side: 1,002,528 triangles
    height = lambda x, z: 0.15 * math.sin(9 * x) * math.cos(7 * z) + 0.02 * math.sin(90 * x * z)
    steps = [i / cells - 0.5 for i in range(cells + 1)]
    faces = []
    for i in range(cells):
        for j in range(cells):
            a, b = i * (cells + 1) + j, (i + 1) * (cells + 1) + j
            faces += [(a, a + 1, b), (b, a + 1, b + 1)]
    glb = Glb()
    glb.json['materials'].append({'pbrMetallicRoughness': {'metallicFactor': 0}})
    glb.mesh([(x, height(x, z), z) for x in steps for z in steps], faces, 0)
    glb.json['nodes'] = [{'mesh': 0, 'translation': [x, 0, z]} for x, z in (place(number, count) for number in range(count))]
    glb.write(file)


def write_obj(count, file):
    materials = os.path.splitext(file)[0] + '.mtl'
    with open(materials, 'w') as out:
        for number in range(count):
            shade = (number + 1) / (count + 1)
            out.write(f'newmtl m{number}\nKd {shade:.7f} {shade:.7f} {shade:.7f}\n')
            if number == 0:
                out.write('Ke 1 1 1\n')
    with open(file, 'w') as out:
        out.write(f'mtllib {os.path.basename(materials)}\n')
        for number in range(count):
            x, z = place(number, count)
            out.write(f'v {x} 0 {z}\nv {x + 1} 0 {z}\nv {x} 0 {z + 1}\nusemtl m{number}\nf -3 -1 -2\n')


if len(sys.argv) != 4 or sys.argv[1] not in ('spread', 'coincident', 'materials', 'instances', 'obj'):
    sys.exit(__doc__)
kind, count, file = sys.argv[1], int(sys.argv[2]), sys.argv[3]
if kind == 'obj':
    write_obj(count, file)
elif kind == 'instances':
    write_instances(count, file)
else:
    write_boxes(count, file, kind == 'coincident', kind == 'materials')
