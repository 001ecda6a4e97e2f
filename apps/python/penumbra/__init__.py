# SPDX-License-Identifier: Apache-2.0
"""Soft shadows of lights that have a size, and the ray-traced truth that they are judged by.

    import penumbra

    scene = penumbra.open_scene("primitives")
    renderer = penumbra.Renderer()
    frame = renderer.render(scene, "exact", {"samples": 64}, size=(480, 270))
    truth = renderer.render(scene, "reference", size=(480, 270))
    for light in frame.lights:
        print(penumbra.compare(truth.visibility[light], frame.visibility[light], frame.reach[light]))

Metres, degrees, nits and lux; +Y up; arrays hold their pictures' rows from the top.
"""


class Error(Exception):
    """What all errors of this module are. They name the place and the remedy, in the command's words."""


class UsageError(Error):
    """An argument outside its documented range, or an unknown name: the command's exit code 2."""


class InputError(Error):
    """A file, or lights, that are missing, unreadable or invalid: exit code 3."""


class DeviceError(Error):
    """No usable OpenGL, or no room on the device: exit code 4."""


from ._penumbra import (  # noqa: E402  (errors are looked up here)
    Camera,
    Frame,
    Mesh,
    Renderer,
    Scene,
    __version__,
    build_scene,
    compare,
    devices,
    open_scene,
    scenes,
    techniques,
)

__all__ = [
    "Camera",
    "DeviceError",
    "Error",
    "Frame",
    "InputError",
    "Mesh",
    "Renderer",
    "Scene",
    "UsageError",
    "__version__",
    "build_scene",
    "compare",
    "devices",
    "open_scene",
    "scenes",
    "techniques",
]
