#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares `penumbra measure` with what Blender's Cycles renders, light by light, over a floor with a board above it.

    blender -b --factory-startup --python docs/measure-cycles.py -- FOLDER     # renders, and exports with Blender's exporter
    docs/measure-cycles.py build/penumbra FOLDER                               # measures, and prints the table

Cycles renders the floor from above, a pixel a point, without reflections: its irradiance is the radiance times pi by the
floor's albedo. A watt is 683 lumens, as in Blender's exporter to glTF. That exports no area lights, and no sizes of others:
they stand in a file of lights with their watts, and in `extras` as a custom property.
"""
import json
import math
import statistics
import subprocess
import sys
from pathlib import Path

WIDTH_M, POINTS = 3.2, 32  # of the floor that is seen, and a side
ALBEDO = 0.8
LUMENS_PER_WATT = 683
SAMPLES = 4096
HEIGHT_M = 2
BOARD = {"low": (0.4, -0.6), "high": (1.2, 0.6), "height_m": 0.6}

# A spot's soft edge is another in Blender than in glTF; it is compared within the inner cone that the exporter writes.
INNER_DEG = {"spot with a soft edge": 35}

# name: what Blender calls it, its settings; watts, of the sun watts per square metre; what glTF's extras say of its size;
# where it hangs, and by how many degrees it is turned about X.
LIGHTS = {
    "point": ("POINT", {"shadow_soft_size": 0.0}, 50, {}, (0.2, 0.1, HEIGHT_M), 0),
    "point, 10 cm": ("POINT", {"shadow_soft_size": 0.1}, 50, {"radius": 0.1}, (0.2, 0.1, HEIGHT_M), 0),
    "spot": ("SPOT", {"shadow_soft_size": 0.0, "spot_size": math.radians(70), "spot_blend": 0.0}, 50, {},
             (0, -0.5, HEIGHT_M), 12),
    "spot with a soft edge": ("SPOT", {"shadow_soft_size": 0.0, "spot_size": math.radians(100), "spot_blend": 0.3}, 50, {},
                              (0, -0.5, HEIGHT_M), 12),
    "area, square": ("AREA", {"shape": "SQUARE", "size": 0.6}, 50, None, (0.2, 0.1, HEIGHT_M), 0),
    "area, rectangle, tilted": ("AREA", {"shape": "RECTANGLE", "size": 1.2, "size_y": 0.3}, 50, None,
                                (0.2, -0.6, HEIGHT_M), 25),
    "area, disk": ("AREA", {"shape": "DISK", "size": 0.8}, 50, None, (0.2, 0.1, HEIGHT_M), 0),
    "sun": ("SUN", {"angle": 0.0}, 3, {}, (0, 0, HEIGHT_M), 35),
    "sun, 3 degrees": ("SUN", {"angle": math.radians(3)}, 3, {"angle": 3}, (0, 0, HEIGHT_M), 35),
}


def file_of(name):
    return name.replace(", ", "-").replace(" ", "-")


def render(folder):
    """Within Blender: a picture as JSON, and the scene as glTF, for each light."""
    import bpy  # Blender's own

    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    cycles = scene.cycles
    cycles.device, cycles.samples, cycles.max_bounces = "CPU", SAMPLES, 0
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.sample_clamp_direct = cycles.light_sampling_threshold = 0
    cycles.pixel_filter_type, cycles.filter_width = "BLACKMAN_HARRIS", 0.01  # the middle of a pixel is its point
    scene.render.resolution_x = scene.render.resolution_y = POINTS
    scene.render.image_settings.file_format, scene.render.image_settings.color_depth = "OPEN_EXR", "32"

    def sheet(name, low, high, height_m):
        corners = [(x, y, height_m) for x, y in ((low[0], low[1]), (high[0], low[1]), (high[0], high[1]), (low[0], high[1]))]
        mesh = bpy.data.meshes.new(name)
        mesh.from_pydata(corners, [], [(0, 1, 2, 3)])
        scene.collection.objects.link(bpy.data.objects.new(name, mesh))
        return mesh

    white = bpy.data.materials.new("white")
    white.use_nodes = True
    white.node_tree.nodes.clear()
    diffuse = white.node_tree.nodes.new("ShaderNodeBsdfDiffuse")
    diffuse.inputs["Color"].default_value = (ALBEDO, ALBEDO, ALBEDO, 1)
    output = white.node_tree.nodes.new("ShaderNodeOutputMaterial")
    white.node_tree.links.new(diffuse.outputs[0], output.inputs[0])
    sheet("floor", (-3, -3), (3, 3), 0).materials.append(white)
    sheet("board", BOARD["low"], BOARD["high"], BOARD["height_m"]).materials.append(white)

    camera = bpy.data.cameras.new("from above")
    camera.type, camera.ortho_scale, camera.clip_start = "ORTHO", WIDTH_M, 0.01
    above = bpy.data.objects.new("from above", camera)
    above.location = (0, 0, BOARD["height_m"] / 2)  # below the board
    scene.collection.objects.link(above)
    scene.camera = above

    for name, (kind, settings, watts, size, place, tilt_deg) in LIGHTS.items():
        light = bpy.data.lights.new(name, kind)
        light.energy = watts
        for key, value in settings.items():
            setattr(light, key, value)
        if size:
            light["penumbra"] = size
        lamp = bpy.data.objects.new(name, light)
        lamp.location, lamp.rotation_euler = place, (math.radians(tilt_deg), 0, 0)
        scene.collection.objects.link(lamp)
        picture = folder / f"{file_of(name)}.exr"
        scene.render.filepath = str(picture)
        bpy.ops.render.render(write_still=True)
        read = bpy.data.images.load(str(picture))
        read.colorspace_settings.name = "Non-Color"
        lux = [LUMENS_PER_WATT * math.pi / ALBEDO * value for value in read.pixels[:][1::4]]  # from the lower left
        (folder / f"{file_of(name)}.json").write_text(json.dumps({"version": bpy.app.version_string, "lux": lux}))
        bpy.ops.export_scene.gltf(filepath=str(folder / file_of(name)), export_format="GLB", export_lights=True,
                                  export_extras=True, export_import_convert_lighting_mode="SPEC")
        bpy.data.objects.remove(lamp)


def area_light(name, version):
    _, settings, watts, _, (x, y, z), tilt_deg = LIGHTS[name]
    half = math.radians(tilt_deg - 90) / 2  # Blender's Z is up
    light = {"name": name, "watts": watts, "program": f"Blender {version}", "translation": [x, z, -y],
             "rotation": [round(math.sin(half), 9), 0, 0, round(math.cos(half), 9)]}
    if settings["shape"] == "DISK":
        return light | {"type": "DiskLight", "radius": settings["size"] / 2}
    return light | {"type": "RectLight", "width": settings["size"], "height": settings.get("size_y", settings["size"])}


def is_compared(name, point):
    *_, (x, y, z), tilt_deg = LIGHTS[name]
    towards = (point[0] - x, -point[2] - y, point[1] - z)  # as in Blender
    down = (0, math.sin(math.radians(tilt_deg)), -math.cos(math.radians(tilt_deg)))
    cosine = sum(a * b for a, b in zip(towards, down)) / math.hypot(*towards)
    return math.degrees(math.acos(cosine)) < INNER_DEG.get(name, 180)


def compare(penumbra, folder):
    corner = -WIDTH_M / 2
    print("| light | lux | points | median | 95 of 100 | within 1 % |\n| --- | --- | --- | --- | --- | --- |")
    for name, (kind, settings, *_) in LIGHTS.items():
        rendered = json.loads((folder / f"{file_of(name)}.json").read_text())
        if kind == "AREA":
            (folder / f"{file_of(name)}.lights.json").write_text(
                json.dumps({"version": 1, "lights": [area_light(name, rendered["version"])]}))
        done = subprocess.run([penumbra, "-q", "measure", folder / f"{file_of(name)}.glb",
                               f"--plane={corner},0,{corner},{WIDTH_M},{WIDTH_M}", "--grid", f"{POINTS}x{POINTS}", "--json"],
                              capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(done.stderr)
        off, lit = [], []
        for point in json.loads(done.stdout)["points"]:
            x, _, z = point["position"]
            column, row = (int((c - corner) / WIDTH_M * POINTS) for c in (x, -z))
            theirs, ours = rendered["lux"][row * POINTS + column], point["lux"]
            if theirs == 0 and ours == 0 or not is_compared(name, point["position"]):
                continue
            lit.append(theirs)
            off.append(abs(ours / theirs - 1) if theirs else math.inf)
        off.sort()
        within = sum(error <= 0.01 for error in off) / len(off)
        print(f"| {name} | {min(lit):.3g} to {max(lit):.4g} | {len(off)} | {statistics.median(off):.3%} | "
              f"{off[int(0.95 * len(off))]:.2%} | {within:.1%} |".replace("%", " %"))


if __name__ == "__main__":
    words = sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else sys.argv[1:]
    if len(words) == 1 and "--" in sys.argv:
        render(Path(words[0]).resolve())
    elif len(words) == 2:
        compare(words[0], Path(words[1]))
    else:
        sys.exit(__doc__)
