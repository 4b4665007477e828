"""The figures as tables: of docs/materials.md between <!-- begin X --> and <!-- end X -->, and all rows in one file.

Long tables are CSV files in docs/measurements, and the page links to them.
"""
import csv
import re

import numpy

import bias
import shapes
from spheres import share, worst_colour

LEAST_NOISE = 0.01  # less is not seen: what is exact under an even sky is no measure
BARS = {"noise, equal samples": 1.15, "noise, equal time": 0.7, "white furnace, brightest ring": 1.005, "mean colour, beside mix": 0.03, "mean colour, beside view": 0.03,
        "mean colour, flat normals, beside mix": 0.03}


IN_FILES = {"furnace": "The white furnace at each metallic and roughness", "means": "Ours over each reference at each metallic and roughness",
            "colours": "The colours at each metallic and roughness", "noise": "The noise at each metallic and roughness", "models": "Every model"}


def ratios(row):
    a, b = row["ours"], row["theirs"]
    least = max(b["noise"], LEAST_NOISE)
    return {"noise, equal samples": a["noise"] / least, "noise, equal time": a["noise_in_their_time"] / least,
            **{f"mean colour, beside {c}": worst_colour(a["mean"], mean) for c, mean in row["appendix_b"].items()},
            **({"mean colour, flat normals, beside mix": worst_colour(row["flat"]["ours"], row["flat"]["appendix_b"])} if "flat" in row else {})}


def matrix(rows, value, form):
    """Metallic down, roughness across."""
    cells = {(r["metallic"], r["roughness"]): value(r) for r in rows}
    across, down = sorted({k[1] for k in cells}), sorted({k[0] for k in cells})
    lines = ["| metallic \\ roughness | " + " | ".join(f"{r:g}" for r in across) + " |", "|---:|" + "---:|" * len(across)]
    lines += [f"| {m:g} | " + " | ".join(form.format(cells[m, r]) if (m, r) in cells else "" for r in across) + " |" for m in down]
    return "\n".join(lines)


def matrices(named):
    """Several of them as one table: what a row is stands before it."""
    head, *_ = (table.splitlines()[:2] for table in named.values())
    lines = [f"| figure {head[0]}", f"|---{head[1]}"]
    lines += [f"| {name} {row}" for name, table in named.items() for row in table.splitlines()[2:]]
    return "\n".join(lines)


def coloured(rows):
    """Means of dielectrics and half metals over the reference, with all four ways to couple the matt part."""
    lines = ["| base colour | metallic | roughness | / principled | / mix | / short | / view | / none | worst channel / mix |", "|---|---:|---:|---:|---:|---:|---:|---:|---:|"]
    for r in rows:
        mean = r["ours"]["mean"]
        cells = [share(mean, r["theirs"]["mean"])] + [share(mean, r["appendix_b"][c]) for c in ("mix", "short", "view", "none")]
        lines.append(f"| {r['name'].split('-m')[0].replace('-', ' ')} | {r['metallic']:g} | {r['roughness']:g} | " + " | ".join(f"{c:.3f}" for c in cells) +
                     f" | {worst_colour(mean, r['appendix_b']['mix']):.1%} |")
    return "\n".join(lines)


def furnace(rows):
    """Ours and two of the references, metallic and which down, roughness across."""
    across = sorted({r["roughness"] for r in rows})
    lines = ["| metallic | | " + " | ".join(f"{r:g}" for r in across) + " |", "|---:|---|" + "---:|" * len(across)]
    kinds = {"mean": lambda r: r["furnace"]["mean"], "centre": lambda r: r["furnace"]["centre"], "brightest ring": lambda r: r["furnace"]["brightest_ring"],
             "*mix*, mean": lambda r: numpy.mean(r["appendix_b"]["mix"]), "*view*, mean": lambda r: numpy.mean(r["appendix_b"]["view"])}
    for metallic in (0.0, 0.5, 1.0):
        chosen = {r["roughness"]: r for r in rows if r["metallic"] == metallic}
        for name, value in kinds.items():
            lines.append(f"| {metallic:g} | {name} | " + " | ".join(f"{value(chosen[r]):.3f}" for r in across if r in chosen) + " |")
    return "\n".join(lines)


def of_models(rows):
    lines = ["| model | mean / principled | / appendix B | worst channel | worst channel, flat normals | noise: ours | noise: Mitsuba | equal samples | ms: ours | ms: Mitsuba | equal time | fireflies: ours | fireflies: Mitsuba |",
             "|---|" + "---:|" * 12]
    for r in rows:
        a, b, of = r["ours"], r["theirs"], ratios(r)
        lines.append(f"| {r['name']} | {share(a['mean'], b['mean']):.3f} | {share(a['mean'], r['appendix_b']['mix']):.3f} | {of['mean colour, beside mix']:.1%} | "
                     f"{of['mean colour, flat normals, beside mix']:.1%} | {a['noise']:.3f} | "
                     f"{b['noise']:.3f} | {of['noise, equal samples']:.2f} | {a['ms']:.0f} | {b['ms']:.0f} | {of['noise, equal time']:.2f} | {a['fireflies']} | {b['fireflies']} |")
    return "\n".join(lines)


def bars(spheres, models):
    """Each bar, how many keep it, and the worst."""
    lines = ["| bar | spheres that keep it | worst | models that keep it | worst |", "|---|---:|---|---:|---|"]

    def cells(rows, value, limit):
        found = [(value(r), r["name"] + (f", {r['sky']}" if "sky" in r else "")) for r in rows]
        if not found:
            return ["", ""]
        worst = max(found)
        return [f"{sum(v <= limit for v, _ in found)} of {len(found)}", f"{worst[0]:{'.0%' if limit == 0.03 else '.3g'}} ({worst[1]})"]

    for name, limit in BARS.items():
        if name.startswith("white"):
            row = cells([r for r in spheres if "furnace" in r], lambda r: r["furnace"]["brightest_ring"], limit) + ["", ""]
        else:
            value = lambda r, name=name: ratios(r)[name]
            row = [cell for rows in (spheres, models) for cell in cells([r for r in rows if name in ratios(r)], value, limit)]
        lines.append(f"| {name}: {'within 3 %' if limit == 0.03 else f'at most {limit:g}'} | " + " | ".join(row) + " |")
    return "\n".join(lines)


def under(run):
    """What stands above a table: the command, the date and the machine."""
    return f"`{' '.join(['scripts/materials', run['arguments']]).strip()}`, {run['date']}, {run['cpu']}, {run['threads']} threads, {run['simd']}; {run['revision']}; " \
        f"Mitsuba {run['mitsuba']}; {run['seconds'] / 60:.0f} minutes."


def blocks(results):
    spheres, models = (results.get(name, {"rows": []})["rows"] for name in ("spheres", "models"))
    grid = lambda sky: [r for r in spheres if r["sky"] == sky and r["kind"] == "grid"]
    found = {"run": "\n\n".join(under(part["run"]) for part in results.values()) + "\n\n" + bars(spheres, models)}
    both = [abs(share(r["plugin"], r["appendix_b"]["mix"]) - 1) for r in spheres if "plugin" in r]
    if both:
        found["run"] += f"\n\nUnder the even sky the two references of appendix B differ by at most {max(both):.2%}."
    if spheres:
        found["furnace"] = furnace(grid("even"))
        mean = lambda r, coupling="mix": share(r["ours"]["mean"], r["appendix_b"][coupling])
        found["means"] = matrices({"even sky, ours / mix": matrix(grid("even"), mean, "{:.3f}"),
                                   "even sky, ours / view": matrix(grid("even"), lambda r: mean(r, "view"), "{:.3f}"),
                                   "sky with a sun, ours / mix": matrix(grid("sun"), mean, "{:.3f}")})
        found["noise"] = matrices({"ours / Mitsuba's, 16 samples": matrix(grid("sun"), lambda r: ratios(r)["noise, equal samples"], "{:.2f}"),
                                   "ours / Mitsuba's, time of its 16 samples": matrix(grid("sun"), lambda r: ratios(r)["noise, equal time"], "{:.2f}"),
                                   "ours alone, rms / mean": matrix(grid("sun"), lambda r: r["ours"]["noise"], "{:.3f}")})
        coloured_of = lambda keep: coloured([r for r in spheres if r["sky"] == "even" and r["kind"] == "colour" and keep(r)])
        found["colours"] = coloured_of(lambda r: r["metallic"] == 0 or r["base"][0] == 0.5)
        found["further colours"] = coloured_of(lambda r: r["metallic"] != 0 and r["base"][0] != 0.5)  # in no page
        found["beside principled"] = "Even sky, ours / principled:\n\n" + matrix(grid("even"), lambda r: share(r["ours"]["mean"], r["theirs"]["mean"]), "{:.2f}")
    if "bias" in results:
        found["bias"] = bias.table(results["bias"]["rows"])
    if "shapes" in results:
        found["shapes"] = shapes.table(results["shapes"]["rows"])
    if models:
        found["models"] = of_models(models)
    return found


def as_file(name, table, folder):
    """Writes a Markdown table as a CSV file; the line that links to it."""
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in table.splitlines()]
    file = folder / f"materials-{name}.csv"
    with file.open("w", encoding="utf-8", newline="") as out:
        csv.writer(out, lineterminator="\n").writerows(rows[:1] + rows[2:])
    return f"{IN_FILES[name]}: [{file.name}](measurements/{file.name})."


def write(results, page, everything):
    found = blocks(results)
    if page:
        text = page.read_text(encoding="utf-8")
        for name, content in found.items():
            if name in IN_FILES:
                content = as_file(name, content, page.parent / "measurements")
            pattern = re.compile(rf"(<!-- begin {name} -->\n).*?(<!-- end {name} -->)", re.S)
            text = pattern.sub(lambda m, content=content: m.group(1) + content + "\n" + m.group(2), text)
        page.write_text(text, encoding="utf-8")
    everything.write_text("\n\n".join(f"## {name}\n\n{content}" for name, content in found.items()) + "\n", encoding="utf-8")
