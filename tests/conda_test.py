"""The conda recipe has the version of the tree and a package for each that CMake looks for; rattler-build reads it.

conda_test.py SOURCE_DIR; 77: skipped
"""
import pathlib
import re
import sys

try:
    import yaml
except ImportError:
    print("skipped: python3-yaml is missing")
    sys.exit(77)

source = pathlib.Path(sys.argv[1])
RECIPE = source / "conda/recipe.yaml"
# What the module's CMake files look for, and the package of conda-forge that has it.
PACKAGE_OF = {
    "Boost": "libboost-headers", "Imath": "imath", "OpenEXR": "openexr", "Python": "python", "draco": "draco",
    "glfw3": "glfw", "glm": "glm", "libdeflate": "libdeflate", "libisal": "isa-l", "libturbojpeg": "libjpeg-turbo", "libwebp": "libwebp-base", "meshoptimizer": "meshoptimizer",
    "nanobind": "nanobind", "nlohmann_json": "nlohmann_json", "spng": "libspng", "tl-expected": "tl-expected", "glad": "glad2",
    "PkgConfig": "pkg-config",
}
OF_THE_COMPILER = {"Threads", "PinocchioRenderer"}


def looked_for():
    names = set()
    files = [source / "cmake/settings.cmake", source / "python/CMakeLists.txt"]
    files += [file for room in ("core", "gl", "hybrid") for file in (source / room).rglob("CMakeLists.txt")]
    for file in files:
        text = re.sub(r"#.*", "", file.read_text(encoding="utf-8"))
        names.update(re.findall(r"find_package\((\S+?)[\s)]", text))
        for modules in re.findall(r"pkg_check_modules\(\S+ REQUIRED IMPORTED_TARGET ([^)]*)\)", text):
            names.update(modules.split())
        names.update(re.findall(r"-m (glad)\b", text))
    return names - OF_THE_COMPILER


def main():
    recipe = yaml.safe_load(RECIPE.read_text(encoding="utf-8"))
    version = re.search(r"project\(pinocchio VERSION ([0-9.]+)", (source / "CMakeLists.txt").read_text(encoding="utf-8"))[1]
    assert recipe["context"]["version"] == version, f"conda/recipe.yaml is of version {recipe['context']['version']}, the tree {version}"
    required = {entry.split()[0] for entry in recipe["requirements"]["build"] + recipe["requirements"]["host"]}
    names = looked_for()
    unknown = sorted(names - PACKAGE_OF.keys())
    assert not unknown, f"CMake looks for {unknown}: give its package of conda-forge in tests/conda_test.py and conda/recipe.yaml"
    assert names == PACKAGE_OF.keys(), f"no CMake file looks for {sorted(PACKAGE_OF.keys() - names)}"
    missing = sorted(PACKAGE_OF[name] for name in names if PACKAGE_OF[name] not in required)
    assert not missing, f"conda/recipe.yaml lacks {missing}"
    assert (source / "LICENSE").is_file() and recipe["about"]["license_file"] == "LICENSE"
    try:
        import rattler_build
    except ImportError:
        print("rattler-build is not installed (pip install py-rattler-build): the recipe was not rendered")
        return
    variants = rattler_build.VariantConfig({"python": ["3.11.*", "3.12.*"], "c_compiler": ["gcc"], "cxx_compiler": ["gxx"], "c_stdlib": ["sysroot"]})
    rendered = rattler_build.Stage0Recipe.from_file(str(RECIPE)).render(variants)
    builds = [one.recipe.to_dict()["build"]["string"] for one in rendered]
    assert len(builds) == 2 and builds[0].startswith("py311") and builds[1].startswith("py312"), builds
    print("rattler-build renders", *builds)


if __name__ == "__main__":
    main()
