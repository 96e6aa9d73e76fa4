"""The history of the benchmark suite: one line of JSON for each recorded run, which holds ratios alone, since seconds
of different machines do not compare."""
import datetime
import json
import os
import subprocess

from suite_scenes import ROOT

FILE = os.path.join(ROOT, "bench", "history.jsonl")
FALL = 0.10  # by which a ratio may be lower than the last one before a run warns


def git(*arguments):
    try:
        done = subprocess.run(("git", "-C", ROOT) + arguments, capture_output=True, text=True, check=True)
        return done.stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return ""


def cpu_model():
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as f:
            for line in f:
                if line.startswith("model name"):
                    return line.split(":", 1)[1].strip()
    except OSError:
        pass
    return "unknown"


def machine():
    return {"cpu": cpu_model(), "threads": len(os.sched_getaffinity(0))}


def read(path):
    """All lines of the history; ValueError says which one is no history."""
    if not os.path.exists(path):
        return []
    lines = []
    with open(path, encoding="utf-8") as f:
        for number, text in enumerate(f, 1):
            try:
                line = json.loads(text)
                if not all(isinstance(r, (int, float)) for r in line["ratios"].values()):
                    raise TypeError
            except (ValueError, TypeError, KeyError, AttributeError):
                raise ValueError(f"{path}:{number}: this is no line of a history") from None
            lines.append(line)
    return lines


def line_of(result):
    # What tells whether the commit is what was measured.
    changed = bool(git("status", "--porcelain", "--untracked-files=no", "--", "src", "apps", "CMakeLists.txt"))
    return {"date": datetime.date.today().isoformat(), "commit": git("rev-parse", "--short=12", "HEAD") or "unknown",
            **({"changed": True} if changed else {}), **machine(),
            **({"against": result["against"]} if "against" in result else {}), "ratios": result["ratios"]}


def append(path, line):
    with open(path, "a", encoding="utf-8") as f:
        f.write(json.dumps(line) + "\n")


def compare(lines, ratios):
    """Lines of text on how these ratios stand to those of the last recorded run that has any of them, on a machine like
    this one if there is one."""
    here = machine()
    # Those to another build say nothing without that very build.
    ratios = {name: r for name, r in ratios.items() if not name.split("/")[-1].startswith("against")}
    shared = [old for old in lines if ratios.keys() & old["ratios"].keys()]
    alike = [old for old in shared if (old.get("cpu"), old.get("threads")) == (here["cpu"], here["threads"])]
    if not shared:
        return ["history: no recorded run has these ratios"]
    last = (alike or shared)[-1]
    text = [f"history: compared with {last.get('commit')} of {last.get('date')}"
            + ("" if alike else f", on another machine ({last.get('cpu')}, {last.get('threads')} threads)")]
    fell = False
    for name in ratios:
        if name not in last["ratios"] or last["ratios"][name] <= 0:
            continue
        change = ratios[name] / last["ratios"][name] - 1
        if change < -FALL:
            fell = True
            text.append(f"  WARNING: {name} fell by {-100 * change:.0f} %, "
                        f"from {last['ratios'][name]:.3g} to {ratios[name]:.3g}")
    if not fell:
        text.append(f"  no ratio fell by more than {100 * FALL:.0f} %")
    return text
