#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares `penumbra measure` with Radiance in the office of examples/, furnished, under four of its panels.

    docs/measure-radiance.py build/penumbra

Radiance's ies2rad, oconv and rtrace must be on the PATH. Points lie on the floor, at the height of desks and on two walls, by
chance from a fixed seed; light is direct. Radiance cuts a light into at most 64 parts, whatever -ds says, too few for the edges
of shadows: so it is asked twice, about the panels whole, and about panels that are laid of 8 x 8 tiles. Prints what
docs/manual/measuring.md shows.
"""
import json
import random
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).parent
OFFICE = HERE.parent / "examples" / "office"
sys.path.insert(0, str(OFFICE))
import make_office  # noqa: E402

PANELS = [(x, make_office.HEIGHT - 0.002, z) for x in (-1.8, 1.8) for z in (-1.2, 1.2)]
HALF_PANEL_M = 0.3
POINTS = 100
OFF_SURFACE_M = 0.001
LUMENS_PER_WATT = 179  # Radiance's own
DIRECT = ["-I+", "-h", "-ab", "0", "-ds", ".01", "-dj", "0", "-dt", "0", "-dc", "1"]


def z_up(x, y, z):
    return x, -z, y


def run(*command, text=None, folder=None):
    done = subprocess.run([str(word) for word in command], input=text, capture_output=True, text=True, cwd=folder)
    if done.returncode != 0:
        sys.exit(f"{command[0]}: {done.stderr}")
    return done.stdout


def points():
    """(place, normal); none lies within furniture."""
    dice = random.Random(24)
    half_width, half_depth = make_office.WIDTH / 2, make_office.DEPTH / 2
    boxes = [(low, high) for _, _, low, high in make_office.parts()]
    inside = lambda p: any(all(a - 0.01 < c < b + 0.01 for a, b, c in zip(low, high, p)) for low, high in boxes)
    made = []
    while len(made) < POINTS:
        x, y, z = (dice.uniform(-reach, reach) for reach in (half_width - 0.05, 0, half_depth - 0.05))
        y = dice.uniform(0.1, make_office.HEIGHT - 0.3)
        place, normal = [((x, OFF_SURFACE_M, z), (0, 1, 0)), ((x, 0.75, z), (0, 1, 0)),
                         ((-half_width + OFF_SURFACE_M, y, z), (1, 0, 0)),
                         ((x, y, -half_depth + OFF_SURFACE_M), (0, 0, 1))][len(made) % 4]
        off = [c + 0.02 * n for c, n in zip(place, normal)]
        if not inside(off):
            made.append((place, normal))
    return made


def faces():
    """The office as polygons, black: what they reflect does not count."""
    yield "void plastic black 0 0 5 0 0 0 0 0"
    for name, _, low, high in make_office.parts():
        corners, indices = make_office.box(low, high)
        for k in range(0, len(indices), 3):
            place = [c for i in indices[k:k + 3] for c in z_up(*corners[i])]
            yield f"black polygon {name.replace(' ', '_')}{k} 0 0 9 " + " ".join(f"{c:.9g}" for c in place)


def panels(tiles):
    """Of tiles x tiles squares each, with what ies2rad makes of the file's candela."""
    edge = 2 * HALF_PANEL_M / tiles
    for x, y, z in PANELS:
        for i in range(tiles):
            for j in range(tiles):
                left, front = x - HALF_PANEL_M + i * edge, -z - HALF_PANEL_M + j * edge
                corners = [(left, front), (left, front + edge), (left + edge, front + edge), (left + edge, front)]
                numbers = " ".join(f"{a:.9g} {b:.9g} {y:.9g}" for a, b in corners)  # clockwise: it faces down
                yield f"panel_light polygon p{x}_{z}_{i}_{j} 0 0 12 {numbers}"


def by_radiance(folder, asked, tiles):
    run("ies2rad", "-dm", "-t", "white", "-o", "panel", OFFICE / "panel.ies", folder=folder)
    whole = (folder / "panel.rad").read_text()
    light = whole[:whole.index("'panel_light' polygon")]
    (folder / "scene.rad").write_text("\n".join([light, *panels(tiles), *faces()]) + "\n")
    with open(folder / "scene.oct", "wb") as octree:
        subprocess.run(["oconv", "scene.rad"], cwd=folder, stdout=octree, stderr=subprocess.DEVNULL, check=True)
    rays = "\n".join(" ".join(f"{c:.9g}" for c in (*z_up(*place), *z_up(*normal))) for place, normal in asked)
    rows = run("rtrace", *DIRECT, "scene.oct", text=rays + "\n", folder=folder).splitlines()
    return [LUMENS_PER_WATT * float(row.split()[1]) for row in rows]


def by_penumbra(penumbra, folder, asked):
    down = [-0.7071068, 0, 0, 0.7071068]
    (folder / "panel.ies").write_text((OFFICE / "panel.ies").read_text())
    (folder / "four.json").write_text(json.dumps({"version": 1, "lights": [
        {"name": f"panel {i}", "type": "LuminaireLight", "file": "panel.ies", "translation": place, "rotation": down}
        for i, place in enumerate(PANELS)]}))
    (folder / "points.csv").write_text("\n".join(",".join(f"{c:.9g}" for c in (*p, *n)) for p, n in asked) + "\n")
    answer = json.loads(run(penumbra, "-q", "measure", OFFICE / "office.gltf", "--lights", folder / "four.json",
                            "--points", folder / "points.csv", "--json"))
    return [point["lux"] for point in answer["points"]]


def main(penumbra):
    asked = points()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        ours = by_penumbra(penumbra, folder, asked)
        print(run("rtrace", "-version").strip())
        for tiles in (1, 8):
            theirs = by_radiance(folder, asked, tiles)
            off = sorted((abs(a / b - 1) if b else 0 if not a else float("inf"), a, b, p)
                         for a, b, p in zip(ours, theirs, asked))
            errors = [row[0] for row in off]
            print(f"panels of {tiles} x {tiles}: {min(theirs):.3g} to {max(theirs):.4g} lx; median {statistics.median(errors):.3%}, "
                  f"the 95th of {POINTS} {errors[94]:.3%}, largest {errors[-1]:.3%}, "
                  f"within 2 % at {sum(e <= 0.02 for e in errors)}")
            for row in off[-6:]:
                print("    {0:.2%}: {1:.5g} lx, Radiance {2:.5g} lx at {3}".format(*row))


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(Path(sys.argv[1]).resolve())
