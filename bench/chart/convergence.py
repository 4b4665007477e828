#!/usr/bin/env python3
"""Error against samples and against time, for each sequence of samples: log-log, with slopes.

    convergence.py PINOCCHIO FOLDER [--size 320x240] [--most 1024] [--truth 8192] [--seeds 3] [--scene NAME]... [--draw]

Each scene's lights get a size (SIZE_OF_LIGHTS), and each sequence 1, 4, 16, ... samples; --max-noise stops them where a tile is good
enough. The error is the root mean square of linear light against a picture of many more samples with another seed; the bias is
that of the whole picture's mean, with its standard error over the seeds; time is the processor's, of all threads. Written to FOLDER: results.json,
which holds what is measured already, table.md, max-noise.csv, and convergence.svg (needs matplotlib and numpy). --draw draws from results.json alone.
"""
import argparse
import csv
import json
import math
import pathlib
import resource
import struct
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
SCENES = {"two-lights": "two-lights.gltf", "cornell": "cornell.gltf", "speedboat": "speedboat.glb", "terrace": "terrace.glb"}
# As wide as that share of the distance from the origin, so that penumbras and not edges of things make the error.
SIZE_OF_LIGHTS = 0.15
# Light above it counts as it: few highlights of thousands would be all of the error.
MOST_LIGHT = {"terrace": 1.0}
SEQUENCES = ["random", "sobol", "blue-noise"]
MAX_NOISE = [0.032, 0.016, 0.008, 0.004]
ADAPTIVE = "sobol, --max-noise"
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
    """The processor's seconds, loading and writing included, and how many samples there were a pixel."""
    stats = output.with_suffix(".json")
    command = [arguments.pinocchio, "render", str(scene), "--size", arguments.size, "--mode", "raytrace", "--spp", str(spp),
               "--sequence", sequence, "--seed", str(seed), *options, "--aov", "none", "--compression", "none", "--quiet", "-o", str(output),
               "--stats-json", str(stats)]
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    figures = json.loads(stats.read_text())
    width, height = (int(n) for n in arguments.size.split("x"))
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, figures["rays"]["primary"] * figures["frames"] / (width * height)


def pixels(arguments, file):
    """Linear RGB of an EXR as render() writes it: A, B, G, R in halves, line by line, at the end of the file."""
    import numpy

    width, height = (int(n) for n in arguments.size.split("x"))
    lines = numpy.frombuffer(file.read_bytes()[-height * (8 + 8 * width):], numpy.uint8).reshape(height, -1)[:, 8:]
    return numpy.ascontiguousarray(lines).view(numpy.float16).reshape(height, 4, width)[:, 3:0:-1].astype(numpy.float64)


def measured(arguments, scene, truth, spp, sequence, *options):
    """Over the seeds: error, bias, samples and seconds."""
    import numpy

    most = MOST_LIGHT.get(scene.stem, math.inf)
    exact = numpy.minimum(pixels(arguments, truth), most)
    picture = arguments.folder / "picture.exr"
    errors, means, seconds, samples = [], [], [], []
    for seed in range(arguments.seeds):
        took, taken = render(arguments, scene, picture, spp, sequence, seed, *options)
        apart = numpy.minimum(pixels(arguments, picture), most) - exact
        errors.append((apart ** 2).mean())
        means.append(apart.mean() / exact.mean())
        seconds.append(took)
        samples.append(taken)
    spread = float(numpy.std(means, ddof=1) / math.sqrt(len(means))) if len(means) > 1 else None
    return {"error": math.sqrt(sum(errors) / len(errors)), "bias": sum(means) / len(means), "bias_error": spread,
            "cpu_seconds": sorted(seconds)[len(seconds) // 2], "spp": sum(samples) / len(samples)}


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
            part = truth.with_name(f"{name}-part.exr")
            render(arguments, scene, part, arguments.truth, "sobol", TRUTH_SEED)
            part.rename(truth)
        wanted = [(sequence, spp, (sequence, spp)) for sequence in SEQUENCES
                  for spp in (4 ** k for k in range(10)) if spp <= arguments.most]
        wanted += [(ADAPTIVE, noise, ("sobol", arguments.most, "--max-noise", str(noise))) for noise in MAX_NOISE]
        for series, value, (sequence, spp, *options) in wanted:
            key = f"{name} {series} {value}"
            if key not in results["points"]:
                found = measured(arguments, scene, truth, spp, sequence, *options)
                results["points"][key] = {"scene": name, "series": series, "value": value, **found}
                file.write_text(json.dumps(results, indent=1))
                print(key, found, file=sys.stderr, flush=True)
    return results


def series_of(results, name, series):
    """From few samples to many; "seconds" without what no sample costs, by a line through all times of the scene."""
    points = [p for p in results["points"].values() if p["scene"] == name]
    even = [(p["spp"], p["cpu_seconds"]) for p in points if p["series"] != ADAPTIVE]
    if len(even) < 2:
        return []
    mx, my = (sum(column) / len(even) for column in zip(*even))
    a_sample = sum((x - mx) * (y - my) for x, y in even) / sum((x - mx) ** 2 for x, _ in even)
    start = my - a_sample * mx
    mine = sorted((p for p in points if p["series"] == series), key=lambda p: p["spp"])
    return [{**p, "seconds": max(p["cpu_seconds"] - start, 0.5 * a_sample)} for p in mine]


def table(results):
    lines = ["| scene | samples by | error of 16 | of the most | slope, samples | slope, time |", "|---|---|---:|---:|---:|---:|"]
    for name in SCENES:
        for sequence in SEQUENCES:
            points = series_of(results, name, sequence)
            late = [p for p in points if p["spp"] >= 4]
            if len(late) > 2:
                of = {p["value"]: p["error"] for p in points}
                lines.append(f"| {name} | {sequence} | {of.get(16, 0):.2g} | {points[-1]['error']:.2g} ({points[-1]['value']}) | "
                             f"{slope(late, 'spp'):.2f} | {slope(late, 'seconds'):.2f} |")
    return "\n".join(lines)


def adaptive_rows(results):
    """--max-noise: what each limit costs, its error beside as many samples for all, and how far the picture's mean is off."""
    rows = [("scene", "max-noise", "samples a pixel", "error", "as many for all", "bias, %", "its standard error, %")]
    for name in SCENES:
        every = series_of(results, name, "sobol")
        for p in reversed(series_of(results, name, ADAPTIVE)):
            error = f"{2 ** between(every, math.log2(p['spp'])):.2g}" if len(every) > 1 else ""
            rows.append((name, p["value"], f"{p['spp']:.1f}", f"{p['error']:.2g}", error, f"{100 * p['bias']:+.3f}",
                         "" if p["bias_error"] is None else f"{100 * p['bias_error']:.3f}"))
    return rows


def between(points, at):
    """log2 of the error at log2 of the samples, by straight lines."""
    known = [(math.log2(p["spp"]), math.log2(p["error"])) for p in points]
    for (x0, y0), (x1, y1) in zip(known, known[1:]):
        if at <= x1:
            return y0 + (y1 - y0) * (at - x0) / (x1 - x0)
    return known[-1][1]


def draw(results, folder):
    sys.path.insert(0, str(pathlib.Path(__file__).parent))
    sys.dont_write_bytecode = True
    from charts import COLOURS, MARKERS, grid, plt, save

    names = [n for n in SCENES if any(p["scene"] == n for p in results["points"].values())]
    figure, axes = plt.subplots(2, len(names), figsize=(3.5 * len(names), 6.6), squeeze=False, sharey="col")
    for column, name in enumerate(names):
        for row, (key, label) in enumerate((("spp", "samples a pixel"), ("seconds", "seconds of the processor"))):
            at = axes[row][column]
            for i, series in enumerate((*SEQUENCES, ADAPTIVE)):
                points = series_of(results, name, series)
                late = [p for p in points if p["spp"] >= 4]
                steep = f" ({slope(late, key):.2f})" if len(late) > 2 and series != ADAPTIVE else ""
                at.loglog([p[key] for p in points], [p["error"] for p in points], color=COLOURS[i], marker=MARKERS[i],
                          markersize=4, linewidth=1.2, linestyle="none" if series == ADAPTIVE else "-", label=series + steep)
            grid(at)
            at.set_xlabel(label)
            at.legend(frameon=False, fontsize=8, loc="lower left")
            if row == 0:
                at.set_title(name)
            if column == 0:
                at.set_ylabel("RMSE, linear light")
    figure.tight_layout()
    save(figure, folder / "convergence.svg")


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
    with (arguments.folder / "max-noise.csv").open("w", encoding="utf-8", newline="") as out:
        csv.writer(out, lineterminator="\n").writerows(adaptive_rows(results))
    draw(results, arguments.folder)


if __name__ == "__main__":
    main()
