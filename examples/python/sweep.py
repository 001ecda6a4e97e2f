# SPDX-License-Identifier: Apache-2.0
# Error against cost: how near techniques come to the ray-traced truth, and what each step nearer costs. Run it whole
# (python3 sweep.py -o sweep.svg), or cell by cell in an editor that knows "# %%".

# %% What to sweep
import argparse

import matplotlib.pyplot as plt
import numpy as np
import penumbra

SCENES = ["two-boxes", "overlapping-blockers", "columns"]
SWEPT = {  # technique: its parameter, and the values that it is given
    "exact": ("samples", [16, 64, 256]),
    "uniform": ("samples", [4, 9, 17]),
    "pcss": ("map_size", [256, 512, 1024, 2048]),
}

options = argparse.ArgumentParser(description="Draws error against cost.")
options.add_argument("-o", "--output", default="sweep.svg", help="the plot: .svg, .png, .pdf")
options.add_argument("--size", default="480x270", help="of the pictures, pixels")
options.add_argument("--truth", type=int, default=1024, help="rays for each pixel of the truth")
options.add_argument("--runs", type=int, default=3, help="of each technique, on the clock")
arguments = options.parse_args()
width, height = map(int, arguments.size.split("x"))

# %% Measure
#! [measure]
renderer = penumbra.Renderer()


def measure(scene, truth, technique, parameters):
    """Milliseconds of all lights, and the root mean square error in their penumbrae."""
    frame = renderer.render(scene, technique, parameters, size=(width, height), timed_runs=arguments.runs)
    cost_ms = sum(np.median(runs) for runs in frame.milliseconds.values())
    errors = [penumbra.compare(truth.visibility[light], frame.visibility[light], truth.reach[light])
              for light in frame.lights]
    return cost_ms, np.sqrt(np.mean([error["penumbra_rmse"] ** 2 for error in errors]))
#! [measure]


curves: dict[tuple[str, str], list[tuple[float, float]]] = {}
for name in SCENES:
    scene = penumbra.open_scene(name)
    truth = renderer.render(scene, "reference", {"samples": arguments.truth}, size=(width, height),
                            progress=lambda share: print(f"\r{name}: truth {share:4.0%}", end="", flush=True))
    print()
    for technique, (parameter, values) in SWEPT.items():
        curves[name, technique] = []
        for value in values:
            cost_ms, error = measure(scene, truth, technique, {parameter: value})
            curves[name, technique].append((cost_ms, error))
            print(f"  {technique:8} {parameter} {value:5}: {cost_ms:8.2f} ms, error {error:.4f}")

# %% Draw
figure, axes = plt.subplots(1, len(SCENES), figsize=(4 * len(SCENES), 3.6), sharey=True, layout="constrained")
for axis, name in zip(axes, SCENES):
    for technique, (parameter, values) in SWEPT.items():
        costs_ms, errors = zip(*curves[name, technique])
        axis.loglog(costs_ms, errors, "o-", label=f"{technique}, {parameter}")
        for value, cost_ms, error in zip(values, costs_ms, errors):
            axis.annotate(value, (cost_ms, error), textcoords="offset points", xytext=(5, 4), fontsize=7)
    axis.set(title=name, xlabel=f"cost of a frame's lights, ms\n({renderer.clock})")
    axis.grid(which="both", alpha=0.2)
    axis.margins(0.12)
axes[0].set_ylabel("error of visibility in the penumbra, rms")
axes[0].legend()
figure.savefig(arguments.output)
print(f"{arguments.output}: on {renderer.device}")
