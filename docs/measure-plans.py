#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Measures what plans of lux cost, in a furnished hall of 100,000 triangles: 32 luminaires, and a day of suns, on 100 x 100
points, against frames of the same lights and against rays that err as little.

    docs/measure-plans.py build/penumbra                 # all; or: frame, plan, day, rays
    docs/measure-plans.py build/penumbra --scene FOLDER  # the hall alone, to be looked at
"""
import argparse
import json
import math
import struct
import sys
import tempfile
from pathlib import Path

import measuring

EXAMPLES = Path(__file__).parents[1] / "examples" / "office"
WIDTH, DEPTH, HEIGHT = 14.4, 9.6, 3.0  # metres, within the walls
WINDOW = (-6.6, 6.6, 0.9, 2.4)         # of the south wall (+Z): left, right, sill, head
PLANE = f"--plane={-WIDTH / 2},0.75,{-DEPTH / 2},{WIDTH},{DEPTH}"
SUN = "--sun=52.52,13.405,2026-03-20T12:00+01:00"
DAY = "08:00-18:00/15min"


def box(low, high, cells=1):
    """A box whose sides are cut into cells x cells quads: corners, and three indices a triangle."""
    positions, indices = [], []
    for axis in range(3):
        for side in (0, 1):
            u, v = ((axis + 1) % 3, (axis + 2) % 3) if side else ((axis + 2) % 3, (axis + 1) % 3)
            first = len(positions)
            for i in range(cells + 1):
                for j in range(cells + 1):
                    corner = [0.0] * 3
                    corner[axis] = (low, high)[side][axis]
                    corner[u] = low[u] + (high[u] - low[u]) * i / cells
                    corner[v] = low[v] + (high[v] - low[v]) * j / cells
                    positions.append(tuple(corner))
            for i in range(cells):
                for j in range(cells):
                    a = first + i * (cells + 1) + j
                    indices += [a, a + cells + 1, a + cells + 2, a, a + cells + 2, a + 1]
    return positions, indices


def ring(middle, around):
    """A chair's back and seat, as a torus of 0.5 m."""
    positions, indices = measuring.torus(around)
    return [tuple(m + 0.25 * p for m, p in zip(middle, point)) for point in positions], indices


def furniture():
    """(name, positions, indices)"""
    x, z, wall = WIDTH / 2, DEPTH / 2, 0.2
    left, right, sill, head = WINDOW
    for name, low, high in (
            ("floor", (-x - wall, -wall, -z - wall), (x + wall, 0, z + wall)),
            ("ceiling", (-x - wall, HEIGHT, -z - wall), (x + wall, HEIGHT + wall, z + wall)),
            ("west wall", (-x - wall, 0, -z), (-x, HEIGHT, z)), ("east wall", (x, 0, -z), (x + wall, HEIGHT, z)),
            ("north wall", (-x - wall, 0, -z - wall), (x + wall, HEIGHT, -z)),
            ("below the window", (-x - wall, 0, z), (x + wall, sill, z + wall)),
            ("above the window", (-x - wall, head, z), (x + wall, HEIGHT, z + wall)),
            ("left of the window", (-x - wall, sill, z), (left, head, z + wall)),
            ("right of the window", (right, sill, z), (x + wall, head, z + wall))):
        yield name, *box(low, high, 4)
    for row in range(4):
        for column in range(6):
            name, at_x, at_z = f"desk {6 * row + column + 1}", 2.3 * (column - 2.5), 2.2 * (row - 1.5)
            yield name, *box((at_x - 0.8, 0.7, at_z - 0.4), (at_x + 0.8, 0.74, at_z + 0.4), 6)
            for leg in range(4):
                leg_x, leg_z = at_x + (-0.75, 0.7)[leg & 1], at_z + (-0.35, 0.3)[leg >> 1]
                yield f"{name} leg {leg + 1}", *box((leg_x, 0, leg_z), (leg_x + 0.05, 0.7, leg_z + 0.05), 4)
            yield f"{name} screen", *box((at_x - 0.3, 0.84, at_z - 0.22), (at_x + 0.3, 1.2, at_z - 0.2), 6)
            yield f"{name} chair", *ring((at_x, 0.35, at_z + 0.7), 50)


def write_hall(folder):
    """hall.gltf and hall.lights.json with 32 panels; how many triangles the hall has."""
    data, triangles = b"", 0
    gltf = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}], "nodes": [], "meshes": [], "accessors": [],
            "bufferViews": [], "cameras": [{"type": "perspective", "perspective": {"yfov": 1.05, "znear": 0.05}}]}
    for name, positions, indices in furniture():
        triangles += len(indices) // 3
        first = len(gltf["accessors"])
        for packed, kind, count, shape in ((struct.pack(f"<{3 * len(positions)}f", *sum(positions, ())), 5126, len(positions), "VEC3"),
                                           (struct.pack(f"<{len(indices)}I", *indices), 5125, len(indices), "SCALAR")):
            gltf["bufferViews"].append({"buffer": 0, "byteOffset": len(data), "byteLength": len(packed)})
            gltf["accessors"].append({"bufferView": len(gltf["accessors"]), "componentType": kind, "count": count, "type": shape})
            data += packed
        gltf["accessors"][first] |= {"min": list(map(min, zip(*positions))), "max": list(map(max, zip(*positions)))}
        gltf["meshes"].append({"primitives": [{"attributes": {"POSITION": first}, "indices": first + 1}]})
        gltf["nodes"].append({"name": name, "mesh": len(gltf["meshes"]) - 1})
    gltf["scenes"][0]["nodes"] = list(range(len(gltf["nodes"])))
    gltf["buffers"] = [{"byteLength": len(data), "uri": "hall.bin"}]
    (folder / "hall.bin").write_bytes(data)
    (folder / "hall.gltf").write_text(json.dumps(gltf))
    (folder / "panel.ies").write_text((EXAMPLES / "panel.ies").read_text())
    half = math.sqrt(0.5)
    panels = [{"name": f"panel {8 * row + column + 1}", "type": "LuminaireLight", "file": "panel.ies",
               "translation": [1.8 * (column - 3.5), HEIGHT - 0.002, 2.4 * (row - 1.5)], "rotation": [-half, 0, 0, half]}
              for row in range(4) for column in range(8)]
    (folder / "hall.lights.json").write_text(json.dumps({"version": 1, "lights": panels}))
    (folder / "none.lights.json").write_text(json.dumps({"version": 1, "lights": []}))
    return triangles


VIEW = ["--look-from=7,1.9,-4.6", "--look-at=-2,0.6,2", "--fov=60"]


class Hall:
    def __init__(self, folder):
        self.folder = folder
        self.file = folder / "hall.gltf"
        self.panels = ["--lights", folder / "hall.lights.json"]
        self.sun = ["--lights", folder / "none.lights.json", SUN]

    def frame_ms(self, lights, *options):
        """All lights of a frame of 1024 x 768, each from scratch."""
        results = measuring.ask("bench", self.file, *lights, *VIEW, "-t", "exact", "--size", "1024x768", "--rounds", 3,
                                "--json", *options)["results"]
        return next(r["ms"]["median"] for r in results if r["technique"] == "exact")

    def plan(self, lights, grid, *options):
        return measuring.ask("measure", self.file, *lights, PLANE, "--grid", grid, "--json", *options)


def lux_per_light(plan):
    return [list(point["lights"].values()) for point in plan["points"] if point["lux"] is not None]


def rms(a, b):
    squares = [(x - y) ** 2 for p, q in zip(a, b) for x, y in zip(p, q)]
    return math.sqrt(sum(squares) / len(squares))


def frame(hall):
    print(f"frame of 32 panels: {hall.frame_ms(hall.panels):.0f} ms; of the sun at noon: {hall.frame_ms(hall.sun):.1f} ms", flush=True)


def plan(hall):
    ms = hall.plan(hall.panels, "100x100", "--timed-runs", 3)["ms"]
    print(f"plan, 32 panels, 100 x 100 points: {ms['median']:.0f} ms", flush=True)


def day(hall):
    ms = hall.plan(hall.sun, "100x100", "--timed-runs", 3, "--over", DAY)
    suns = sum(time["sun"]["is_up"] for time in ms["times"])
    print(f"day of {suns} suns of {len(ms['times'])}: {ms['ms']['median']:.0f} ms", flush=True)


def rays(hall):
    """Of points few enough for a truth; what rays cost is a line, of which what does not depend on their number is left out.
    (The parts of a light share its rays, and have 64 at least: fewer than 1,024 of a light are none fewer.)"""
    columns, rows, few, truth_rays = 16, 12, 1024, 32768
    grid = f"{columns}x{rows}"
    reference = ["-t", "reference", "--per-light", "--set", "cache=false"]
    truth = lux_per_light(hall.plan(hall.panels, grid, *reference, "--set", f"samples={truth_rays}"))
    error = rms(lux_per_light(hall.plan(hall.panels, grid, "--per-light")), truth)
    mean = sum(map(sum, truth)) / sum(map(len, truth))
    print(f"exact: error {error:.4f} lx a light, of {mean:.2f} on average", flush=True)
    costs = []
    for samples in (few, 4096, 16384):
        measured = hall.plan(hall.panels, grid, *reference, "--set", f"samples={samples}", "--timed-runs", 1)
        costs.append((samples, measured["ms"]["median"]))
        print(f"{samples} rays: error {rms(lux_per_light(measured), truth):.4f} lx, {measured['ms']['median']:.0f} ms, "
              f"of it {1e6 * (costs[-1][1] - costs[0][1]) / max(samples - few, 1) / (columns * rows * 32):.1f} ns a ray", flush=True)


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("penumbra")
    options.add_argument("what", nargs="*", default=["frame", "plan", "day", "rays"])
    options.add_argument("--scene", type=Path)
    arguments = options.parse_args()
    measuring.penumbra = arguments.penumbra
    if arguments.scene:
        arguments.scene.mkdir(parents=True, exist_ok=True)
        sys.exit(print(f"{write_hall(arguments.scene)} triangles in {arguments.scene}/hall.gltf"))
    with tempfile.TemporaryDirectory() as folder:
        print(f"{write_hall(Path(folder))} triangles", flush=True)
        for name in arguments.what:
            {"frame": frame, "plan": plan, "day": day, "rays": rays}[name](Hall(Path(folder)))


if __name__ == "__main__":
    main()
