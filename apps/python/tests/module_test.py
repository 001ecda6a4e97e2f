# SPDX-License-Identifier: Apache-2.0
"""The module as a researcher meets it. PENUMBRA_COMMAND is the command, whose answers it must give."""
import gc
import os
import resource
import subprocess
import tempfile
import threading
import unittest
import warnings
from pathlib import Path

import exr
import numpy as np
import penumbra

SIZE = (96, 54)
KEY = {"name": "key", "type": "RectLight", "width": 1, "height": 1, "intensity": 16000,
       "translation": [0, 4, 0], "aim": [0, 0, 0]}
renderer = penumbra.Renderer()


def command(*arguments):
    return subprocess.run([os.environ["PENUMBRA_COMMAND"], *arguments], capture_output=True, text=True)


def sheet(width, depth, middle):
    """Two triangles that face up."""
    corners = np.array([[-1, 0, -1], [-1, 0, 1], [1, 0, 1], [1, 0, -1]]) * [width / 2, 1, depth / 2]
    return corners + middle, np.array([[0, 1, 2], [0, 2, 3]])


def half_plane(**ground):
    """The built-in scene of that name, but for its light's strength."""
    return penumbra.build_scene(
        [penumbra.Mesh(*sheet(40, 40, [0, 0, 0]), name="ground", casts=False, **ground),
         penumbra.Mesh(*sheet(20, 40, [-10, 2, 0]), name="half-plane")], [KEY], name="half-plane")


def channels_of(frame):
    """Visibility by the names of the command's EXR."""
    channels = {}
    for light, visibility in frame.visibility.items():
        name = "V" if len(frame.lights) == 1 else f"{light}.V"
        if visibility.ndim == 2:
            channels[name] = visibility
        else:
            channels.update({f"{name}.{c}": visibility[..., i].copy() for i, c in enumerate("RGB")})
    return channels


PLAN = penumbra.Camera([0, 1.5, 0], [0, 0, 0], height=3)


class Values(unittest.TestCase):
    def test_visibility_is_that_of_the_command_bit_by_bit(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "v.exr"
            for scene, technique, name, value in [
                    ("two-boxes", "pcss", "map_size", 512), ("textured-window", "exact", "samples", 64),
                    ("many-lights", "exact", "samples", 64), ("half-plane", "reference", "samples", 64)]:
                with self.subTest(scene=scene, technique=technique):
                    done = command("render", scene, "-t", f"{technique}:{name}={value}", "--size", "96x54",
                                   "--visibility", str(path))
                    self.assertEqual(done.returncode, 0, done.stderr)
                    frame = renderer.render(penumbra.open_scene(scene), technique, {name: value}, size=SIZE)
                    shown_elsewhere = {"Y", "R", "G", "B"}  # by other programs: the same once more
                    theirs = {name: values for name, values in exr.read(path).items() if name not in shown_elsewhere}
                    ours = channels_of(frame)
                    self.assertEqual(set(theirs), set(ours))
                    for channel, values in ours.items():
                        np.testing.assert_array_equal(values.view(np.uint32), theirs[channel].view(np.uint32))

    def test_half_plane_is_its_closed_form(self):
        # Over x the blocker's edge crosses the light, which is a metre wide and as far above it as it is above the
        # ground: visibility rises from 0 at x = -0.5 to 1 at x = 0.5.
        frame = renderer.render(half_plane(), "exact", {"samples": 1024}, size=(90, 90), camera=PLAN)
        x = (np.arange(90) + 0.5) / 30 - 1.5
        np.testing.assert_allclose(frame.visibility["key"], np.broadcast_to(np.clip(x + 0.5, 0, 1), (90, 90)),
                                   atol=1 / 32)

    def test_what_is_built_is_what_is_built_in(self):
        for technique in ("hard", "exact", "soft-volumes"):
            with self.subTest(technique=technique):
                built, known = (renderer.render(scene, technique, size=SIZE, camera=PLAN)
                                for scene in (half_plane(), penumbra.open_scene("half-plane")))
                np.testing.assert_array_equal(built.visibility["key"], known.visibility["key"])
                np.testing.assert_array_equal(built.depth, known.depth)
                np.testing.assert_array_equal(built.normals, known.normals)

    def test_depth_and_normals_are_the_surface_s(self):
        frame = renderer.render(half_plane(), "hard", size=SIZE, camera=PLAN)
        np.testing.assert_allclose(frame.depth, 1.5, rtol=1e-5)
        np.testing.assert_allclose(frame.normals, np.broadcast_to([0, 1, 0], (54, 96, 3)), atol=1e-6)
        # In perspective it is the distance along the camera's direction, here 45 degrees down.
        camera = penumbra.Camera([0, 2, 2], [0, 0, 0], fov=90)
        scene = penumbra.build_scene([penumbra.Mesh(*sheet(40, 40, [0, 0, 0]), casts=False)], [KEY])
        depth = renderer.render(scene, "hard", size=(65, 65), camera=camera).depth
        down = np.tan(np.radians(45)) * (2 * (np.arange(65) + 0.5) / 65 - 1)
        near = slice(16, 65)  # rows that show the ground, which ends at 20 m
        np.testing.assert_allclose(depth[near, 32], 2 * np.sqrt(2) / (1 + down[near]), rtol=1e-4)

    def test_nothing_is_seen_of_nothing(self):
        up = penumbra.Camera([0, 1, 0], [0, 9, 0.1])
        scene = penumbra.build_scene([penumbra.Mesh(*sheet(4, 4, [0, 0, 0]), casts=False)], [KEY])
        frame = renderer.render(scene, size=SIZE, camera=up)
        self.assertTrue(np.isinf(frame.depth).all())
        self.assertFalse(frame.normals.any())
        self.assertTrue((frame.visibility["key"] == 1).all())

    def test_illuminance_is_that_of_a_small_light(self):
        # E = L A cos / d^2, all of it at the foot and none in the umbra.
        light = {**KEY, "width": 0.01, "height": 0.01, "intensity": 1e6}
        frame = renderer.render(half_plane().with_lights([light]), "exact", size=(90, 90), camera=PLAN)
        self.assertAlmostEqual(frame.illuminance[45, 46], 1e6 * 1e-4 / 16, delta=0.01)
        self.assertEqual(frame.illuminance[45, 5], 0)

    def test_statistics_and_parameters_are_dicts(self):
        frame = renderer.render(half_plane(), "auto", size=SIZE, timed_runs=2)
        self.assertEqual(set(frame.statistics["key"]), {"counts", "passes_ms", "chosen"})
        self.assertIn(frame.statistics["key"]["chosen"]["technique"], penumbra.techniques())
        self.assertEqual(len(frame.milliseconds["key"]), 2)
        for technique in penumbra.techniques():
            parameters = renderer.parameters(technique)
            stated = {parameter["name"]: parameter["default"] for parameter in parameters}
            np.testing.assert_array_equal(
                renderer.render(half_plane(), technique, stated, size=(8, 8)).visibility["key"],
                renderer.render(half_plane(), technique, size=(8, 8)).visibility["key"])
            for parameter in parameters:
                if parameter.get("max") is not None:
                    beyond = {parameter["name"]: 2 * parameter["max"] + 1}
                    with self.assertRaises(penumbra.UsageError, msg=f"{technique}: {parameter}"):
                        renderer.render(half_plane(), technique, beyond, size=(8, 8))

    def test_compare_is_that_of_numbers(self):
        truth, test = np.array([[0, 0.5, 1, 1]]), np.array([[0.2, 0.4, 1, 0]])
        judged = penumbra.compare(truth, test)
        self.assertAlmostEqual(judged["mae"], 1.3 / 4, places=6)
        self.assertAlmostEqual(judged["penumbra_rmse"], 0.1, places=6)
        self.assertEqual((judged["leak"], judged["false_shadow"], judged["samples"]), (1, 0.5, 4))
        self.assertAlmostEqual(penumbra.compare(truth, test, np.array([[1, 1, 1, 0]]))["max"], 0.2, places=6)


class Errors(unittest.TestCase):
    def assert_says(self, kind, words, call, *arguments, **named):
        with self.assertRaises(kind) as raised:
            call(*arguments, **named)
        self.assertIsInstance(raised.exception, penumbra.Error)
        self.assertIn(words, str(raised.exception))

    def test_words_are_the_command_s(self):
        with self.assertRaises(penumbra.InputError) as raised:
            penumbra.open_scene("primitive")
        self.assertIn(str(raised.exception), command("info", "primitive").stderr)
        for option in ("map_siz=64", "map_size=no"):
            name, value = option.split("=")
            with self.assertRaises(penumbra.UsageError) as raised:
                renderer.render(half_plane(), "hard", {name: value}, size=SIZE)
            said = command("render", "half-plane", "-t", "hard", "--set", option, "--json", "--size", "9x9")
            self.assertEqual(said.returncode, 2)
            self.assertIn(str(raised.exception), said.stderr)

    def test_arguments_are_checked(self):
        scene = half_plane()
        flat, triangles = sheet(1, 1, [0, 0, 0])
        usage = penumbra.UsageError
        self.assert_says(usage, "there are: hard", renderer.render, scene, "harder")
        self.assert_says(usage, "there is no camera 'x'; the scene has: 0 (default)", renderer.render, scene, camera="x")
        self.assert_says(usage, "0x5 pixels", renderer.render, scene, size=(0, 5))
        self.assert_says(usage, "time must be", renderer.render, scene, time=float("nan"))
        self.assert_says(usage, "exposure must be", renderer.render, scene, exposure=float("inf"))
        self.assert_says(usage, "timed_runs", renderer.render, scene, timed_runs=-1)
        self.assert_says(usage, "the same place", penumbra.Camera, [1, 2, 3], [1, 2, 3])
        self.assert_says(usage, "unit='furlong' is none of: mm", penumbra.open_scene, "torus", unit="furlong")
        self.assert_says(usage, "mesh 'mesh': triangles[1] names vertex 4 of 4", penumbra.Mesh, flat, [[0, 1, 2], [0, 4, 1]])
        self.assert_says(usage, "of shape (4, 2)", penumbra.Mesh, flat[:, :2], triangles)
        self.assert_says(usage, "positions[2] is not finite", penumbra.Mesh, [[0, 0, 0], [1, 0, 0], [0, np.nan, 1]], [[0, 1, 2]])
        self.assert_says(usage, "must be integers", penumbra.Mesh, flat, triangles.astype(float))
        self.assert_says(usage, "it has no triangles", penumbra.Mesh, flat, triangles[:0])
        self.assert_says(usage, "two meshes are named 'mesh'", penumbra.build_scene, 2 * [penumbra.Mesh(flat, triangles)],
                         [KEY])
        self.assert_says(usage, "needs a light", penumbra.build_scene, [penumbra.Mesh(flat, triangles)], [])
        self.assert_says(penumbra.InputError, "lights:2: unknown key 'radus' in SphereLight; did you mean 'radius'?",
                         scene.with_lights, [KEY, {"name": "b", "type": "SphereLight", "radus": 1}])
        self.assert_says(penumbra.InputError, "cannot compare", penumbra.compare, np.zeros((2, 3)), np.zeros((3, 2)))
        self.assert_says(penumbra.DeviceError, "there is no device 99", penumbra.Renderer, 99)
        self.assertRaises(TypeError, renderer.render, None)
        # And all is as it was.
        self.assertEqual(renderer.render(scene, size=SIZE).lights, ["key"])

    def test_what_is_odd_is_a_warning(self):
        with tempfile.TemporaryDirectory() as folder, warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            lights = Path(folder) / "none.json"
            lights.write_text('{"version": 1, "lights": []}')
            scene = penumbra.open_scene("half-plane", lights=lights)
        self.assertIn("half-plane has no light", str(caught[0].message))
        self.assertEqual(len(scene.warnings), 1)

    def test_progress_rises_and_can_end_the_work(self):
        shares = []
        renderer.render(half_plane(), "reference", {"cache": False, "samples": 16}, size=SIZE, progress=shares.append)
        self.assertEqual(shares, sorted(shares))
        self.assertEqual((shares[0], shares[-1]), (0, 1))
        self.assertGreater(len(shares), 4)

        def stop(share):
            if share > 0.3:
                raise KeyboardInterrupt("enough")
        with self.assertRaisesRegex(KeyboardInterrupt, "enough"):
            renderer.render(half_plane(), "reference", {"cache": False}, size=SIZE, progress=stop)

        def again(share):
            renderer.render(half_plane(), "hard", size=SIZE)
        with self.assertRaisesRegex(penumbra.UsageError, "at work in another call"):
            renderer.render(half_plane(), "hard", size=SIZE, progress=again)
        other = penumbra.Renderer()
        frame = renderer.render(half_plane(), "hard", size=SIZE,
                                progress=lambda share: other.render(half_plane(), "hard", size=SIZE))
        np.testing.assert_array_equal(frame.visibility["key"],
                                      renderer.render(half_plane(), "hard", size=SIZE).visibility["key"])


class Lives(unittest.TestCase):
    def test_arrays_outlive_all_else(self):
        scene, own = penumbra.open_scene("two-boxes"), penumbra.Renderer()
        frame = own.render(scene, "hard", size=SIZE)
        visibility, depth = frame.visibility[frame.lights[0]], frame.depth
        before = visibility.copy(), depth.copy()
        for array in (visibility, depth, frame.normals):
            self.assertEqual(array.dtype, np.float32)
            self.assertTrue(array.flags.c_contiguous and array.flags.writeable)
        self.assertIs(frame.depth, depth)  # the one array, no copy of it
        del scene, own, frame
        gc.collect()
        renderer.render(half_plane(), size=SIZE)
        np.testing.assert_array_equal(visibility, before[0])
        np.testing.assert_array_equal(depth, before[1])

    def test_arrays_given_may_change_afterwards(self):
        positions, triangles = sheet(1, 1, [0, 1, 0])
        mesh = penumbra.Mesh(positions, triangles, name="lid")
        ground = penumbra.Mesh(*sheet(9, 9, [0, 0, 0]), name="ground", casts=False)
        scene = penumbra.build_scene([mesh, ground], [KEY])
        before = renderer.render(scene, "hard", size=SIZE, camera=PLAN)
        positions[:] = 0
        triangles[:] = 0
        np.testing.assert_array_equal(before.visibility["key"],
                                      renderer.render(scene, "hard", size=SIZE, camera=PLAN).visibility["key"])
        self.assertEqual((mesh.triangle_count, scene.triangle_count), (2, 4))

    def test_any_thread_may_render(self):
        known = renderer.render(half_plane(), "exact", size=SIZE).visibility["key"]
        answers = []

        def work(with_renderer):
            answers.append(with_renderer.render(half_plane(), "exact", size=SIZE).visibility["key"])
        workers = [threading.Thread(target=work, args=[r]) for r in (renderer, penumbra.Renderer())]
        for worker in workers:
            worker.start()
        for worker in workers:
            worker.join()
        self.assertEqual(len(answers), 2)
        for answer in answers:
            np.testing.assert_array_equal(answer, known)

    def test_repeated_use_keeps_nothing(self):
        def use(times):
            for _ in range(times):
                scene = half_plane(color=(0.5, 0.5, 0.5))
                renderer.render(scene, "soft-volumes", size=(256, 256))
                renderer.render(scene, "reference", {"samples": 2, "cache": False}, size=(16, 16))
                try:
                    renderer.render(scene, "exact", {"samples": "many"})
                except penumbra.UsageError:
                    pass
            gc.collect()
            return int(Path("/proc/self/statm").read_text().split()[1]) * resource.getpagesize()
        settled = use(20)
        # A frame is 5 MB here, its pictures on the device besides: forty kept would be 200 MB and more.
        self.assertLess(use(40) - settled, 40e6)


if __name__ == "__main__":
    unittest.main()
