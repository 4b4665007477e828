"""Several scenes' charts in one figure, and as one page that answers to the pointer.

A scene is {"run": ..., "points": ...} of results.json with "others": what other programs need for it, each
{"name", "family", "options", "median_ms", "low_ms", "high_ms", "flip", "rmse", "relmse"}, and "picture": a PNG file.
"""
import base64
import json
import pathlib

from charts import charted, grid, named, plt, save, write_whole

FAMILIES = {"hybrid": ("#3b6fb6", "o"), "raytrace": ("#2a9d8f", "s"), "raster": ("#e09f3e", "D"),
            "Embree": ("#d1495b", "^"), "Mitsuba": ("#7d5ba6", "v")}
LARGE = {"--mode raster": "raster", "--mode raytrace": "raytrace", "": "hybrid", "--exchange pipelined": "pipelined",
         "--exchange reproject": "reproject"}
BELOW = ("reproject", "raytrace")  # the mark that they name


def family(point):
    """Who draws: by the settings, not by the options that gave them."""
    settings = point["settings"]
    if settings["visibility"] == "cpu" and settings["composite"] == "cpu":
        return "raytrace"
    return "hybrid" if point["bytes_gpu_to_cpu"] + point["bytes_cpu_to_gpu"] > 0 else "raster"


def entries(scene):
    """What is shown of a scene, ours and others', in one form."""
    found = []
    for p in charted(scene["points"]):
        found.append({"family": family(p), "name": named(p), "options": p["options"], "ms": p["round_ms"], "low": p["round_low_ms"],
                      "high": p["round_high_ms"], "flip": p["flip"], "rmse": p["rmse"], "relmse": p["relmse"],
                      "latency": p["latency_ms"], "bytes": p["bytes_gpu_to_cpu"] + p["bytes_cpu_to_gpu"]})
    for o in scene.get("others", []):
        found.append({"family": o["family"], "name": o["name"], "options": o["options"], "ms": o["median_ms"], "low": o["low_ms"],
                      "high": o["high_ms"], "flip": o["flip"], "rmse": o["rmse"], "relmse": o["relmse"], "latency": None,
                      "bytes": None, "other": True})
    return found


def front_of(shown):
    """Of ours: those that no other of ours beats in frames/s and FLIP, from slow to fast."""
    ours = sorted((e for e in shown if not e.get("other")), key=lambda e: (e["ms"], e["flip"]))
    front, least = [], float("inf")
    for e in ours:
        if e["flip"] < least:
            front.append(e)
            least = e["flip"]
    return front[::-1]


def fps(ms):
    return 1e3 / ms


def panel(axes, scene):
    shown = entries(scene)
    front = front_of(shown)
    axes.step([fps(e["ms"]) for e in front], [e["flip"] for e in front], where="pre", color="#222222", linewidth=0.9, zorder=2)
    for e in shown:
        colour, marker = FAMILIES[e["family"]]
        label = None if e.get("other") else LARGE.get(e["options"])
        large = bool(label) or e.get("other")
        x = fps(e["ms"])
        axes.errorbar([x], [e["flip"]], xerr=[[x - fps(e["high"])], [fps(e["low"]) - x]], fmt="none", ecolor=colour,
                      elinewidth=1.4 if large else 0.8, alpha=0.8 if large else 0.35, zorder=3)
        hollow = e["family"] == "Mitsuba"
        axes.scatter([x], [e["flip"]], s=110 if e["options"] == "" else 64 if large else 15,
                     marker="*" if e["options"] == "" else marker, facecolors="none" if hollow else colour,
                     edgecolors=colour, linewidths=1.3 if hollow else 0, alpha=1 if large else 0.45, zorder=4)
        if large:
            axes.annotate(label or e["name"], (x, e["flip"]), xytext=(0, -15 if label in BELOW else 8), textcoords="offset points",
                          ha="center", fontsize=8, color=colour, zorder=5)
    axes.set(xscale="log", yscale="log")
    axes.set_title(scene["run"]["scene"]["name"] + f", {scene['run']['scene']['triangles']:,} triangles", fontsize=10.5)
    grid(axes)
    low, high = (f(fps(e["ms"]) for e in shown) for f in (min, max))
    axes.set_xlim(low / 1.9, high * 1.5)
    ticks = [m * 10.0 ** k for k in range(-2, 5) for m in (1, 2, 5) if low / 1.9 <= m * 10.0 ** k <= high * 1.5]
    axes.set_xticks(ticks, [f"{t:g}" for t in ticks])
    axes.xaxis.set_minor_locator(plt.NullLocator())


def overview_chart(path, scenes):
    """FLIP against frames/s, a panel a scene, and how to read it."""
    columns = 3
    rows = (len(scenes) + 1 + columns - 1) // columns
    figure, axes = plt.subplots(rows, columns, figsize=(12.6, 3.9 * rows), sharey=True, squeeze=False)
    cells = list(axes.flat)
    for cell, scene in zip(cells, scenes):
        panel(cell, scene)
        cell.set_xlabel("frames a second")
    for row in axes:
        row[0].set_ylabel("mean FLIP (less is better)")
    for cell in cells[len(scenes):]:
        cell.axis("off")
    handles = [plt.Line2D([], [], color=colour, marker=marker, ls="", label=name,
                          markerfacecolor="none" if name == "Mitsuba" else colour)
               for name, (colour, marker) in FAMILIES.items()]
    handles.append(plt.Line2D([], [], color=FAMILIES["hybrid"][0], marker="*", ls="", markersize=11, label="the default"))
    handles.append(plt.Line2D([], [], color="#222222", lw=0.9, label="no other point of ours is faster and closer"))
    run = scenes[0]["run"]
    cells[len(scenes)].legend(handles=handles, loc="upper left", frameon=False, fontsize=9.5)
    cells[len(scenes)].text(
        0.02, 0.36, "Right: faster. Down: closer to the truth,\na reference in double precision.\n"
        f"{run['size'][0]} × {run['size'][1]} pixels, {run['cores']} cores; bars: all of\n{run['rounds']} rounds; OpenGL: "
        f"{run['gl'].split(' (')[0]}.\nSmall: settings that trade one for the other.\nHollow: against its own converged picture.",
        transform=cells[len(scenes)].transAxes, fontsize=9.5, color="#444444", va="top", linespacing=1.5)
    figure.tight_layout()
    save(figure, path)


def thumbnail(path):
    """A data URI, 240 pixels wide at most; empty where there is no picture."""
    import io

    if not path or not pathlib.Path(path).exists():
        return ""
    picture = plt.imread(path)
    step = max(1, -(-picture.shape[1] // 240))
    rows, columns = (n // step * step for n in picture.shape[:2])
    small = picture[:rows, :columns, :3].reshape(rows // step, step, columns // step, step, 3).mean(axis=(1, 3))
    file = io.BytesIO()
    plt.imsave(file, small, format="png")
    return "data:image/png;base64," + base64.b64encode(file.getvalue()).decode()


def explore_page(path, scenes):
    """All of it in one file that needs no network."""
    data = [{"name": s["run"]["scene"]["name"], "triangles": s["run"]["scene"]["triangles"], "size": s["run"]["size"],
             "cpu": s["run"]["cpu"], "cores": s["run"]["cores"], "gl": s["run"]["gl"], "rounds": s["run"]["rounds"],
             "picture": thumbnail(s.get("picture")), "entries": entries(s)} for s in scenes]
    colours = {name: colour for name, (colour, _) in FAMILIES.items()}
    text = pathlib.Path(__file__).with_name("explore.html").read_text(encoding="utf-8")
    for mark, value in (("/*DATA*/", data), ("/*COLOURS*/", colours)):
        text = text.replace(mark, json.dumps(value, separators=(",", ":")).replace("</", "<\\/"))
    write_whole(path, lambda part: part.write_text(text, encoding="utf-8"))
