#!/usr/bin/env python3
"""Writes a height field of about so many triangles as a binary glTF file: for measuring how times grow.

usage: bench/terrain.py TRIANGLES FILE.glb [SEED]

A square of n x n cells, two triangles each, 1000 units wide; the heights are a sum of octaves of value noise, so a
finer mesh shows the same hills with more detail. Needs numpy.
"""
import json
import math
import sys

import numpy


def noise(cells, octave, generator):
    """[cells + 1, cells + 1]: values on a lattice of 2**octave cells, smoothly between them."""
    lattice = generator.random((2**octave + 2, 2**octave + 2), dtype=numpy.float32)
    place = numpy.linspace(0, 2**octave, cells + 1, dtype=numpy.float64)
    index = place.astype(numpy.int64)
    part = (place - index).astype(numpy.float32)
    part = part * part * (3 - 2 * part)
    rows = lattice[index] * (1 - part)[:, None] + lattice[index + 1] * part[:, None]
    return rows[:, index] * (1 - part) + rows[:, index + 1] * part


def terrain(triangles, seed):
    """Positions [vertices, 3] and indices [triangles, 3]."""
    cells = max(1, math.isqrt(triangles // 2))
    generator = numpy.random.default_rng(seed)
    height = sum(noise(cells, octave, generator) * 200 / 2**octave for octave in range(2, 11))
    side = numpy.linspace(-500, 500, cells + 1, dtype=numpy.float32)
    x, z = numpy.meshgrid(side, side)
    positions = numpy.stack([x, height.astype(numpy.float32), z], axis=-1).reshape(-1, 3)
    corner = (numpy.arange(cells)[:, None] * (cells + 1) + numpy.arange(cells)).astype(numpy.uint32)
    below = corner + cells + 1
    faces = numpy.stack([corner, below, corner + 1, corner + 1, below, below + 1], axis=-1)
    return positions, faces.reshape(-1, 3)


def write_glb(file, positions, indices):
    """One mesh, one primitive."""
    vertices, corners = positions.astype("<f4").tobytes(), indices.astype("<u4").tobytes()
    views = [{"buffer": 0, "byteOffset": 0, "byteLength": len(vertices)},
             {"buffer": 0, "byteOffset": len(vertices), "byteLength": len(corners)}]
    accessors = [{"bufferView": 0, "componentType": 5126, "count": len(positions), "type": "VEC3",
                  "min": positions.min(axis=0).tolist(), "max": positions.max(axis=0).tolist()},
                 {"bufferView": 1, "componentType": 5125, "count": indices.size, "type": "SCALAR"}]
    head = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
            "buffers": [{"byteLength": len(vertices) + len(corners)}], "bufferViews": views,
            "accessors": accessors}
    text = json.dumps(head).encode()
    text += b" " * (-len(text) % 4)
    size = 12 + 8 + len(text) + 8 + len(vertices) + len(corners)
    with open(file, "wb") as out:
        out.write(b"glTF" + numpy.array([2, size, len(text)], "<u4").tobytes() + b"JSON" + text)
        out.write(numpy.array([len(vertices) + len(corners)], "<u4").tobytes() + b"BIN\0" + vertices + corners)


def main():
    if len(sys.argv) not in (3, 4) or not sys.argv[1].isdigit():
        sys.exit(__doc__)
    positions, indices = terrain(int(sys.argv[1]), int(sys.argv[3]) if len(sys.argv) == 4 else 1)
    write_glb(sys.argv[2], positions, indices)
    print(f"{len(indices)} triangles, {len(positions)} vertices")


main()
