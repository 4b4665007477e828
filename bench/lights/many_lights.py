#!/usr/bin/env python3
"""Measures how many bytes a frame of many casting lights sends: many_lights.py PROGRAM SCENE > docs/measurements/many-lights.csv

Lamps in a spiral above the scene, beside its own lights, 400 x 300. For each number of lights that cast: the
automatic plan, narrower masks, the slides' bytes, design 2 and the CPU alone. Bytes a frame by `measure`, and the
picture's difference, linear, from the CPU's.
"""
import csv
import json
import math
import pathlib
import subprocess
import sys
import tempfile

CASTING = [8, 9, 16, 32, 40, 64, 65, 100]
WIDTHS = [8, 16, 32]
SIZE = ["--size", "400x300", "--quiet"]


def lamps(number):
    options = []
    for i in range(number):
        turn = 2.4 * i
        x, z = 5 * math.cos(turn), 5 * math.sin(turn)
        options += ["--light", f"{x:.3f},{3 + 2 * i / number:.3f},{z:.3f},{1 / number:.5f}"]
    return options


def run(*words):
    return subprocess.run(words, check=True, stdout=subprocess.PIPE, text=True).stdout


def plans_for(casting):
    plans = {"auto": []}
    for bits in WIDTHS if casting > 32 else []:
        plans[f"mask of {bits}"] = ["--mask-bits", str(bits)]
    return plans | {"slides": ["--plan", "slides"], "design 2": ["--design", "2"],
                    "raytrace": ["--mode", "raytrace"]}


def main(program, scene):
    own = json.loads(run(program, "info", scene, "--json"))["needs"]["casting_lights"]
    table = csv.writer(sys.stdout, lineterminator="\n")
    table.writerow(["casting lights", "plan", "mask bits", "mask bytes", "light bytes", "bytes to GPU", "shadow rays",
                    "RMSE", "FLIP"])
    with tempfile.TemporaryDirectory() as folder:
        truth, stats, picture = (f"{folder}/{name}" for name in ("truth.exr", "stats.json", "picture.exr"))
        for casting in CASTING:
            lit = [scene, *lamps(casting - own), *SIZE]
            run(program, "render", *lit, "--mode", "raytrace", "-o", truth)
            for name, options in plans_for(casting).items():
                run(program, "measure", *lit, *options, "--frames", "1", "--exchange", "sync", "--stats-json", stats)
                run(program, "render", *lit, *options, "-o", picture)
                error = json.loads(run(program, "compare", picture, truth, "--json"))
                figures = json.loads(pathlib.Path(stats).read_text())
                sent = figures["bytes"]["buffers"]
                table.writerow([casting, name, figures["plan"]["mask_bits"], sent.get("mask", 0),
                                sent.get("reflection", 0), figures["bytes"]["cpu_to_gpu"], figures["rays"]["shadow"],
                                f"{error['rmse']:.5f}", f"{error['flip']:.5f}"])
                sys.stdout.flush()


if __name__ == "__main__":
    main(*sys.argv[1:])
