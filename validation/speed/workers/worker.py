"""Starts one contestant by its name: as a worker that lives on (`worker.py NAME`), or for a single image from the start
of the process to a file (`worker.py NAME scene.json image.png`)."""

import json
import sys

import protocol


def contestant(name: str) -> protocol.InProcess | protocol.Command:
    """A program is imported only when it is asked for: the start of the others is none of its own."""
    match name:
        case "numpy":
            from numpy_worker import NumPy

            return NumPy()
        case "numba-expert":
            from numba_worker import Numba

            return Numba()
        case "numba-tuned-double" | "numba-tuned-single" | "numba-tuned-single-reuse":
            import numpy as np
            from numba_tuned_worker import TunedNumba

            return TunedNumba(np.float64 if name.endswith("double") else np.float32, name.endswith("reuse"))
        case "drjit-double":
            from drjit_worker import DrJit

            return DrJit()
        case "mitsuba-llvm-lambert" | "mitsuba-llvm-blinn" | "mitsuba-scalar-lambert":
            from mitsuba_worker import Mitsuba

            return Mitsuba("scalar_rgb" if "scalar" in name else "llvm_ad_mono", name.endswith("blinn"))
        case "radiance-1" | "radiance-2":
            from radiance_worker import Radiance

            return Radiance(processes=int(name[-1]))
        case "povray-lambert":
            from povray_worker import PovRay

            return PovRay()
        case "scene-mitsuba-script" | "scene-mitsuba-direct" | "scene-mitsuba-scalar":
            from scene_mitsuba_worker import SceneMitsuba

            return SceneMitsuba("scalar_rgb" if name.endswith("scalar") else "llvm_ad_mono", name.endswith("script"))
        case "scene-embree-primary" | "scene-embree-shadow":
            from scene_embree_worker import BareRays

            return BareRays(name.rsplit("-", 1)[1])
        case "scene-trimesh":
            from scene_embree_worker import MeshPicture

            return MeshPicture()
        case "scene-povray":
            from scene_povray_worker import ScenePovRay

            return ScenePovRay()
        case "scene-radiance-1" | "scene-radiance-2":
            from scene_radiance_worker import SceneRadiance

            return SceneRadiance(processes=int(name[-1]))
    raise ValueError(f'contestant "{name}": worker.py does not know it')


def main() -> None:
    name, *files = sys.argv[1:]
    program = contestant(name)
    if not files:
        protocol.serve(program)
        return
    scene, image = files
    with open(scene) as file:
        program.load(json.load(file))
    program.save(program.render(), image)


main()
