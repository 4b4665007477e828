#!/usr/bin/env python3
"""Error against samples and against time, for each sequence of samples: log-log, with slopes.

    convergence.py PINOCCHIO FOLDER [--size 320x240] [--most 1024] [--truth 8192] [--seeds 3] [--draw]

Each scene's lights get a size (SCENES), and each sequence 1, 4, 16, ... samples; the error is the root mean square
of linear light against a picture of many more samples with another seed. Written to FOLDER: results.json,
which holds what is measured already, a table, and convergence.svg (matplotlib). --draw draws from results.json alone.
"""
import argparse
import json
import math
import pathlib
import struct
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
SCENES = {"two-lights": "two-lights.gltf", "cornell": "cornell.gltf", "speedboat": "speedboat.glb", "terrace": "terrace.glb"}
# As wide as that share of the distance from the origin, so that penumbras and not edges of things make the error.
SIZE_OF_LIGHTS = 0.15
SEQUENCES = ["random", "sobol", "blue-noise"]
TRUTH_SEED = 1000


def with_sizes(name, folder):
    """A copy of the scene whose lights have a size."""
    file = SCENES[name]
    source = ROOT / "scenes" / file
    data = source.read_bytes()
    binary = b""
    if file.endswith(".glb"):
        length = struct.unpack_from("<I", data, 12)[0]
        scene, binary = json.loads(data[20:20 + length]), data[20 + length:]
    else:
        scene = json.loads(data)
        for buffer in scene["buffers"]:
            (folder / buffer["uri"]).write_bytes((source.parent / buffer["uri"]).read_bytes())
    lights = scene["extensions"]["KHR_lights_punctual"]["lights"]
    for node in scene["nodes"]:
        if "KHR_lights_punctual" not in node.get("extensions", {}):
            continue
        light = lights[node["extensions"]["KHR_lights_punctual"]["light"]]
        ours = light.setdefault("extras", {}).setdefault("pinocchio", {})
        if light["type"] == "directional":
            ours["angle"] = math.degrees(2 * math.atan(SIZE_OF_LIGHTS))
        else:
            ours["radius"] = SIZE_OF_LIGHTS * math.dist(node["translation"], (0, 0, 0))
    copy = folder / file
    if binary:
        text = json.dumps(scene).encode()
        text += b" " * (-len(text) % 4)
        copy.write_bytes(struct.pack("<4sII", b"glTF", 2, 20 + len(text) + len(binary)) +
                         struct.pack("<I4s", len(text), b"JSON") + text + binary)
    else:
        copy.write_text(json.dumps(scene))
    return copy


def render(arguments, scene, output, spp, sequence, seed, *options):
    """Seconds that the samples took, without loading and writing, and how many rays."""
    stats = output.with_suffix(".json")
    command = [arguments.pinocchio, "render", str(scene), "--size", arguments.size, "--mode", "raytrace", "--spp", str(spp),
               "--sequence", sequence, "--seed", str(seed), *options, "--aov", "none", "--quiet", "-o", str(output),
               "--stats-json", str(stats)]
    subprocess.run(command, check=True)
    figures = json.loads(stats.read_text())
    return figures["frame"]["ms"]["p50"] * spp / 1e3


def error(arguments, a, b):
    text = subprocess.run([arguments.pinocchio, "compare", str(a), str(b), "--json"], check=True, capture_output=True,
                          text=True).stdout
    return json.loads(text)["rmse"]


def slope(points, key):
    """The power to which error falls, by least squares in logarithms."""
    x = [math.log(p[key]) for p in points]
    y = [math.log(p["error"]) for p in points]
    mx, my = sum(x) / len(x), sum(y) / len(y)
    return sum((a - mx) * (b - my) for a, b in zip(x, y)) / sum((a - mx) ** 2 for a in x)


def measure(arguments):
    file = arguments.folder / "results.json"
    results = json.loads(file.read_text()) if file.exists() else {"size": arguments.size, "points": {}}
    for name in arguments.scene or SCENES:
        scene = with_sizes(name, arguments.folder)
        truth = arguments.folder / f"{name}-truth.exr"
        if not truth.exists():
            render(arguments, scene, truth, arguments.truth, "sobol", TRUTH_SEED)
        for sequence in SEQUENCES:
            spp = 1
            while spp <= arguments.most:
                key = f"{name} {sequence} {spp}"
                if key not in results["points"]:
                    picture = arguments.folder / "picture.exr"
                    runs = []
                    for seed in range(arguments.seeds):
                        seconds = render(arguments, scene, picture, spp, sequence, seed)
                        runs.append((seconds, error(arguments, picture, truth)))
                    results["points"][key] = {
                        "scene": name, "sequence": sequence, "spp": spp, "seconds": sorted(r[0] for r in runs)[len(runs) // 2],
                        "error": math.sqrt(sum(r[1] ** 2 for r in runs) / len(runs))}
                    file.write_text(json.dumps(results, indent=1))
                spp *= 4
    return results


def table(results):
    lines = ["| scene | sequence | error of 16 samples | of the most | slope, samples | slope, time |", "|---|---|---:|---:|---:|---:|"]
    for name in SCENES:
        for sequence in SEQUENCES:
            points = [p for p in results["points"].values() if p["scene"] == name and p["sequence"] == sequence]
            of = {p["spp"]: p["error"] for p in points}
            late = [p for p in points if p["spp"] >= 4]
            if len(late) > 2:
                lines.append(f"| {name} | {sequence} | {of.get(16, 0):.2g} | {of[max(of)]:.2g} | "
                             f"{slope(late, 'spp'):.2f} | {slope(late, 'seconds'):.2f} |")
    return "\n".join(lines)


def draw(results, folder):
    sys.path.insert(0, str(pathlib.Path(__file__).parent))
    sys.dont_write_bytecode = True
    from charts import COLOURS, MARKERS, plt

    names = [n for n in SCENES if any(p["scene"] == n for p in results["points"].values())]
    figure, axes = plt.subplots(2, len(names), figsize=(3.4 * len(names), 6.2), squeeze=False)
    for column, name in enumerate(names):
        for row, (key, label) in enumerate((("spp", "samples a pixel"), ("seconds", "seconds"))):
            at = axes[row][column]
            for i, sequence in enumerate(SEQUENCES):
                points = [p for p in results["points"].values() if p["scene"] == name and p["sequence"] == sequence]
                late = [p for p in points if p["spp"] >= 4]
                at.loglog([p[key] for p in points], [p["error"] for p in points], color=COLOURS[i], marker=MARKERS[i],
                          markersize=4, linewidth=1.2, label=f"{sequence} ({slope(late, key):.2f})")
            at.set_xlabel(label)
            at.legend(frameon=False, fontsize=8)
            if row == 0:
                at.set_title(name)
            if column == 0:
                at.set_ylabel("RMSE, linear light")
    figure.tight_layout()
    figure.savefig(folder / "convergence.svg", metadata={"Date": None})


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("pinocchio")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--size", default="320x240")
    parser.add_argument("--most", type=int, default=1024)
    parser.add_argument("--truth", type=int, default=8192)
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--scene", action="append", choices=list(SCENES))
    parser.add_argument("--draw", action="store_true")
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    results = json.loads((arguments.folder / "results.json").read_text()) if arguments.draw else measure(arguments)
    text = table(results)
    (arguments.folder / "table.md").write_text(text + "\n")
    print(text)
    draw(results, arguments.folder)


if __name__ == "__main__":
    main()
