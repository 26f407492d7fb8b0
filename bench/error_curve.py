#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""error_curve.py LIGHTWELL SCENE FOLDER [options of the environment]

What the light of a scene errs by for its bytes: adaptive grids of several budgets, regular grids, and what has come of one
adaptive grid's stream. The path tracer says what is right at random points of the scene's own surfaces."""
import json
import math
import random
import struct
import subprocess
import sys

lightwell, scene, folder, *environment = sys.argv[1:]
POINTS, SAMPLES, SEED = 300, 1024, 11
# Of the scene's diagonal: how far off the surface a point lies.
OFF_SURFACE = 2e-4
# Of what a tenth of all points have at least: what is darker is buried.
LEAST_LIT = 0.01
pack, csv = f'{folder}/curve.lw.glb', f'{folder}/curve.csv'


def run(*arguments):
    return subprocess.run([lightwell, *arguments], check=True, capture_output=True, text=True).stdout


def bake(*options):
    return json.loads(run('bake', scene, '-o', pack, '--quiet', '--json', *options, *environment))


def triangles():
    """The finest triangles of a pack, from a binary PLY whose vertices begin with three floats."""
    ply = f'{folder}/curve.ply'
    run('export', pack, '-o', ply)
    data = open(ply, 'rb').read()
    body = data.index(b'end_header\n') + len('end_header\n')
    size = {'float': 4, 'uchar': 1, 'ushort': 2, 'uint': 4, 'int': 4}
    element, counts, stride = '', {}, 0
    for words in (line.split() for line in data[:body].decode().split('\n')):
        if words[:1] == ['element']:
            element = words[1]
            counts[element] = int(words[2])
        elif words[:1] == ['property'] and element == 'vertex':
            stride += size[words[1]]
    vertices = [struct.unpack_from('<3f', data, body + i * stride) for i in range(counts['vertex'])]
    body += counts['vertex'] * stride
    for i in range(counts['face']):
        yield [vertices[corner] for corner in struct.unpack_from('<3I', data, body + 13 * i + 1)]


def difference(a, b):
    return [x - y for x, y in zip(a, b)]


def normal_of(a, b, c):
    u, v = difference(b, a), difference(c, a)
    normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
    length = math.hypot(*normal)
    return length, [x / length for x in normal] if length else [0, 1, 0]


def write_points():
    faces = [(face, *normal_of(*face)) for face in triangles()]
    corners = [corner for face, _, _ in faces for corner in face]
    diagonal = math.dist([min(c[i] for c in corners) for i in range(3)], [max(c[i] for c in corners) for i in range(3)])
    random.seed(SEED)
    with open(csv, 'w') as file:
        file.write('x,y,z,nx,ny,nz\n')
        for (a, b, c), _, normal in random.choices(faces, [area for _, area, _ in faces], k=POINTS):
            u, v = random.random(), random.random()
            if u + v > 1:
                u, v = 1 - u, 1 - v
            point = [a[i] + (b[i] - a[i]) * u + (c[i] - a[i]) * v + normal[i] * OFF_SURFACE * diagonal for i in range(3)]
            file.write(','.join('%.9g' % x for x in (*point, *normal)) + '\n')


def probe(source, *options):
    rows = run('probe', source, '--points', csv, '--quiet', *options).strip().split('\n')[1:]
    return [[float(x) for x in row.split(',')[6:9]] for row in rows]


def truth():
    """All light but what lamps give directly."""
    path = ('--integrator', 'path', '--spp', str(SAMPLES), *environment)
    light = probe(scene, *path, '--quantity', 'indirect')
    if not environment:
        return light
    every = probe(scene, *path, '--quantity', 'direct')
    lamps = probe(scene, *path, '--quantity', 'direct', '--without-environment')
    return [[a + b - c for a, b, c in zip(*rows)] for rows in zip(light, every, lamps)]


def main():
    bake('--preview')
    write_points()
    right = truth()
    least = LEAST_LIT * sorted(sum(light) for light in right)[POINTS * 9 // 10]
    kept = [i for i in range(POINTS) if sum(right[i]) > least]
    mean = sum(sum(right[i]) for i in kept) / (3 * len(kept))

    def row(kind, size, *options):
        found = probe(pack, '--integrator', 'ivg', *options)
        squares = sum(math.dist(found[i], right[i]) ** 2 for i in kept) / (3 * len(kept))
        print(f'| {kind} | {size:,} | {100 * math.sqrt(squares) / mean:.1f} |', flush=True)

    print('| grid | bytes | root mean square, % |\n|---|---|---|')
    for nodes in (8, 12, 16, 24, 32, 48):
        row(f'regular, {nodes} nodes', bake('--grid', str(nodes))['bytes']['light'])
    for budget in ('8k', '16k', '32k', '64k', '128k', '256k'):
        row(f'adaptive, --budget {budget}', bake('--budget', budget)['bytes']['light'])
    whole = bake()['bytes']['light']
    for share in (0.05, 0.1, 0.25, 0.5, 0.75, 1):
        row(f'{share:.0%} of the nodes of the default', round(share * whole), '--light-level', str(share))


main()
