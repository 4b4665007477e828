#!/usr/bin/env python3
"""docs_test.py PROGRAM SOURCE_DIR: runs every command line of the program that README.md and docs/*.md show.

In a folder with the scenes and the files that the lines name. Pictures are made smaller, but for tiles of one, and large numbers of
samples, frames and triangles are replaced (SMALLER). Lines of 'view' need a display and are tested by window_test. Of lines that take
minutes (scripts, pinocchio-bench) what they name is looked up: files of the tree, options. Farms' are run by tests/farm.
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
# Replaces large numbers by small ones, to save time: the line is checked, not its picture.
SMALLER = ((r"--spp \d{2,}", "--spp 4"), (r"--frames 0-\d{2,}", "--frames 0-4"), (r"--frames \d{2,}(?!-)\b", "--frames 4"),
           (r"--turntable \d{2,}", "--turntable 4"), (r"--triangles \d{5,}", "--triangles 1000"))


def command_lines(text):
    """Of code blocks without a language, continued lines joined."""
    block = None
    for line in re.sub(r"\\\n\s*", "", text).splitlines():
        if line.startswith("```"):
            block = line[3:] if block is None else None
        elif block == "" and line.strip():
            yield line.split("  #")[0].strip()


def looked_up(line, program, source):
    """What of a line is not there; none: all is, None: nobody knows such a command."""
    words = line.split()
    missing = [w for w in words if re.match(r"(scripts|farm|tests|examples)/", w) and not (source / w).exists()]
    options = re.findall(r"(?<=\s)--[a-z-]+", line)
    if words[0].startswith("scripts/"):
        known = (source / words[0]).read_text(encoding="utf-8") if not missing else ""
        known += subprocess.run([program, "chart", "--help"], capture_output=True, text=True, check=True).stdout
    elif words[0] == "pinocchio-bench":
        bench = program.with_name(words[0])
        if not bench.exists():  # built where Embree is found
            return missing
        known = subprocess.run([bench, "--help"], capture_output=True, text=True, check=True).stdout
    elif words[0] in ("sbatch", "openjd", "cmake", "export", "python3"):
        return missing
    else:
        return None
    return missing + [option for option in options if option not in known]


def failure(command):
    run = subprocess.run(["bash", "-c", command], capture_output=True, text=True, check=False)
    return "" if run.returncode == 0 else f"exit code {run.returncode}: {run.stderr.strip()}"


def main():
    program, source = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
    failed = count = 0
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        shutil.copytree(source / "scenes", "scenes", ignore=shutil.ignore_patterns("generator"))
        for made in ("generate cornell -o model.obj", "generate cornell -o model.glb", "generate cornell -o boat.glb",
                     "render scenes/cornell.gltf --size 40x30 -o a.exr --quiet",
                     "render scenes/cornell.gltf --size 40x30 -o reference.exr --quiet",
                     "render scenes/cornell.gltf --size 40x20 -o sky.exr --aov none --quiet"):
            subprocess.run([program, *made.split()], check=True, stdout=subprocess.DEVNULL)
        pages = [source / "README.md", source / "CONTRIBUTING.md", *sorted((source / "docs").glob("*.md"))]
        for page in pages:
            if page.name == "architecture.md":  # its blocks are diagrams
                continue
            for line in command_lines(page.read_text(encoding="utf-8")):
                count += 1
                error = ""
                if match := PROGRAM.match(line):
                    verb = match[1].split()[0]
                    if verb == "view" or "VERB" in line or "SCENE" in line or "DIR" in line:
                        continue
                    small = " --size 32x24" if verb in DRAWING and "--size" not in line else ""
                    if "--crop" not in line:
                        match = PROGRAM.match(re.sub(r"--size \d+x\d+", "--size 64x48", line))
                    small += " --repeat 1" if verb == "chart" else ""
                    small += " --only exchange" if verb == "chart" and "--only" not in line else ""
                    ours, pipe, theirs = match[1].partition(" | ")
                    for many, few in SMALLER:
                        ours = re.sub(many, few, ours)
                    # A reader that is not installed is replaced.
                    if pipe and not shutil.which(theirs.split()[0]):
                        theirs = "cat > /dev/null"
                    error = failure(f"set -o pipefail; '{program}' {ours}{small}{pipe}{theirs}")
                elif line.split()[0] in ("oiiotool", "convert", "cp", "sed"):
                    error = failure(line) if shutil.which(line.split()[0]) else ""
                elif line.startswith("scripts/sky "):
                    error = failure(f"'{source}/{line.split()[0]}' {line.split()[1]}")
                elif (missing := looked_up(line, program, source)) is None:
                    error = "no test knows this command"
                elif missing:
                    error = "not there: " + ", ".join(missing)
                if error:
                    failed += 1
                    print(f"{page.name}: {line}\n  {error}")
    print(f"{count} command lines, {failed} failed")
    sys.exit(1 if failed or count == 0 else 0)


if __name__ == "__main__":
    main()
