#!/usr/bin/env python3
"""Writes one of the scenes that ./dev bench generates, because they are too large to be kept:

  generate.py NAME FOLDER

FOLDER/scene.pbrt is the scene. The same name gives the same bytes every time. Names:

  triangles-1e6, triangles-1e7   a landscape of so many triangles
  triangles-ascii, triangles-pbrt   one of 2 10^6 triangles as text: an ascii PLY file, a trianglemesh
  instances-1e5                  so many instances of a ball of 1280 triangles
  lights-1e2 ... lights-1e6      so many of a million little triangles emit (many_lights.py)
  textures                       16 images of 2048 x 2048 pixels, 201 MB of them
"""
import array
import math
import os
import random
import struct
import sys
import zlib

import many_lights

SEED = 1


def head(look_at, fov, depth):
    return ['Film "rgb" "integer xresolution" 160 "integer yresolution" 90 "string filename" "bench.exr"',
            f'Integrator "path" "integer maxdepth" {depth}', look_at, f'Camera "perspective" "float fov" {fov}',
            'WorldBegin', 'LightSource "infinite" "rgb L" [0.4 0.5 0.7]',
            'LightSource "distant" "point3 from" [3 -2 4] "point3 to" [0 0 0] "rgb L" [2 1.8 1.5]',
            'Material "diffuse" "rgb reflectance" [0.6 0.6 0.6]']


def write_scene(folder, lines):
    with open(os.path.join(folder, "scene.pbrt"), "w", encoding="ascii") as f:
        f.write("\n".join(lines) + "\n")


def faces_record(indices):
    """The bytes of triangles in a PLY file: a count of one byte before every three indices."""
    count, raw = len(indices) // 3, indices.tobytes()
    record = bytearray(13 * count)
    record[0::13] = b"\x03" * count
    for k in range(12):
        record[1 + k::13] = raw[k::12]
    return record


def ply_header(vertices, triangles):
    return (f"ply\nformat binary_little_endian 1.0\nelement vertex {vertices}\nproperty float x\n"
            f"property float y\nproperty float z\nelement face {triangles}\n"
            "property list uchar int vertex_indices\nend_header\n").encode()


def landscape(triangles, folder):
    """A square of 2 m with hills and a little noise, of about so many triangles."""
    n = round(math.sqrt(triangles / 2))
    rng = random.Random(SEED)
    at = [2 * i / n - 1 for i in range(n + 1)]
    waves = [[0.1 * math.sin(3 * x + k) for x in at] for k in (0, 1)]
    with open(os.path.join(folder, "landscape.ply"), "wb") as f:
        f.write(ply_header((n + 1) ** 2, 2 * n * n))
        noise = rng.random
        for j, y in enumerate(at):
            rough, hill = 1.0 / n, 1 + 8 * waves[1][j]
            row = array.array("f", bytes(12 * (n + 1)))
            row[0::3] = array.array("f", at)
            row[1::3] = array.array("f", [y]) * (n + 1)
            row[2::3] = array.array("f", [hill * w + rough * noise() for w in waves[0]])
            f.write(row.tobytes())
        first = array.array("i")
        for i in range(n):
            first.extend((i, i + 1, i + n + 2, i, i + n + 2, i + n + 1))
        for j in range(n):
            f.write(faces_record(array.array("i", map((j * (n + 1)).__add__, first))))
    write_scene(folder, head("LookAt 0 -2 1.2  0 0 0  0 0 1", 45, 5) +
                ['Shape "plymesh" "string filename" "landscape.ply"'])


def landscape_rows(triangles):
    """The same kind of square for readers of text: rows of vertices, and of the indices of triangles."""
    n = round(math.sqrt(triangles / 2))
    rng = random.Random(SEED)
    at = [2 * i / n - 1 for i in range(n + 1)]
    wave = [0.1 * math.sin(3 * x) for x in at]
    vertices = (" ".join(f"{x:.7g} {y:.7g} {(1 + h) * w + rng.random() / n:.7g}\n" for x, w in zip(at, wave))
                for y, h in zip(at, wave))
    first = [(i, i + 1, i + n + 2, i, i + n + 2, i + n + 1) for i in range(n)]
    faces = ([tuple(k + j * (n + 1) for k in six) for six in first] for j in range(n))
    return n, vertices, faces


def landscape_ascii(triangles, folder):
    n, vertices, faces = landscape_rows(triangles)
    with open(os.path.join(folder, "landscape.ply"), "w", encoding="ascii") as f:
        f.write(ply_header((n + 1) ** 2, 2 * n * n).decode().replace("binary_little_endian", "ascii"))
        for row in vertices:
            f.write(row.replace("\n ", "\n"))
        for row in faces:
            f.write("".join("3 %d %d %d\n3 %d %d %d\n" % six for six in row))
    write_scene(folder, head("LookAt 0 -2 1.2  0 0 0  0 0 1", 45, 5) +
                ['Shape "plymesh" "string filename" "landscape.ply"'])


def landscape_pbrt(triangles, folder):
    _, vertices, faces = landscape_rows(triangles)
    write_scene(folder, head("LookAt 0 -2 1.2  0 0 0  0 0 1", 45, 5))
    with open(os.path.join(folder, "scene.pbrt"), "a", encoding="ascii") as f:
        f.write('Shape "trianglemesh" "point3 P" [\n')
        f.writelines(row.replace("\n ", "\n") for row in vertices)
        f.write('] "integer indices" [\n')
        for row in faces:
            f.write("".join("%d %d %d %d %d %d\n" % six for six in row))
        f.write("]\n")


def ball(levels):
    """Corners and triangles of a ball made of an icosahedron, each triangle cut into four so many times."""
    g = (1 + 5**0.5) / 2
    corners = [(-1, g, 0), (1, g, 0), (-1, -g, 0), (1, -g, 0), (0, -1, g), (0, 1, g), (0, -1, -g), (0, 1, -g),
               (g, 0, -1), (g, 0, 1), (-g, 0, -1), (-g, 0, 1)]
    faces = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4), (11, 10, 2), (10, 7, 6),
             (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10),
             (8, 6, 7), (9, 8, 1)]
    for _ in range(levels):
        middles, cut = {}, []

        def middle(a, b):
            key = (min(a, b), max(a, b))
            if key not in middles:
                middles[key] = len(corners)
                corners.append(tuple((x + y) / 2 for x, y in zip(corners[a], corners[b])))
            return middles[key]

        for a, b, c in faces:
            ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
            cut += [(a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca)]
        faces = cut
    return [tuple(x / math.hypot(*c) for x in c) for c in corners], faces


def instances(count, folder):
    corners, faces = ball(3)
    with open(os.path.join(folder, "ball.ply"), "wb") as f:
        f.write(ply_header(len(corners), len(faces)))
        f.write(array.array("f", [x for c in corners for x in c]).tobytes())
        f.write(faces_record(array.array("i", [i for t in faces for i in t])))
    rng = random.Random(SEED)
    lines = head("LookAt 0 -60 30  0 0 0  0 0 1", 45, 5)
    lines += ['ObjectBegin "ball" Shape "plymesh" "string filename" "ball.ply" ObjectEnd']
    for _ in range(count):
        x, y, z = rng.uniform(-40, 40), rng.uniform(-40, 40), rng.uniform(-8, 8)
        size, turn = rng.uniform(0.1, 0.4), rng.uniform(0, 360)
        lines.append(f'AttributeBegin Translate {x:.4f} {y:.4f} {z:.4f} Rotate {turn:.2f} 1 1 0 '
                     f'Scale {size:.4f} {size:.4f} {1.5 * size:.4f} ObjectInstance "ball" AttributeEnd')
    write_scene(folder, lines)


def png(size, rng):
    """An RGB image of noise, which no compression and no cache makes small."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    rows = b"".join(b"\0" + rng.randbytes(3 * size) for _ in range(size))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", size, size, 8, 2, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(rows, 0)) + chunk(b"IEND", b""))


def textures(folder):
    side, size, rng = 4, 2048, random.Random(SEED)
    lines = head("LookAt 0 -2 1.6  0 0 0  0 0 1", 45, 5)
    for i in range(side * side):
        with open(os.path.join(folder, f"noise-{i}.png"), "wb") as f:
            f.write(png(size, rng))
        x, y, s = 2 * (i % side) / side - 1, 2 * (i // side) / side - 1, 2 / side
        z = 0.1 * (i * 5 % 7)
        lines += [f'Texture "noise-{i}" "spectrum" "imagemap" "string filename" "noise-{i}.png"',
                  f'Material "diffuse" "texture reflectance" "noise-{i}"',
                  f'Shape "trianglemesh" "point3 P" [{x} {y} {z}  {x + s} {y} {z}  {x + s} {y + s} {z}  '
                  f'{x} {y + s} {z}] "point2 uv" [0 0  1 0  1 1  0 1] "integer indices" [0 1 2 0 2 3]']
    write_scene(folder, lines)


GENERATORS = {
    "triangles-1e6": lambda folder: landscape(10**6, folder),
    "triangles-1e7": lambda folder: landscape(10**7, folder),
    "triangles-ascii": lambda folder: landscape_ascii(2 * 10**6, folder),
    "triangles-pbrt": lambda folder: landscape_pbrt(2 * 10**6, folder),
    "instances-1e5": lambda folder: instances(10**5, folder),
    **{f"lights-1e{k}": lambda folder, k=k: many_lights.write(10**k, folder) for k in range(2, 7)},
    "textures": textures,
}


def main():
    arguments = sys.argv[1:]
    if arguments in (["-h"], ["--help"]):
        print(__doc__.strip())
        return 0
    if len(arguments) != 2 or arguments[0] not in GENERATORS:
        wrong = f"there is no scene '{arguments[0]}'" if len(arguments) == 2 else "a name and a folder are needed"
        print(f"generate.py: {wrong}; names are {', '.join(GENERATORS)}", file=sys.stderr)
        return 2
    try:
        os.makedirs(arguments[1], exist_ok=True)
        GENERATORS[arguments[0]](arguments[1])
    except OSError as e:
        print(f"generate.py: {e}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        return 130
    return 0


if __name__ == "__main__":
    sys.exit(main())
