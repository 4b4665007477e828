"""Adds the licences of bundled libraries to a wheel: wheel_licences.py WHEEL FOLDER

auditwheel copies shared libraries into NAME.libs; each comes from a Debian package of this system. The package's
copyright file goes to NAME.dist-info/licenses, with a list of libraries, packages and versions.
"""
import base64
import csv
import hashlib
import io
import pathlib
import re
import subprocess
import sys
import zipfile


def package_of(library: str) -> str:
    """The Debian package that owns a library that auditwheel renamed from NAME.so.N to NAME-HASH.so.N."""
    name = re.sub(r"-[0-9a-f]{8,}(?=\.so)", "", library)
    for command in (["dpkg", "-S", f"*/{name}"], ["dpkg", "-S", f"*/{name}.*"]):
        found = subprocess.run(command, capture_output=True, text=True).stdout.splitlines()
        owners = sorted({line.split(":")[0] for line in found if re.search(r"/lib/[^/]*-linux-gnu/[^/]*$", line)})
        if owners:
            return owners[0]
    sys.exit(f"{library}: no Debian package owns {name}, so its licence is not known")


def main(wheel: str, folder: str) -> None:
    with zipfile.ZipFile(wheel) as archive:
        files = {name: archive.read(name) for name in archive.namelist()}
        infos = {info.filename: info for info in archive.infolist()}
    record = next(name for name in files if name.endswith(".dist-info/RECORD"))
    licences = record.replace("RECORD", "licenses/bundled")
    rows = ["Libraries in this wheel, the Debian packages that they come from, and the versions; each package's licence is beside this file.", ""]
    added = {}
    for library in sorted(name for name in files if ".libs/" in name and not name.endswith("/")):
        package = package_of(pathlib.PurePath(library).name)
        version = subprocess.check_output(["dpkg-query", "-W", "-f", "${Version}", package], text=True).split("\n")[0]
        added[f"{licences}/{package}.txt"] = pathlib.Path(f"/usr/share/doc/{package}/copyright").read_bytes()
        rows.append(f"{pathlib.PurePath(library).name}: {package} {version}")
    added[f"{licences}/LIBRARIES.txt"] = ("\n".join(rows) + "\n").encode()
    files.update(added)

    lines = io.StringIO()
    table = csv.writer(lines, lineterminator="\n")
    for name, content in files.items():
        if name != record and not name.endswith("/"):
            digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
            table.writerow([name, f"sha256={digest}", len(content)])
    table.writerow([record, "", ""])
    files[record] = lines.getvalue().encode()

    with zipfile.ZipFile(pathlib.Path(folder) / pathlib.Path(wheel).name, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            archive.writestr(infos.get(name, zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))), content,
                             compress_type=zipfile.ZIP_DEFLATED)


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2])
