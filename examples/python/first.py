# SPDX-License-Identifier: Apache-2.0
# A picture, what it is worth, and a scene out of arrays.

# %% A picture
#! [open]
import matplotlib.pyplot as plt
import penumbra

scene = penumbra.open_scene("two-boxes")  # or "room.glb", with room.lights.json beside it
renderer = penumbra.Renderer()  # needs no window; keep it, making one takes a while
frame = renderer.render(scene, "exact", {"samples": 64}, size=(320, 180))
plt.imsave("picture.png", frame.display)
#! [open]

# %% How near it is to the truth
#! [judge]
truth = renderer.render(scene, "reference", size=(320, 180), progress=print)
for light in frame.lights:
    print(light, penumbra.compare(truth.visibility[light], frame.visibility[light], frame.reach[light]))
#! [judge]

# %% A scene out of arrays: a ground, a leaf over it, and lamps that grow
#! [build]
import numpy as np

square = np.array([[-1, 0, -1], [-1, 0, 1], [1, 0, 1], [1, 0, -1]])
triangles = [[0, 1, 2], [0, 2, 3]]
ground = penumbra.Mesh(10 * square, triangles, name="ground", casts=False)
leaf = penumbra.Mesh(0.4 * square + [0, 1, 0], triangles, name="leaf")
lamp = {"name": "lamp", "type": "DiskLight", "radius": 0.1, "intensity": 20000,
        "translation": [0.5, 3, 0], "aim": [0, 0, 0]}
leaves = penumbra.build_scene([ground, leaf], [lamp])
camera = penumbra.Camera(look_from=[0, 2, 3], look_at=[0, 0, 0])
for radius in (0.05, 0.1, 0.2, 0.4):
    lit = leaves.with_lights([{**lamp, "radius": radius}])
    visibility = renderer.render(lit, size=(320, 180), camera=camera).visibility["lamp"]
    print(f"radius {radius} m: {np.mean((visibility > 0.01) & (visibility < 0.99)):.1%} of the picture is penumbra")
#! [build]
