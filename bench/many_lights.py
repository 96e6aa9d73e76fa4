#!/usr/bin/env python3
"""Writes a field with a million little triangles, of which so many are lights:

  many_lights.py LIGHTS FOLDER

FOLDER/scene.pbrt is the scene. The geometry is the same for any number of lights, and so is the power of all of them
together. The triangles hang 3 m to 8 m above the ground, 200 m x 200 m, at random, a few centimetres long and turned to
all sides. A part of the lights is much brighter than the others.
"""
import array
import os
import random
import sys

TRIANGLES, FIELD, POWER = 1_000_000, 200.0, 100_000.0
BRIGHTNESS = (1.0, 3.0, 10.0, 30.0)  # relative radiance, of as many groups of lights


def unit(rng):
    while True:
        v = [rng.uniform(-1, 1) for _ in range(3)]
        l2 = sum(x * x for x in v)
        if 0.01 < l2 <= 1:
            return [x / l2**0.5 for x in v]


def triangle(rng):
    """Nine coordinates."""
    c = (rng.uniform(-FIELD / 2, FIELD / 2), rng.uniform(-FIELD / 2, FIELD / 2), rng.uniform(3, 8))
    size = rng.uniform(0.01, 0.04)
    return [x + size * d for _ in range(3) for x, d in zip(c, unit(rng))]


def area(t):
    a, b = [t[3 + i] - t[i] for i in range(3)], [t[6 + i] - t[i] for i in range(3)]
    n = (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
    return 0.5 * sum(x * x for x in n) ** 0.5


def write_ply(path, triangles):
    with open(path, "wb") as f:
        f.write(f"ply\nformat binary_little_endian 1.0\nelement vertex {3 * len(triangles)}\nproperty float x\n"
                f"property float y\nproperty float z\nelement face {len(triangles)}\n"
                "property list uchar int vertex_indices\nend_header\n".encode())
        for t in triangles:
            f.write(array.array("f", t).tobytes())
        for i in range(len(triangles)):
            f.write(b"\x03" + array.array("i", (3 * i, 3 * i + 1, 3 * i + 2)).tobytes())


def write(lights, folder):
    os.makedirs(folder, exist_ok=True)
    rng = random.Random(1)
    groups, dark, weighted = [[] for _ in BRIGHTNESS], [], 0.0
    for i in range(TRIANGLES):
        t = triangle(rng)
        if i * lights // TRIANGLES == (i - 1) * lights // TRIANGLES and i > 0:
            dark.append(t)
            continue
        group = (0, 0, 0, 1, 0, 0, 2, 0, 1, 3)[i * lights // TRIANGLES % 10]
        groups[group].append(t)
        weighted += area(t) * BRIGHTNESS[group]
    scale = POWER / (3.14159265 * weighted)
    text = ['LookAt 0 -9 2.8  0 0 -0.8  0 0 1', 'Camera "perspective" "float fov" 38',
            'Film "rgb" "integer xresolution" 160 "integer yresolution" 90 "string filename" "many-lights.exr"',
            'Integrator "path" "integer maxdepth" 1', 'WorldBegin',
            'Material "diffuse" "rgb reflectance" [0.6 0.6 0.6]',
            f'Shape "trianglemesh" "point3 P" [{-FIELD} {-FIELD} 0  {FIELD} {-FIELD} 0  {FIELD} {FIELD} 0  {-FIELD} {FIELD} 0]'
            ' "integer indices" [0 1 2 0 2 3]']
    for i in range(12):
        text.append(f'AttributeBegin Translate {-8 + 1.5 * i} {-4 + 5 * (i % 5)} 0.7 Shape "sphere" "float radius" 0.7 '
                    'AttributeEnd')
    for name, triangles in [("dark", dark)] + [(f"lights-{g}", t) for g, t in enumerate(groups)]:
        if not triangles:
            continue
        write_ply(f"{folder}/{name}.ply", triangles)
        emits = ""
        if name != "dark":
            radiance = scale * BRIGHTNESS[int(name[-1])]
            emits = f'AreaLightSource "diffuse" "rgb L" [{radiance} {radiance} {radiance}] '
        text.append(f'AttributeBegin {emits}Shape "plymesh" "string filename" "{name}.ply" AttributeEnd')
    with open(f"{folder}/scene.pbrt", "w") as f:
        f.write("\n".join(text) + "\n")


def main():
    if len(sys.argv) != 3 or not sys.argv[1].isdigit() or not 1 <= int(sys.argv[1]) <= TRIANGLES:
        print(f"many_lights.py LIGHTS FOLDER: lights from 1 to {TRIANGLES}, and a folder", file=sys.stderr)
        sys.exit(2)
    write(int(sys.argv[1]), sys.argv[2])


if __name__ == "__main__":
    main()
