#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Measures and draws what a frame of shadow volumes costs by silhouette edges and by penumbra pixels.

    docs/measure-volumes.py build/penumbra

Cost is what `penumbra bench` says of a view at rest: process CPU time on a software driver. Edges are those of a torus over
a ground, more and more finely divided, under a square light 4 m above it; penumbra pixels those of the scene "primitives"
under larger and larger lights. Writes docs/pictures/volumes-cost-*.svg and prints the numbers.
"""
import sys
import tempfile

import measuring
from measuring import cost_ms, penumbra_pixels, plot, torus, write_light, write_torus

LIGHT = (0, 4, 0)
LARGE = "480x270"
METHODS = {"soft-volumes: layers": ("soft-volumes", {}),
           "soft-volumes: wedges, as published": ("soft-volumes", {"method": "wedges"}),
           "hard-volumes": ("hard-volumes", {})}


def silhouette_edges(around):
    """Edges of the torus of which the light's centre sees one face from its front and one from its back."""
    positions, indices = torus(around)
    faces_front = {}
    for i in range(0, len(indices), 3):
        a, b, c = (positions[k] for k in indices[i:i + 3])
        u, v, w = ([q[k] - a[k] for k in range(3)] for q in (b, c, LIGHT))
        normal = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
        front = sum(n * d for n, d in zip(normal, w)) > 0
        for k in range(3):
            edge = frozenset((indices[i + k], indices[i + (k + 1) % 3]))
            faces_front.setdefault(edge, []).append(front)
    return sum(len(set(front)) == 2 for front in faces_front.values())


def main():
    by_edges = {name: [] for name in METHODS}
    by_pixels = {name: [] for name in METHODS}
    with tempfile.TemporaryDirectory() as folder:
        light = ["--lights", write_light(folder, 0.5)]
        for around in (16, 32, 64, 128, 256):
            file, _ = write_torus(folder, around)
            for name, (technique, parameters) in METHODS.items():
                by_edges[name].append((silhouette_edges(around), cost_ms(technique, file, options=light, **parameters)))
        plot("volumes-cost-edges", "silhouette edges", "CPU time, ms", by_edges)

        for width_m in (0.05, 0.1, 0.2, 0.5, 1, 2):
            light = ["--lights", write_light(folder, width_m)]
            pixels = penumbra_pixels("primitives", LARGE, light)
            for name, (technique, parameters) in METHODS.items():
                by_pixels[name].append((pixels, cost_ms(technique, size=LARGE, options=light, **parameters)))
        plot("volumes-cost-penumbra", "penumbra pixels (lights of 0.05 m to 2 m)", "CPU time, ms", by_pixels)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    measuring.penumbra = sys.argv[1]
    main()
