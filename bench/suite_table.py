"""The table that people read of a run of the benchmark suite."""


def number(value, digits=2):
    return "-" if value is None else f"{value:.{digits}f}"


def grid(rows):
    """Rows of texts as a Markdown table whose columns line up: names to the left, numbers to the right."""
    widths = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]

    def line(row):
        return "| " + " | ".join([row[0].ljust(widths[0])] + [c.rjust(w) for c, w in zip(row[1:], widths[1:])]) + " |"

    rule = "|" + "|".join(["-" * (widths[0] + 2)] + ["-" * (w + 1) + ":" for w in widths[1:]]) + "|"
    return "\n".join([line(rows[0]), rule] + [line(r) for r in rows[1:]])


def scene_rows(scenes):
    rows = [["scene", "Mpaths/s", "Mrays/s", "camera", "indirect", "shadow", "Embree %", "its ns/ray", "load s",
             "build s", "first pixel s", "render s", "peak MB"]]
    for name, r in scenes.items():
        rays, embree = r["rays_per_s"], r.get("embree")
        per_ray = embree and 1e9 * embree["replay_seconds"] / sum(embree["rays"].values())
        rows.append([name, number(r["paths_per_s"] * 1e-6, 3), number(sum(rays.values()) * 1e-6)]
                    + [number(rays[kind] * 1e-6) for kind in ("camera", "indirect", "shadow")]
                    + [number(embree and 100 * embree["share"], 0), number(per_ray, 0), number(r["seconds"]["load"], 3),
                       number(r["seconds"]["build"]), number(r["first_pixel_seconds"]), number(r["seconds"]["render"]),
                       number(r["peak_bytes"] * 1e-6, 0)])
    return rows


RATIOS = {"paths": "paths/s : limit", "paths-cpu": "paths per cpu s : limit", "rays": "rays/s : limit's box",
          "against": "against", "against-cpu": "against, cpu s", "cycles": "cycles"}


def text(result):
    parts = [f"{result['cpu']}, {result['threads']} threads, load {result['load']:.1f} when it began"]
    if result["scenes"]:
        parts.append(grid(scene_rows(result["scenes"])))
        names = [n for n in RATIOS if any(n in r["ratios"] for r in result["scenes"].values())]
        if names:
            rows = [["times as fast as"] + [RATIOS[n] for n in names]]
            rows += [[name] + [number(r["ratios"].get(n)) for n in names] for name, r in result["scenes"].items()]
            parts.append(grid(rows))
    if result["materials"]:
        rows = [["material", "ns per shading point"]]
        parts.append(grid(rows + [[name, number(ns, 0)] for name, ns in result["materials"].items()]))
    return "\n\n".join(parts + ["\n".join(result["notes"])] if result["notes"] else parts) + "\n"
