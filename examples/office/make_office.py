#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the office beside this script: office.gltf, office.lights.json, panels.lights.json and panel.ies.

A room of 7.2 x 5.4 x 2.8 m with a window to the south (+Z), eight panels flush with its ceiling, and desks.
"""
import base64
import json
import math
import pathlib
import struct

HERE = pathlib.Path(__file__).parent
WIDTH, DEPTH, HEIGHT = 7.2, 5.4, 2.8
WINDOW = {"x": (-2.4, 2.4), "y": (0.9, 2.3)}
MATERIALS = {"wall": (0.72, 0.7, 0.66), "floor": (0.36, 0.33, 0.3), "ceiling": (0.82, 0.82, 0.8),
             "desk": (0.55, 0.42, 0.3), "screen": (0.12, 0.12, 0.13)}
WALL = 0.2


def box(low, high):
    """Corners and triangles of a box, outside first."""
    points = [[(low, high)[i >> axis & 1][axis] for axis in range(3)] for i in range(8)]
    quads = [(0, 4, 6, 2), (1, 3, 7, 5), (0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6)]
    return points, [i for a, b, c, d in quads for i in (a, b, c, a, c, d)]


def parts():
    """(name, material, low corner, high corner)"""
    x, z, y = WIDTH / 2, DEPTH / 2, HEIGHT
    yield "floor", "floor", (-x - WALL, -WALL, -z - WALL), (x + WALL, 0, z + WALL)
    yield "ceiling", "ceiling", (-x - WALL, y, -z - WALL), (x + WALL, y + WALL, z + WALL)
    yield "west wall", "wall", (-x - WALL, 0, -z), (-x, y, z)
    yield "east wall", "wall", (x, 0, -z), (x + WALL, y, z)
    yield "north wall", "wall", (-x - WALL, 0, -z - WALL), (x + WALL, y, -z)
    (left, right), (sill, head) = WINDOW["x"], WINDOW["y"]
    yield "below the window", "wall", (-x - WALL, 0, z), (x + WALL, sill, z + WALL)
    yield "above the window", "wall", (-x - WALL, head, z), (x + WALL, y, z + WALL)
    yield "left of the window", "wall", (-x - WALL, sill, z), (left, head, z + WALL)
    yield "right of the window", "wall", (right, sill, z), (x + WALL, head, z + WALL)
    for i in range(-1, 2):
        post = i * (right - left) / 4
        yield f"mullion {i + 2}", "wall", (post - 0.03, sill, z + 0.05), (post + 0.03, head, z + 0.11)
    for row, desk_z in enumerate((-1.3, 0.9)):
        for column, desk_x in enumerate((-1.9, 1.9)):
            name = f"desk {2 * row + column + 1}"
            yield name, "desk", (desk_x - 0.8, 0.7, desk_z - 0.4), (desk_x + 0.8, 0.74, desk_z + 0.4)
            for leg in range(4):
                leg_x = desk_x + (-0.75, 0.7)[leg & 1]
                leg_z = desk_z + (-0.35, 0.3)[leg >> 1]
                yield f"{name} leg {leg + 1}", "screen", (leg_x, 0, leg_z), (leg_x + 0.05, 0.7, leg_z + 0.05)
            yield f"{name} screen", "screen", (desk_x - 0.3, 0.84, desk_z - 0.22), (desk_x + 0.3, 1.2, desk_z - 0.2)
            yield f"{name} foot", "screen", (desk_x - 0.04, 0.74, desk_z - 0.24), (desk_x + 0.04, 0.9, desk_z - 0.22)


def office():
    data = b""
    gltf = {"asset": {"version": "2.0", "generator": "make_office.py"}, "scene": 0, "scenes": [{"nodes": []}],
            "nodes": [], "meshes": [], "accessors": [], "bufferViews": [], "cameras": []}
    names = list(MATERIALS)
    gltf["materials"] = [{"name": name, "pbrMetallicRoughness": {"baseColorFactor": [*color, 1]}}
                         for name, color in MATERIALS.items()]
    for name, material, low, high in parts():
        points, indices = box(low, high)
        first = len(gltf["accessors"])
        for values, form, kind in ((sum(points, []), "f", 5126), (indices, "H", 5123)):
            gltf["bufferViews"].append({"buffer": 0, "byteOffset": len(data),
                                        "byteLength": len(values) * struct.calcsize(form)})
            data += struct.pack(f"<{len(values)}{form}", *values)
            count = len(values) // 3 if form == "f" else len(values)
            accessor = {"bufferView": len(gltf["bufferViews"]) - 1, "componentType": kind, "count": count,
                        "type": "VEC3" if form == "f" else "SCALAR"}
            if form == "f":
                accessor |= {"min": list(map(min, zip(*points))), "max": list(map(max, zip(*points)))}
            gltf["accessors"].append(accessor)
        gltf["meshes"].append({"name": name, "primitives": [{
            "attributes": {"POSITION": first}, "indices": first + 1, "material": names.index(material)}]})
        gltf["nodes"].append({"name": name, "mesh": len(gltf["meshes"]) - 1})
    gltf["cameras"].append({"type": "perspective", "name": "from the door",
                            "perspective": {"yfov": 1.05, "znear": 0.05}})
    # Looks south-west and down a little: a turn about Y, then about X.
    yaw, pitch = math.radians(180 - 38), math.radians(-14)
    turn_y, turn_x = (0, math.sin(yaw / 2), 0, math.cos(yaw / 2)), (math.sin(pitch / 2), 0, 0, math.cos(pitch / 2))
    rotation = [turn_y[3] * turn_x[0], turn_y[1] * turn_x[3], -turn_y[1] * turn_x[0], turn_y[3] * turn_x[3]]
    gltf["nodes"].append({"name": "from the door", "camera": 0, "translation": [3.3, 1.9, -2.4],
                          "rotation": [round(r, 7) for r in rotation]})
    gltf["scenes"][0]["nodes"] = list(range(len(gltf["nodes"])))
    uri = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
    gltf["buffers"] = [{"byteLength": len(data), "uri": uri}]
    return json.dumps(gltf)


def lights():
    down = [-0.7071068, 0, 0, 0.7071068]
    panels = [{"name": f"panel {4 * row + column + 1}", "type": "LuminaireLight", "file": "panel.ies",
               "translation": [round(-2.7 + 1.8 * column, 3), HEIGHT - 0.002, (-1.2, 1.2)[row]], "rotation": down}
              for row in range(2) for column in range(4)]
    sun = {"name": "sun", "type": "SunLight", "latitude": 52.52, "longitude": 13.405,
           "time": "2026-02-10T14:30+01:00", "multiplier": 0.05}
    return sidecar([*panels, sun]), sidecar(panels)


def sidecar(all_lights):
    lines = ",\n    ".join(json.dumps(light) for light in all_lights)
    return f'{{\n  "version": 1,\n  "lights": [\n    {lines}\n  ]\n}}\n'


def panel():
    """A flush panel of 0.6 x 0.6 m that keeps screens free of glare: little beyond 65 degrees."""
    gammas = [0, 5, 10, 15, 20, 25, 30, 35, 40, 45, 50, 55, 60, 65, 70, 75, 80, 85, 90]
    planes = [0, 22.5, 45, 67.5, 90]

    def candela(gamma, c):
        wide = 1 + 0.25 * math.sin(math.radians(gamma)) ** 2 * math.cos(math.radians(2 * c))
        cut = 1 / (1 + math.exp((gamma - 62) / 4))
        return 1400 * math.cos(math.radians(gamma)) * wide * cut

    rows = ["IESNA:LM-63-2002", "[TEST] written for Penumbra", "[TESTLAB] none", "[ISSUEDATE] 2026-01-01",
            "[MANUFAC] none", "[LUMINAIRE] flush panel, 600 x 600 mm, prismatic", "TILT=NONE",
            f"1 -1 1 {len(gammas)} {len(planes)} 1 2 0.6 0.6 0", "1 1 32", " ".join(map(str, gammas)),
            " ".join(map(str, planes))]
    rows += [" ".join(f"{candela(gamma, c):.1f}" for gamma in gammas) for c in planes]
    return "\n".join(rows) + "\n"


if __name__ == "__main__":
    with_sun, panels_alone = lights()
    for name, text in (("office.gltf", office()), ("office.lights.json", with_sun),
                       ("panels.lights.json", panels_alone), ("panel.ies", panel())):
        (HERE / name).write_text(text)
