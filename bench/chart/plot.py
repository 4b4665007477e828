#!/usr/bin/env python3
"""plot.py DIR: draws index.html with its charts (SVG), and explore.html, out of DIR/results.json, as 'pinocchio chart' writes it.

Exit codes: 0 done, 1 failed, 3 matplotlib is missing.
"""
import html
import json
import pathlib
import sys

sys.dont_write_bytecode = True  # charts.py's folder may be the system's
from charts import CLOCKS, draw_charts, named, write_whole
from overview import explore_page

STYLE = """body{font:15px/1.5 system-ui,sans-serif;color:#222;max-width:1180px;margin:2em auto;padding:0 1em}
h1{font-size:1.6em}h2{font-size:1.2em;margin-top:2em}code{font:13px ui-monospace,monospace}
img.chart{max-width:100%;display:block;margin:1em 0}.panels{display:flex;flex-wrap:wrap;gap:.5em}
.panels img{width:375px}table{border-collapse:collapse;font-size:13px}
td,th{padding:.3em .6em;border-bottom:1px solid #ddd;text-align:right;vertical-align:top}
td.t,th.t{text-align:left}tr.front td{background:#fdf6dd}.pictures{display:flex;flex-wrap:wrap;gap:1em}
figure{margin:0;width:250px}figure img{width:122px;image-rendering:auto}figcaption{font-size:12px;
overflow-wrap:anywhere}p.note{color:#555;max-width:60em}"""


def motion_text(run):
    frames = len(run["cameras"])
    if run["turntable"]:
        return f"{frames} frames of a turntable, {360 / run['turntable']:g} degrees a frame"
    return f"{frames} frames of a camera path"


def intro(run):
    scene, size = run["scene"], run["size"]
    return (f"<p>{scene['triangles']} triangles, {size[0]}×{size[1]} pixels; {html.escape(run['cpu'])}, "
            f"{run['cores']} cores; OpenGL: {html.escape(run['gl'])}; pinocchio {html.escape(run['pinocchio'])}.</p>"
            f"<p class=note>Every way to draw is measured along the same motion: {motion_text(run)}. Its "
            f"{CLOCKS[run['clock']]} (the least of {run['rounds']} rounds, as other programs only ever add to a time) "
            "is divided by that of <code>--mode raster</code>, drawn in turns with it. Its error is that of the picture on the screen against "
            "<code>--mode raytrace --precise</code> of the frame that should be there then "
            f"(mean of {run['error_frames']} frames), so what is delivered late is wrong by as much as the camera "
            "has moved. Unless an exchange is named, frames are synchronous. Samples a pixel are measured against "
            f"the mean of {run['area_samples']} reference samples, and stand on no front. * is the default.</p>")


def number(value):
    return "–" if value is None else f"{value:.3g}"


def table(points):
    head = ("<tr><th class=t>axis<th class=t>value<th class=t>options<th>time ratio<th>frame ms<th>latency ms"
            "<th>frames late<th>bytes to CPU<th>bytes to GPU<th>RMSE<th>rel. MSE<th>FLIP</tr>")
    rows = []
    for p in points:
        late = p["latency_frames"] or p["age_frames"]
        cells = "".join(f"<td>{cell}" for cell in (
            number(p["ratio"]), number(p["frame_ms"]), number(p["latency_ms"]), late,
            f"{p['bytes_gpu_to_cpu']:.0f}", f"{p['bytes_cpu_to_gpu']:.0f}", number(p["rmse"]),
            number(p["relmse"]), p.get("failure") or number(p["flip"])))
        front = " class=front" if p["pareto"] else ""
        rows.append(f"<tr{front}><td class=t>{html.escape(p['axis'])}<td class=t>{html.escape(p['value'])}"
                    f"<td class=t><code>{html.escape(named(p))}</code>{cells}</tr>")
    return ("<p class=note>On some Pareto front: shaded. Frames late: of the picture, or of the mask and reflection "
            f"in it.</p><table>{head}{''.join(rows)}</table>")


def thumbnails(points):
    figures, seen = [], set()
    for p in points:
        name = p["picture"]
        if name in seen or p["flip"] is None:
            continue
        seen.add(name)
        figures.append(f"<figure><a href='pictures/{name}.png'><img src='pictures/{name}.png' alt='picture'></a> "
                       f"<a href='pictures/{name}-flip.png'><img src='pictures/{name}-flip.png' alt='FLIP'></a>"
                       f"<figcaption><code>{html.escape(named(p))}</code><br>FLIP {number(p['flip'])}"
                       "</figcaption></figure>")
    return "<div class=pictures>" + "".join(figures) + "</div>"


def page(folder, results):
    run, points = results["run"], results["points"]
    charts, panels = draw_charts(folder, points, run)
    title = f"{html.escape(run['scene']['name'])}: error against time"
    reference = ("<img src='pictures/reference-centre.png' alt='reference'>"
                 if (folder / "pictures/reference-centre.png").exists() else "")
    explore_page(folder / "explore.html", [{**results, "picture": folder / "pictures/reference-centre.png"}])
    parts = [f"<!doctype html><html lang=en><meta charset=utf-8><title>{title}</title><style>{STYLE}</style>",
             f"<h1>{title}</h1>", intro(run), reference,
             "<p><a href='explore.html'>The same with the pointer</a>: each mark says what to type.</p>"]
    parts += [f"<img class=chart src='{name}' alt='{alt}'>" for name, alt in charts]
    parts += ["<h2>Axis by axis</h2><div class=panels>"]
    parts += [f"<img src='{name}' alt='{alt}'>" for name, alt in panels]
    parts += ["</div><h2>Figures</h2>", table(points), "<h2>Pictures, and where FLIP sees a difference</h2>",
              "<p class=note>The last frame compared; heat maps run from black (none) to pale yellow (1).</p>",
              thumbnails(points), "</html>"]
    write_whole(folder / "index.html", lambda part: part.write_text("\n".join(parts), encoding="utf-8"))


def main():
    folder = pathlib.Path(sys.argv[1])
    page(folder, json.loads((folder / "results.json").read_text(encoding="utf-8")))


if __name__ == "__main__":
    main()
