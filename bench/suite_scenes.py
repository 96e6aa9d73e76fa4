"""The scenes of the benchmark suite: where they are, and how they are rendered."""
import dataclasses
import hashlib
import os
import shutil
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(HERE)
SHARED = os.environ.get("ETENDUE_SHARED") or os.path.join(os.path.dirname(ROOT), "shared")


@dataclasses.dataclass(frozen=True)
class BenchScene:
    name: str
    what: str
    size: tuple
    spp: int
    kind: str  # "own" of this folder, "shared" beside the checkout, or "generated"
    only_all: bool = False  # takes too long for every run


SCENES = (
    BenchScene("cornell-limit", "the box that the limit program renders too", (256, 256), 32, "own"),
    BenchScene("cornell-box", "../shared/scenes/pbrt", (128, 128), 64, "shared"),
    BenchScene("veach-mis", "../shared/scenes/pbrt", (192, 108), 64, "shared"),
    BenchScene("teapot", "../shared/scenes/pbrt", (192, 108), 64, "shared"),
    BenchScene("classroom", "../shared/scenes/pbrt", (192, 108), 32, "shared"),
    BenchScene("veach-ajar", "../shared/scenes/pbrt", (192, 108), 32, "shared"),
    BenchScene("veach-bidir", "../shared/scenes/pbrt", (128, 128), 32, "shared"),
    BenchScene("triangles-1e6", "a landscape of 10^6 triangles", (320, 180), 64, "generated"),
    BenchScene("triangles-1e7", "a landscape of 10^7 triangles", (320, 180), 64, "generated", True),
    BenchScene("instances-1e5", "10^5 instances of a ball", (320, 180), 32, "generated"),
    BenchScene("lights-1e2", "10^2 of a million triangles emit", (160, 90), 64, "generated"),
    BenchScene("lights-1e3", "10^3 of them", (160, 90), 64, "generated", True),
    BenchScene("lights-1e4", "10^4 of them", (160, 90), 64, "generated"),
    BenchScene("lights-1e5", "10^5 of them", (160, 90), 64, "generated", True),
    BenchScene("lights-1e6", "all of them", (160, 90), 64, "generated", True),
    BenchScene("textures", "16 textures, 201 MB", (320, 180), 64, "generated"),
)


def generator_mark():
    """Tells whether generated scenes were made by these very scripts."""
    mark = hashlib.sha256()
    for name in ("generate.py", "many_lights.py"):
        with open(os.path.join(HERE, name), "rb") as f:
            mark.update(f.read())
    return mark.hexdigest()[:16]


def generate(name, folder, say):
    """Makes the scene in FOLDER/NAME unless it is there, whole or not at all; returns the scene file."""
    place = os.path.join(folder, name + "-" + generator_mark())
    if not os.path.isdir(place):
        os.makedirs(folder, exist_ok=True)
        for old in os.listdir(folder):
            if old.rsplit("-", 1)[0] == name:
                shutil.rmtree(os.path.join(folder, old))
        say(f"generating {name}")
        part = tempfile.mkdtemp(prefix="part-", dir=folder)
        try:
            subprocess.run([sys.executable, os.path.join(HERE, "generate.py"), name, part], check=True)
            os.rename(part, place)
        finally:
            shutil.rmtree(part, ignore_errors=True)
    return os.path.join(place, "scene.pbrt")


def find_scene(scene, folder, say):
    """The file of a scene, or nothing and why."""
    if scene.kind == "own":
        return os.path.join(HERE, scene.name + ".pbrt"), ""
    if scene.kind == "shared":
        file = os.path.join(SHARED, "scenes", "pbrt", scene.name, "scene.pbrt")
        return (file, "") if os.path.exists(file) else (None, f"there is no {file}")
    try:
        return generate(scene.name, folder, say), ""
    except (OSError, subprocess.CalledProcessError) as e:
        return None, f"it could not be generated: {e}"
