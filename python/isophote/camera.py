"""The observer: cameras, their windows, and how pixels are sampled."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._convert import Matrix, Number, Pair, Size, Vector, Whole, matrix, word
from ._convert import size as two_whole
from ._part import Part, of_argument
from ._types import Filter, Handedness, Projection
from .errors import ArgumentError

__all__ = ["Camera", "Intrinsics", "Pose", "Sampling", "Screen", "Window"]


@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class Screen(Part):
    """The window of a perspective camera.

    - ``distance``: of its plane from the eye, a length in the scene's unit, 1e-12 to 1e15 m
    - ``x``: its left and right edges in the scene's unit, the smaller first, within ±1e15 m
    - ``y``: its lower and upper edges, likewise within ±1e15 m
    """

    distance: Number
    x: Pair
    y: Pair


@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class Window(Part):
    """The window of an orthographic camera, on the plane through the eye.

    - ``x``: its left and right edges in the scene's unit, the smaller first, within ±1e15 m
    - ``y``: its lower and upper edges, likewise within ±1e15 m
    """

    x: Pair
    y: Pair


@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class Intrinsics(Part):
    """The intrinsic parameters of a calibrated pinhole camera (2.11), in pixels, as in OpenCV: the centre of the top left
    pixel is (0, 0), y runs down.

    - ``fx``, ``fy``: the focal length in widths and in heights of a pixel, 1e-3 to 1e9
    - ``cx``, ``cy``: column and row of the principal point, −1e9 to 1e9
    """

    fx: Number
    fy: Number
    cx: Number
    cy: Number


@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class Pose(Part):
    """Where a calibrated camera is (2.12): rotation · P + translation is a point P in the camera's axes, of which x runs to
    the right, y down, and z along the direction of view.

    - ``rotation``: three rows, the camera's axes in those of the scene; orthonormal to within 1e-6, with determinant 1
    - ``translation``: where the scene's origin is in the camera's axes, in the scene's unit, each coordinate within ±1e15 m
    """

    rotation: Matrix
    translation: Vector


@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class Camera(Part):
    """The observer (2.1), (2.3).

    - ``eye``: a point, each coordinate within ±1e15 m
    - ``forward``: where it looks, a direction of any length but 0
    - ``target``: instead, a point to look at, each coordinate within ±1e15 m
    - ``tilt``: instead, the angle of view from −z in degrees, 0 to 180: 0 is straight down
    - ``azimuth``: with it, the way that the view leans, from +x towards +y, in degrees, −360 to 360
    - ``up``: the direction that appears vertical, of any length but 0, not parallel to the one of view; by default +y, unless
      the view is along it
    - ``projection``: ``"perspective"`` (with a ``screen`` or a ``field_of_view``), ``"orthographic"`` (with a ``window``,
      2.7), ``"fisheye-equidistant"`` (2.8) or ``"fisheye-equal-area"`` (2.9; both with a ``field_of_view``), or
      ``"panorama"`` (with ``longitude`` and ``latitude``, 2.10)
    - ``screen``: the window of a perspective camera
    - ``intrinsics``: instead, those of a calibrated one
    - ``pose``: the place of a calibrated camera, instead of ``eye``, ``forward``, ``target``, the angles and ``up``; the
      scene must be right-handed
    - ``field_of_view``: in degrees: across the width of a perspective image, 1e-6 to 179.9999; across the circle of a fisheye,
      1e-6 to 360
    - ``window``: that of an orthographic camera
    - ``longitude``: left and right edges of a panorama, in degrees from the direction of view, −360 to 360, the smaller
      first
    - ``latitude``: its lower and upper edges in degrees, −90 to 90, the smaller first
    - ``resolution``: columns and rows, 1 to 1,000,000 each
    """

    eye: Vector | None = None
    forward: Vector | None = None
    target: Vector | None = None
    tilt: Number | None = None
    azimuth: Number | None = None
    up: Vector | None = None
    projection: Annotated[Projection, word] = "perspective"
    screen: Screen | None = None
    intrinsics: Intrinsics | None = None
    pose: Pose | None = None
    field_of_view: Number | None = None
    window: Window | None = None
    longitude: Pair | None = None
    latitude: Pair | None = None
    resolution: Size = (800, 600)

    @classmethod
    def from_opencv(cls, K: ArrayLike, R: ArrayLike, t: ArrayLike, size: Size) -> Camera:
        """The camera of a calibration, as by ``cv2.calibrateCamera`` and ``cv2.Rodrigues``, for a right-handed scene.

        ``K``: the camera matrix, 3 × 3 in pixels, without skew. ``R``, ``t``: from the axes of the scene to those of the
        camera, 3 × 3 and 3 (or 3 × 1) in the scene's unit. ``size``: columns and rows. The lens has no distortion; for one
        that has, undistort points and ask for them with ``probe(screen=…)``.
        """
        camera_matrix = np.asarray(of_argument(matrix, K, "K"))
        if (camera_matrix[2] != (0, 0, 1)).any() or camera_matrix[1, 0] != 0 or camera_matrix[0, 1] != 0:
            raise ArgumentError(
                f"K is {camera_matrix.tolist()}; allowed: [[fx, 0, cx], [0, fy, cy], [0, 0, 1]], without skew"
            )
        fx, cx, fy, cy = (float(camera_matrix[place]) for place in ((0, 0), (0, 2), (1, 1), (1, 2)))
        translation = np.asarray(t)
        return cls(
            intrinsics=Intrinsics(fx=fx, fy=fy, cx=cx, cy=cy),
            pose=Pose(rotation=R, translation=translation.reshape(3) if translation.size == 3 else translation),  # type: ignore[arg-type]
            resolution=of_argument(two_whole, size, "size"),
        )

    def to_opencv(
        self, handedness: Handedness = "right"
    ) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
        """``K``, ``R`` and ``t`` of a perspective camera, as :meth:`from_opencv` takes them. In a scene of the other
        ``handedness``, x runs the other way and there is no such rotation."""
        if self.projection != "perspective":
            raise ArgumentError(f"the projection is {self.projection!r}; allowed: perspective, of which there is a matrix")
        if handedness != "right":
            raise ArgumentError(f"handedness is {handedness!r}; allowed: 'right': from other axes there is no rotation")
        return (_camera_matrix(self), *_rotation_and_translation(self))


def _camera_matrix(camera: Camera) -> NDArray[np.float64]:
    """K (2.11)."""
    width, height = camera.resolution
    if camera.intrinsics is not None:
        fx, fy, cx, cy = camera.intrinsics.fx, camera.intrinsics.fy, camera.intrinsics.cx, camera.intrinsics.cy
    elif camera.screen is not None:
        (left, right), (bottom, top), distance = camera.screen.x, camera.screen.y, camera.screen.distance
        fx, fy = distance * width / (right - left), distance * height / (top - bottom)
        cx, cy = -left / (right - left) * width - 0.5, top / (top - bottom) * height - 0.5
    elif camera.field_of_view is not None:
        fx = fy = width / 2 / float(np.tan(np.radians(camera.field_of_view) / 2))
        cx, cy = (width - 1) / 2, (height - 1) / 2
    else:
        raise ArgumentError("the camera has neither screen, intrinsics nor field_of_view")
    return np.array([[fx, 0.0, cx], [0.0, fy, cy], [0.0, 0.0, 1.0]])


def _rotation_and_translation(camera: Camera) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """R and t (2.12)."""
    if camera.pose is not None:
        return np.array(camera.pose.rotation), np.array(camera.pose.translation)
    forward, up = _aim(camera)
    eye = np.array(camera.eye)
    forward = forward / np.linalg.norm(forward)
    right = np.cross(forward, up)
    if not np.linalg.norm(right) > 0:
        raise ArgumentError("camera.up is parallel to the direction of view; allowed: any other direction")
    right = right / np.linalg.norm(right)
    rotation = np.stack([right, np.cross(forward, right), forward])
    return rotation, -rotation @ eye


def _aim(camera: Camera) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The direction of view and the one that appears vertical, as the core takes them from the fields."""
    rise = None
    if camera.eye is not None and camera.tilt is not None:
        tilt, azimuth = np.radians(camera.tilt), np.radians(90.0 if camera.azimuth is None else camera.azimuth)
        level = np.array([np.cos(azimuth), np.sin(azimuth), 0.0])
        forward = np.sin(tilt) * level - [0.0, 0.0, np.cos(tilt)]
        rise = np.cos(tilt) * level + [0.0, 0.0, np.sin(tilt)]
    elif camera.eye is not None and camera.forward is not None:
        forward = np.array(camera.forward)
    elif camera.eye is not None and camera.target is not None:
        forward = np.array(camera.target) - np.array(camera.eye)
    else:
        raise ArgumentError("the camera has neither a pose, nor an eye with forward, target or tilt")
    if camera.up is not None:
        return forward, np.array(camera.up)
    if rise is not None:
        return forward, rise
    is_along_y = np.hypot(forward[0], forward[2]) < 1e-6 * np.linalg.norm(forward)
    return forward, np.array([0.0, 0.0, np.sign(forward[1])] if is_along_y else [0.0, 1.0, 0.0])


@dataclass(frozen=True, kw_only=True, repr=False, eq=False)
class Sampling(Part):
    """How many rays make up a pixel's value (2.6).

    - ``samples``: the number of rays, 1 to 4096; with a tolerance, the most (4096)
    - ``tolerance``: instead, the allowed error as a fraction of the maximum brightness, 1e-4 to 1
    - ``filter``: ``"box"``, ``"triangle"``, ``"gaussian"`` or ``"mitchell"``
    """

    samples: Whole | None = None
    tolerance: Number | None = None
    filter: Annotated[Filter, word] = "box"
