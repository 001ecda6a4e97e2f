#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Measures what docs/exact-visibility.md shows, and draws it.

    docs/measure-exact.py build/penumbra

Cost is what `penumbra bench` says of a view at rest: process CPU time on a software driver. Error is what `penumbra
compare` says, against 1,024 rays. The scene is "primitives" where nothing else is said. Writes docs/pictures/exact-*.svg
and prints the numbers.
"""
import math
import sys
import tempfile

import measuring
from measuring import PICTURES, SIZE, ask, cost_ms, penumbra_pixels, plot, settings, write_light, write_torus


def penumbra_rmse(technique, **values):
    result = ask("compare", "primitives", "-t", technique, "--size", SIZE, "--samples", 1024, "--json", *settings(**values))
    return result["results"][0]["penumbra_rmse"]


def draw_rows():
    """A triangle over the light's lattice, row by row: 64 points, as src/techniques/exact_visibility tilts them."""
    scale, middle, tilt, spacing = 150, 180, 0.6, 0.25
    across = (math.cos(tilt) * spacing, -math.sin(tilt) * spacing)  # from point to point of a row
    down = (-across[1], across[0])
    at = lambda i, j: ((i + 0.5) * across[0] + (j + 0.5) * down[0], (i + 0.5) * across[1] + (j + 0.5) * down[1])
    px = lambda p: f"{middle + scale * p[0]:.1f},{middle - scale * p[1]:.1f}"
    corners = [(-0.75, -0.55), (1.15, -0.1), (-0.1, 0.8)]
    parts = ['<svg xmlns="http://www.w3.org/2000/svg" width="360" height="360">', '<rect width="360" height="360" fill="white"/>',
             f'<rect x="{middle - scale}" y="{middle - scale}" width="{2 * scale}" height="{2 * scale}" fill="#fff6dd" stroke="#b8902a"/>',
             f'<polygon points="{" ".join(map(px, corners))}" fill="#2c5fa8" fill-opacity="0.25" stroke="#2c5fa8"/>']
    for j in range(-7, 7):
        ends = []
        for k in range(3):
            p, q = corners[k], corners[(k + 1) % 3]
            # Height above the row's line, in units of rows.
            hp, hq = ((c[0] * down[0] + c[1] * down[1]) / spacing**2 - j - 0.5 for c in (p, q))
            if (hp > 0) != (hq > 0):
                ends.append(tuple((p[i] * hq - q[i] * hp) / (hq - hp) for i in (0, 1)))
        along = lambda p: p[0] * across[0] + p[1] * across[1]
        ends.sort(key=along)
        if ends:
            parts.append(f'<polyline points="{px(ends[0])} {px(ends[1])}" stroke="#c0392b" stroke-width="1.5"/>')
            parts += [f'<circle cx="{px(e).split(",")[0]}" cy="{px(e).split(",")[1]}" r="2.5" fill="#c0392b"/>' for e in ends]
        for i in range(-7, 7):
            p = at(i, j)
            if max(map(abs, p)) < 1:
                hidden = bool(ends) and along(ends[0]) < along(p) < along(ends[1])
                x, y = px(p).split(",")
                parts.append(f'<circle cx="{x}" cy="{y}" r="4" fill="{"#222" if hidden else "white"}" stroke="#222"/>')
    (PICTURES / "exact-rows.svg").write_text("\n".join(parts + ["</svg>", ""]))


def main():
    draw_rows()
    with tempfile.TemporaryDirectory() as folder:
        light = ["--lights", write_light(folder, 1)]
        curves = {"exact": [], "hard": []}
        for around in (16, 32, 64, 128, 256, 512):
            file, triangles = write_torus(folder, around)
            for technique, points in curves.items():
                points.append((triangles, cost_ms(technique, file, options=light)))
        plot("exact-cost-triangles", "triangles of a torus over a ground", "CPU time, ms", curves)

        file, _ = write_torus(folder, 64)
        curves = {"exact": []}
        for width_m in (0.05, 0.1, 0.2, 0.5, 1, 2, 4):
            curves["exact"].append((width_m, cost_ms("exact", file, options=["--lights", write_light(folder, width_m)])))
        plot("exact-cost-light", "width of the light, m (4 m above the ground)", "CPU time, ms", curves)

    plot("exact-cost-samples", "samples", "CPU time, ms",
         {"exact": [(n, cost_ms("exact", samples=n)) for n in (16, 32, 64, 128, 256, 512, 1024)]})
    plot("exact-cost-penumbra", "penumbra pixels (pictures of 80 x 45 to 960 x 540)", "CPU time, ms",
         {"exact": [(penumbra_pixels("primitives", size), cost_ms("exact", size=size))
                    for size in ("80x45", "160x90", "320x180", "640x360", "960x540")]})
    plot("exact-error-cost", "CPU time, ms", "penumbra RMSE", {
        "exact, 16 to 1,024 samples": [(cost_ms("exact", samples=n), penumbra_rmse("exact", samples=n))
                                       for n in (16, 32, 64, 128, 256, 1024)],
        "Embree, 16 to 512 stratified rays": [
            (cost_ms("reference", samples=n, cache="false"), penumbra_rmse("reference", samples=n))
            for n in (16, 32, 64, 128, 256, 512)]})


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    measuring.penumbra = sys.argv[1]
    main()
