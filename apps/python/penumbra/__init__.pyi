# SPDX-License-Identifier: Apache-2.0
# Types for checkers and editors. What each thing does is in its docstring: help(penumbra).
from collections.abc import Callable, Mapping, Sequence
from os import PathLike
from typing import Any, Literal, TypedDict, final

import numpy as np
from numpy.typing import ArrayLike, NDArray

__version__: str

Floats = NDArray[np.float32]
Light = Mapping[str, Any]

class Error(Exception): ...
class UsageError(Error): ...
class InputError(Error): ...
class DeviceError(Error): ...

class Device(TypedDict):
    name: str
    usable: bool
    why_not: str

@final
class Camera:
    def __init__(
        self,
        look_from: Sequence[float],
        look_at: Sequence[float],
        *,
        fov: float = 40,
        height: float | None = None,
    ) -> None: ...

@final
class Mesh:
    def __init__(
        self,
        positions: ArrayLike,
        triangles: ArrayLike,
        *,
        name: str = "mesh",
        color: Sequence[float] = (0.6, 0.6, 0.6),
        normals: ArrayLike | None = None,
        casts: bool = True,
        receives: bool = True,
    ) -> None: ...
    @property
    def name(self) -> str: ...
    @property
    def triangle_count(self) -> int: ...

@final
class Scene:
    @property
    def name(self) -> str: ...
    @property
    def warnings(self) -> list[str]: ...
    @property
    def duration(self) -> float: ...
    @property
    def lights(self) -> list[str]: ...
    @property
    def cameras(self) -> list[str]: ...
    @property
    def triangle_count(self) -> int: ...
    def with_lights(self, lights: Sequence[Light]) -> Scene: ...

@final
class Frame:
    @property
    def technique(self) -> str: ...
    @property
    def lights(self) -> list[str]: ...
    @property
    def exposure_ev(self) -> float: ...
    @property
    def visibility(self) -> dict[str, Floats]: ...
    @property
    def reach(self) -> dict[str, Floats]: ...
    @property
    def statistics(self) -> dict[str, dict[str, Any]]: ...
    @property
    def milliseconds(self) -> dict[str, list[float]]: ...
    @property
    def depth(self) -> Floats: ...
    @property
    def normals(self) -> Floats: ...
    @property
    def illuminance(self) -> Floats: ...
    @property
    def radiance(self) -> Floats: ...
    @property
    def display(self) -> Floats: ...

@final
class Renderer:
    def __init__(self, device: int | None = None) -> None: ...
    @property
    def device(self) -> str: ...
    @property
    def clock(self) -> str: ...
    def parameters(self, technique: str) -> list[dict[str, Any]]: ...
    def render(
        self,
        scene: Scene,
        technique: str = "auto",
        parameters: dict[str, bool | int | float | str] = {},
        *,
        size: tuple[int, int] = (960, 540),
        camera: Camera | str | int | None = None,
        time: float = 0.0,
        exposure: float | None = None,
        timed_runs: int = 0,
        progress: Callable[[float], object] | None = None,
    ) -> Frame: ...

def scenes() -> dict[str, str]: ...
def open_scene(
    name: str | PathLike[str],
    *,
    lights: str | PathLike[str] | None = None,
    scene: int | None = None,
    animations: Sequence[int] | None = None,
    glass: Literal["clear", "tinted", "blocks"] | None = None,
    unit: Literal["mm", "cm", "m", "in", "ft"] | None = None,
    up: Literal["y", "z"] | None = None,
) -> Scene: ...
def build_scene(meshes: Sequence[Mesh], lights: Sequence[Light], *, name: str = "built") -> Scene: ...
def techniques() -> dict[str, str]: ...
def devices() -> list[Device]: ...
def compare(truth: ArrayLike, test: ArrayLike, reach: ArrayLike | None = None) -> dict[str, float]: ...
