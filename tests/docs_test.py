#!/usr/bin/env python3
"""docs_test.py PROGRAM SOURCE_DIR: runs every command line of the program that README.md and docs/*.md show.

In a folder with the scenes and the files that the lines name; small pictures where a line names no size. Lines of
'view' need a display and are tested by window_test.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

PROGRAM = re.compile(r"^(?:\$ )?(?:build/release/bin/)?pinocchio (.*)$")
DRAWING = ("render", "measure", "chart")


def command_lines(text):
    """The program's arguments, of code blocks alone; continued lines joined."""
    inside = False
    for line in re.sub(r"\\\n\s*", "", text).splitlines():
        if line.startswith("```"):
            inside = not inside
        elif inside and (match := PROGRAM.match(line)):
            yield match[1].split("  #")[0].strip()


def main():
    program, source = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
    failed = count = 0
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        shutil.copytree(source / "scenes", "scenes", ignore=shutil.ignore_patterns("generator"))
        for made in ("generate cornell -o model.obj", "generate cornell -o boat.glb",
                     "render scenes/cornell.gltf --size 40x30 -o a.exr --quiet",
                     "render scenes/cornell.gltf --size 40x30 -o reference.exr --quiet",
                     "render scenes/cornell.gltf --size 40x20 -o sky.exr --aov none --quiet"):
            subprocess.run([program, *made.split()], check=True, stdout=subprocess.DEVNULL)
        pages = [source / "README.md", source / "CONTRIBUTING.md", *sorted((source / "docs").glob("*.md"))]
        for page in pages:
            for line in command_lines(page.read_text(encoding="utf-8")):
                verb = line.split()[0]
                if verb == "view" or "VERB" in line or "SCENE" in line or "DIR" in line:
                    continue
                small = " --size 32x24" if verb in DRAWING and "--size" not in line else ""
                small += " --only exchange --repeat 1" if verb == "chart" and "--only" not in line else ""
                count += 1
                run = subprocess.run(f"'{program}' {line}{small}", shell=True, capture_output=True, text=True, check=False)
                if run.returncode != 0:
                    failed += 1
                    print(f"{page.name}: pinocchio {line}\n  exit code {run.returncode}: {run.stderr.strip()}")
    print(f"{count} command lines, {failed} failed")
    sys.exit(1 if failed or count == 0 else 0)


if __name__ == "__main__":
    main()
