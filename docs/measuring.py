# SPDX-License-Identifier: Apache-2.0
"""What the measuring scripts beside this file share: questions to `penumbra`, scenes to measure, plots."""
import base64
import json
import math
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

PICTURES = Path(__file__).parent / "pictures"
SIZE = "320x180"

penumbra = ""  # the command; whoever imports this says where it is


def ask(*arguments):
    done = subprocess.run([penumbra, "-q", *map(str, arguments)], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(done.stderr)
    return json.loads(done.stdout)


def settings(**values):
    return [word for key, value in values.items() for word in ("--set", f"{key}={value}")]


def cost_ms(technique, scene="primitives", size=SIZE, options=(), **values):
    """Of one render, all lights together."""
    results = ask("bench", scene, "-t", technique, "--size", size, "--rounds", 3, "--still", "--json", *options,
                  *settings(**values))["results"]
    return next(r["ms"]["median"] for r in results if r["technique"] == technique)


def penumbra_pixels(scene, size, options=()):
    with tempfile.TemporaryDirectory() as folder:
        result = ask("render", scene, "-t", "exact", "--size", size, "-o", f"{folder}/x.png", "--json", *options)
    return result["lights"][0]["statistics"]["counts"]["penumbra pixels"]


def torus(around):
    """A torus of around * around triangles, 0.8 m over a ground: its corners, and three indices a triangle."""
    across = around // 2
    positions = []
    for i in range(around):
        for j in range(across):
            u, v = 2 * math.pi * i / around, 2 * math.pi * j / across
            r = 0.7 + 0.25 * math.cos(v)
            positions.append((r * math.cos(u), 0.8 + 0.25 * math.sin(v), r * math.sin(u)))
    indices = []
    for i in range(around):
        for j in range(across):
            a, b = i * across + j, i * across + (j + 1) % across
            c, d = (i + 1) % around * across + j, (i + 1) % around * across + (j + 1) % across
            indices += [a, b, c, c, b, d]
    return positions, indices


def write_torus(folder, around):
    """A torus over a ground, as glTF. Returns its file and how many triangles both have."""
    positions, indices = torus(around)
    first = len(positions)
    positions += [(-4, 0, -4), (-4, 0, 4), (4, 0, -4), (4, 0, 4)]
    indices += [first, first + 1, first + 2, first + 2, first + 1, first + 3]
    data = b"".join(struct.pack("<3f", *p) for p in positions)
    begin = len(data)
    data += struct.pack(f"<{len(indices)}I", *indices)
    low, high = [[f(p[k] for p in positions) for k in range(3)] for f in (min, max)]
    gltf = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": len(positions), "type": "VEC3", "min": low, "max": high},
                      {"bufferView": 1, "componentType": 5125, "count": len(indices), "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteLength": begin}, {"buffer": 0, "byteOffset": begin, "byteLength": len(data) - begin}],
        "buffers": [{"byteLength": len(data), "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}]}
    file = Path(folder) / f"torus{around}.gltf"
    file.write_text(json.dumps(gltf))
    return file, len(indices) // 3


def write_light(folder, width_m):
    file = Path(folder) / f"light{width_m}.json"
    file.write_text(json.dumps({"version": 1, "lights": [
        {"name": "key", "type": "RectLight", "width": width_m, "height": width_m, "intensity": 1000,
         "translation": [0, 4, 0], "rotation": [-0.7071068, 0, 0, 0.7071068]}]}))
    return file


def plot(name, x_title, y_title, curves):
    """Writes NAME.svg. curves: {legend: [(x, y)]}; both axes logarithmic."""
    width, height, left, bottom, right, top = 560, 340, 70, 52, 20, 18
    values = [p for points in curves.values() for p in points]

    def axis(k, low_px, high_px):
        low, high = min(p[k] for p in values) / 1.2, max(p[k] for p in values) * 1.2
        ticks = [m * 10.0 ** e for e in range(-6, 9) for m in (1, 2, 5) if low <= m * 10.0 ** e <= high]
        place = lambda value: low_px + (high_px - low_px) * math.log(value / low) / math.log(high / low)
        return place, ticks

    x, x_ticks = axis(0, left, width - right)
    y, y_ticks = axis(1, height - bottom, top)
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" font-family="sans-serif" font-size="12">',
             f'<rect width="{width}" height="{height}" fill="white"/>']
    for tick in x_ticks:
        parts.append(f'<path d="M{x(tick):.1f} {top}V{height - bottom}" stroke="#ddd"/>'
                     f'<text x="{x(tick):.1f}" y="{height - bottom + 16}" text-anchor="middle">{tick:,g}</text>')
    for tick in y_ticks:
        parts.append(f'<path d="M{left} {y(tick):.1f}H{width - right}" stroke="#ddd"/>'
                     f'<text x="{left - 6}" y="{y(tick) + 4:.1f}" text-anchor="end">{tick:,g}</text>')
    parts.append(f'<text x="{(left + width - right) / 2}" y="{height - 12}" text-anchor="middle">{x_title}</text>')
    parts.append(f'<text transform="translate(16 {(top + height - bottom) / 2}) rotate(-90)" text-anchor="middle">{y_title}</text>')
    for k, (legend, points) in enumerate(curves.items()):
        color = ("#c0392b", "#2c5fa8", "#3a8a3a")[k]
        line = " ".join(f"{x(a):.1f},{y(b):.1f}" for a, b in points)
        parts.append(f'<polyline points="{line}" fill="none" stroke="{color}" stroke-width="2"/>')
        parts += [f'<circle cx="{x(a):.1f}" cy="{y(b):.1f}" r="3.5" fill="{color}"/>' for a, b in points]
        grows = points[-1][1] > points[0][1]  # then the upper left is free, else the upper right
        anchor, legend_x = ("start", left + 10) if grows else ("end", width - right - 10)
        parts.append(f'<text x="{legend_x}" y="{top + 16 + 16 * k}" text-anchor="{anchor}" fill="{color}">{legend}</text>')
    (PICTURES / f"{name}.svg").write_text("\n".join(parts + ["</svg>", ""]))
    for legend, points in curves.items():
        print(f"{name}, {legend}: " + "  ".join(f"({a:,.6g}: {b:,.4g})" for a, b in points), flush=True)
