"""The steps of docs/workflow.yml run as GitHub Actions runs them, where the package is installed already: pictures as
expected pass, a changed scene fails with a JUnit report and heat maps.

workflow_test.py PROGRAM SOURCE_DIR; 77: skipped
"""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

try:
    import yaml
except ImportError:
    print("skipped: python3-yaml is missing")
    sys.exit(77)

program, source = (pathlib.Path(argument).resolve() for argument in sys.argv[1:])


def run(step, folder):
    """Its exit code. As the runner does: bash that ends at the first error."""
    path = f"{program.parent}:{os.environ['PATH']}"
    return subprocess.run(["bash", "-e", "-c", step["run"]], cwd=folder, env=os.environ | {"PATH": path}).returncode


def main():
    job = yaml.safe_load((source / "docs/workflow.yml").read_text())["jobs"]["pictures"]
    steps = {step.get("name"): step for step in job["steps"]}
    assert job["container"] == "debian:12" and "pinocchio_*.deb" in steps["Install"]["run"]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "scenes").mkdir()
        for file in source.glob("scenes/cornell.*"):
            shutil.copy(file, folder / "scenes")
        assert run(steps["Render"], folder) == 0
        (folder / "actual").rename(folder / "expected")
        assert run(steps["Render"], folder) == 0
        assert run(steps["Compare"], folder) == 0, "the same pictures differ"

        scene = folder / "scenes/cornell.gltf"
        red = "0.5799999833106995"
        scene.write_text(scene.read_text().replace(red, "0.2"))
        assert run(steps["Render"], folder) == 0
        assert run(steps["Compare"], folder) == 5, "a changed scene is not seen"
        report = xml.etree.ElementTree.parse(folder / "pictures.xml").getroot()
        assert list(report.iter("failure")), "no failure in the report"
        kept = next(step for step in job["steps"] if step.get("if") == "failure()")["with"]["path"].split()
        missing = [path for path in kept if not (folder / path).exists()]
        assert not missing and list((folder / "heatmaps").iterdir()), f"nothing to upload: {missing}"


main()
