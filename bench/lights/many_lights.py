#!/usr/bin/env python3
"""What many casting lights cost: many_lights.py PROGRAM SCENE > docs/measurements/many-lights.csv

Lamps in a spiral above the scene, beside its own lights, 800 x 600. For each number of them the automatic plan,
narrower masks, design 2 and the CPU alone: bytes a frame, milliseconds (medians of `--frames 9`, one after the
other, exchange sync), and the picture's largest difference, linear, from the CPU's.
"""
import csv
import json
import math
import pathlib
import subprocess
import sys
import tempfile

NUMBERS = [1, 8, 9, 16, 32, 40, 64, 65, 100, 400]
WIDTHS = [8, 16, 32]


def lamps(number):
    options = []
    for i in range(number):
        turn = 2.4 * i
        x, z = 5 * math.cos(turn), 5 * math.sin(turn)
        options += ["--light", f"{x:.3f},{3 + 2 * i / number:.3f},{z:.3f},{1 / number:.5f}"]
    return options


def run(*words):
    subprocess.run(words, check=True, stdout=subprocess.DEVNULL)


def main(program, scene):
    table = csv.writer(sys.stdout, lineterminator="\n")
    table.writerow(["lamps", "plan", "mask bytes", "light bytes", "bytes to GPU", "shadow rays", "shadow ms",
                    "composite ms", "frame ms", "largest difference"])
    with tempfile.TemporaryDirectory() as folder:
        for number in NUMBERS:
            plans = {"auto": []}
            plans |= {f"mask of {bits}": ["--mask-bits", str(bits)] for bits in WIDTHS if bits < number}
            plans |= {"slides": ["--plan", "slides"], "design 2": ["--design", "2"],
                      "raytrace": ["--mode", "raytrace"]}
            common = [scene, *lamps(number), "--size", "800x600", "--quiet"]
            truth = f"{folder}/truth.exr"
            run(program, "render", *common, "--mode", "raytrace", "-o", truth)
            for name, options in plans.items():
                stats, picture = f"{folder}/stats.json", f"{folder}/picture.exr"
                run(program, "measure", *common, *options, "--frames", "0-8", "--exchange", "sync", "--no-reuse",
                    "--stats-json", stats)
                run(program, "render", *common, *options, "-o", picture)
                compared = subprocess.run([program, "compare", picture, truth, "--json"], check=True,
                                          stdout=subprocess.PIPE, text=True).stdout
                figures = json.loads(pathlib.Path(stats).read_text())
                buffers, stages = figures["bytes"]["buffers"], figures["stages"]
                median = lambda stage: f"{stages.get(stage, {}).get('ms', {}).get('p50', 0):.1f}"
                table.writerow([number, name, buffers.get("mask", 0), buffers.get("reflection", 0),
                                figures["bytes"]["cpu_to_gpu"], figures["rays"]["shadow"], median("trace_shadow"),
                                median("composite"), f"{figures['frame']['ms']['p50']:.1f}",
                                f"{json.loads(compared)['max']:.4f}"])
                sys.stdout.flush()


if __name__ == "__main__":
    main(*sys.argv[1:])
