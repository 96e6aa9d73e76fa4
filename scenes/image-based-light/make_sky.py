#!/usr/bin/env python3
"""Makes evening.hdr, the sky of this scene: python3 make_sky.py

A latitude-longitude image in linear light: row 0 is straight up (+z), columns go from +x towards +y. The sky is a
gradient between zenith and horizon that is warm on the sun's side, with thin clouds of noise on a plane above, and a
low sun behind haze, eighteen degrees wide, so that its shadows are soft and a small image can hold it.
"""
import math

WIDTH, HEIGHT = 360, 180
SUN_AZIMUTH, SUN_HEIGHT, SUN_RADIUS = math.radians(215), math.radians(21), math.radians(9)
SUN = (math.cos(SUN_HEIGHT) * math.cos(SUN_AZIMUTH), math.cos(SUN_HEIGHT) * math.sin(SUN_AZIMUTH), math.sin(SUN_HEIGHT))
SUN_RADIANCE = (78.0, 48.0, 24.0)


def mix(a, b, t):
    return tuple(x + (y - x) * t for x, y in zip(a, b))


def smooth(low, high, x):
    t = min(max((x - low) / (high - low), 0.0), 1.0)
    return t * t * (3.0 - 2.0 * t)


def lattice(x, y):
    """A fixed random number in [0, 1] for each pair of integers."""
    h = (x * 374761393 + y * 668265263) & 0xFFFFFFFF
    h = ((h ^ (h >> 13)) * 1274126177) & 0xFFFFFFFF
    return ((h ^ (h >> 16)) & 0xFFFF) / 65535.0


def noise(x, y):
    i, j = math.floor(x), math.floor(y)
    u, v = smooth(0, 1, x - i), smooth(0, 1, y - j)
    below = lattice(i, j) + (lattice(i + 1, j) - lattice(i, j)) * u
    above = lattice(i, j + 1) + (lattice(i + 1, j + 1) - lattice(i, j + 1)) * u
    return below + (above - below) * v


def clouds(d):
    """How much of the sky is covered in direction d, which points up."""
    x, y = 2.2 * d[0] / (d[2] + 0.16), 1.1 * d[1] / (d[2] + 0.16)
    sum_, weight = 0.0, 0.5
    for octave in range(5):
        sum_ += weight * noise(x + 31.0 * octave, y)
        x, y, weight = 2.03 * x, 2.03 * y, 0.5 * weight
    return smooth(0.5, 0.78, sum_)


def radiance(d):
    cosine = sum(a * b for a, b in zip(d, SUN))
    glow = max(cosine, 0.0)
    if d[2] < 0:  # ground, which the scene hides
        return (0.10, 0.09, 0.08)
    horizon = mix((0.42, 0.38, 0.52), (1.55, 0.80, 0.34), 0.5 + 0.5 * cosine)
    sky = mix(horizon, (0.10, 0.19, 0.42), d[2] ** 0.55)
    lit = mix((0.50, 0.42, 0.48), (2.6, 1.45, 0.75), glow**3)
    sky = mix(sky, lit, 0.75 * clouds(d) * smooth(0.02, 0.2, d[2]))
    sky = tuple(s + h * glow**24 for s, h in zip(sky, (1.6, 0.8, 0.3)))
    disc = 1.0 - smooth(SUN_RADIUS * 0.7, SUN_RADIUS, math.acos(min(cosine, 1.0)))
    return mix(sky, SUN_RADIANCE, disc)


def rgbe(colour):
    largest = max(colour)
    mantissa, exponent = math.frexp(largest)
    return bytes(int(c * mantissa * 256.0 / largest) for c in colour) + bytes([exponent + 128])


with open("evening.hdr", "wb") as out:
    out.write(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n" % (HEIGHT, WIDTH))
    for row in range(HEIGHT):
        theta = math.pi * (row + 0.5) / HEIGHT
        for column in range(WIDTH):
            phi = 2.0 * math.pi * (column + 0.5) / WIDTH
            direction = (math.sin(theta) * math.cos(phi), math.sin(theta) * math.sin(phi), math.cos(theta))
            out.write(rgbe(radiance(direction)))
