#!/usr/bin/env python3
"""Measures whole renders: paths and rays per second, the share of time inside Embree, times to load, to build and to
the first pixel, peak memory, and nanoseconds per shading point by material. Beside it, in the same run and in turn with
it, the least that a path tracer must do (limit.cpp), and Cycles where `blender` is installed. docs/performance.md says
how to read the numbers."""
import argparse
import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile

import suite_history
import suite_table
from suite_scenes import ROOT, SCENES, SHARED, find_scene

LIMIT_SIZE, LIMIT_SPP = 256, 32
RAY_KINDS = ("camera", "indirect", "shadow")


def say(text):
    print(f"bench: {text}", file=sys.stderr, flush=True)


class Failed(Exception):
    """A program that is measured did not do its work."""


def run(command, cwd):
    """Runs a program to its end; returns what it wrote to standard output, and its processor seconds."""
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
        child = subprocess.Popen(command, stdout=out, stderr=err, stdin=subprocess.DEVNULL, cwd=cwd)
        try:
            _, status, usage = os.wait4(child.pid, 0)
        except BaseException:
            child.kill()
            child.wait()
            raise
        child.returncode = os.waitstatus_to_exitcode(status)
        out.seek(0)
        err.seek(0)
        if child.returncode != 0:
            words = " ".join(os.path.basename(w) for w in command[:3])
            raise Failed(f"{words} ended with {child.returncode}: {err.read().decode(errors='replace').strip()[-600:]}")
        return out.read().decode(errors="replace"), usage.ru_utime + usage.ru_stime


class Suite:
    def __init__(self, args, work):
        self.args, self.work = args, work
        self.programs = {"etendue": args.program, **({"against": args.against} if args.against else {})}
        self.limit = None
        self.notes = []

    def skip(self, what, why):
        self.notes.append(f"{what}: not measured, {why}")
        say(self.notes[-1])

    def build_limit(self):
        source = os.path.join(SHARED, "bench", "limit.cpp")
        if not os.path.exists(source):
            return self.skip("limit", f"there is no {source}")
        target = os.path.join(self.work, "limit")
        command = [os.environ.get("CXX", "g++"), "-O3", "-march=native", "-ffast-math", "-w", source, "-lembree3",
                   "-ltbb", "-o", target]
        try:
            run(command, self.work)
            self.limit = target
        except (OSError, Failed) as e:
            self.skip("limit", f"it could not be built: {e}")

    def run_limit(self):
        text, cpu = run([self.limit, str(LIMIT_SPP), str(LIMIT_SIZE)], self.work)
        # limit: 1.06 s, 1.97 Mpaths/s, 12.1 Mrays/s, mean G 0.1965
        words = text.split()
        paths = LIMIT_SPP * LIMIT_SIZE**2
        return {"seconds": paths / (float(words[3]) * 1e6), "cpu_seconds": cpu, "paths_per_s": float(words[3]) * 1e6,
                "rays_per_s": float(words[5]) * 1e6}

    def render(self, program, scene, file, threads=None):
        stats = os.path.join(self.work, "stats.json")
        command = [program, "render", file, "-o", os.path.join(self.work, "picture.pfm"), "--size",
                   "{}x{}".format(*scene.size), "--spp", str(scene.spp), "--quiet", "--stats", stats]
        _, cpu = run(command + (["--threads", str(threads)] if threads else []), self.work)
        with open(stats, encoding="utf-8") as f:
            return {**json.load(f), "cpu_seconds": cpu}

    def replay(self, scene, file):
        """The share of time inside Embree, of a smaller picture, whose rays have to fit into memory."""
        command = [self.args.replay, file, str(scene.size[0] // 2), str(scene.size[1] // 2), "16"]
        return json.loads(run(command, self.work)[0])

    def measure(self, scene, file):
        """Renders in turn with the other programs; the fastest of each counts."""
        best = {}
        for turn in range(self.args.repeat):
            # Neither program is always the first.
            for name, program in sorted(self.programs.items(), reverse=turn % 2 == 0):
                stats = self.render(program, scene, file)
                kept = best.setdefault(name, stats)
                if stats["seconds"]["render"] < kept["seconds"]["render"]:
                    kept["rays"], kept["paths"] = stats["rays"], stats["paths"]
                for phase in kept["seconds"]:
                    kept["seconds"][phase] = min(kept["seconds"][phase], stats["seconds"][phase])
                kept["cpu_seconds"] = min(kept["cpu_seconds"], stats["cpu_seconds"])
            if self.limit:
                once = self.run_limit()
                kept = best.setdefault("limit", once)
                for key, choose in (("seconds", min), ("cpu_seconds", min), ("paths_per_s", max), ("rays_per_s", max)):
                    kept[key] = choose(kept[key], once[key])
        row = numbers(scene, best["etendue"])
        row["ratios"] = ratios(scene, row, best)
        try:
            row["embree"] = self.replay(scene, file)
        except Failed as e:
            self.skip(f"the share of Embree in {scene.name}", str(e))
        if scene.kind == "own":
            row["cycles"] = self.cycles(scene, file)
            if row["cycles"]:
                row["ratios"]["cycles"] = row["cycles"]["ratio"]
        return row

    def cycles(self, scene, file):
        script = os.path.join(SHARED, "bench", "cycles_cornell.py")
        blender = shutil.which("blender")
        if not blender or not os.path.exists(script):
            self.skip("cycles", "there is no blender" if not blender else f"there is no {script}")
            return None
        try:
            out = os.path.join(self.work, "cycles.exr")
            text, _ = run([blender, "-b", "-P", script, "--", out, str(scene.spp), str(scene.size[0])], self.work)
            seconds = float(text.split("CYCLES render seconds")[1].split()[0])
            # Its script asks for two threads.
            ours = self.render(self.args.program, scene, file, 2)["seconds"]["render"]
            return {"seconds": seconds, "ratio": seconds / ours}
        except (Failed, IndexError, ValueError) as e:
            self.skip("cycles", f"it did not say how long it took: {e}")
            return None

    def materials(self):
        text, _ = run([self.args.micro, "--benchmark_filter=^material/", "--benchmark_format=json",
                       "--benchmark_min_time=0.05"], self.work)
        found = json.loads(text)["benchmarks"]
        for b in found:
            if b.get("error_occurred"):
                self.skip(b["name"], b["error_message"])
        return {b["name"].split("/", 1)[1]: round(b["cpu_time"], 1) for b in found if not b.get("error_occurred")}


def numbers(scene, stats):
    seconds, render = stats["seconds"], stats["seconds"]["render"]
    first = seconds.get("first_pass")  # programs of before have none
    return {
        "size": list(scene.size), "spp": stats["spp"], "paths": stats["paths"], "rays": stats["rays"],
        "seconds": seconds, "cpu_seconds": stats["cpu_seconds"], "paths_per_s": stats["paths"] / render,
        "rays_per_s": {kind: stats["rays"][kind] / render for kind in RAY_KINDS},
        "first_pixel_seconds": None if first is None else seconds["load"] + seconds["build"] + first,
        "peak_bytes": stats["peak_bytes"], "texture_bytes": stats["texture_bytes"],
    }


def ratios(scene, row, best):
    """All are above 1 where etendue is the faster one."""
    found = {}
    if "limit" in best:
        limit = best["limit"]
        found["rays"] = sum(row["rays_per_s"].values()) / limit["rays_per_s"]
        if scene.kind == "own":
            found["paths"] = row["paths_per_s"] / limit["paths_per_s"]
            per_cpu = LIMIT_SPP * LIMIT_SIZE**2 / limit["cpu_seconds"]
            found["paths-cpu"] = row["paths"] / row["cpu_seconds"] / per_cpu
    if "against" in best:
        found["against"] = best["against"]["seconds"]["render"] / row["seconds"]["render"]
        found["against-cpu"] = best["against"]["cpu_seconds"] / row["cpu_seconds"]
    return found


def parse():
    parser = argparse.ArgumentParser(
        prog="./dev bench", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter,
        epilog="Examples:\n"
        "  ./dev bench                          the usual set, in a few minutes\n"
        "  ./dev bench --only teapot classroom  these scenes alone\n"
        "  ./dev bench --against ../old/build/release/bin/etendue\n"
        "                                       another build in turn with this one\n"
        "  ./dev bench --all --json all.json --record\n"
        "                                       everything, as JSON too; ratios go to bench/history.jsonl\n"
        "  ./dev bench limit                    the Cornell box with more samples, and the limit program, alone\n"
        "  ./dev bench micro                    all inner loops, by Google Benchmark\n")
    parser.add_argument("--all", action="store_true", help="scenes that take long, too")
    parser.add_argument("--only", nargs="+", metavar="NAME", help="these alone: scenes, or `materials`")
    parser.add_argument("--list", action="store_true", help="say what there is, and end")
    parser.add_argument("--json", metavar="FILE", help="write all numbers there")
    parser.add_argument("--against", metavar="PROGRAM", help="another build of etendue, rendered in turn")
    parser.add_argument("--record", action="store_true", help="append the ratios to bench/history.jsonl")
    parser.add_argument("--repeat", type=int, default=2, metavar="N", help="renders of each, the fastest counts (2)")
    for name, file in (("program", "etendue"), ("replay", "etendue_replay_rays"), ("micro", "etendue_bench")):
        default = os.path.join(ROOT, "build", "release", "bin", file)
        parser.add_argument("--" + name, default=default, help=argparse.SUPPRESS)
    args = parser.parse_args()
    names = [s.name for s in SCENES] + ["materials"]
    for name in args.only or []:
        if name not in names:
            parser.error(f"there is no scene '{name}'; --list says what there is")
    if args.repeat < 1:
        parser.error("--repeat: at least 1")
    if args.json and not os.path.isdir(os.path.dirname(os.path.abspath(args.json))):
        parser.error(f"--json: the folder of {args.json} does not exist")
    for name in () if args.list else ("program", "replay", "micro") + (("against",) if args.against else ()):
        path = os.path.abspath(getattr(args, name))
        if not (os.path.isfile(path) and os.access(path, os.X_OK)):
            parser.error(f"there is no program {path}")
        setattr(args, name, path)
    return args, parser


def run_all(args, history, work):
    suite = Suite(args, work)
    wanted = [s for s in SCENES if (s.name in args.only if args.only else args.all or not s.only_all)]
    result = {**suite_history.machine(), "load": os.getloadavg()[0], "scenes": {}, "materials": {}, "ratios": {}}
    if args.against:
        result["against"] = run([args.against, "--version"], work)[0].strip()
    failed = False
    if wanted:
        suite.build_limit()
    for scene in wanted:
        file, why = find_scene(scene, os.path.join(ROOT, "build", "bench-scenes"), say)
        if not file:
            suite.skip(scene.name, why)
            continue
        say(scene.name)
        try:
            row = suite.measure(scene, file)
        except Failed as e:
            suite.skip(scene.name, str(e))
            failed = True
            continue
        result["scenes"][scene.name] = row
        for name, ratio in row["ratios"].items():
            result["ratios"][f"{scene.name}/{name}"] = round(ratio, 4)
    if not args.only or "materials" in args.only:
        say("materials")
        result["materials"] = suite.materials()
    result["notes"] = suite.notes
    print(suite_table.text(result))
    if args.json:
        with open(args.json, "w", encoding="utf-8") as f:
            json.dump(result, f, indent=1)
            f.write("\n")
    if result["ratios"]:
        print("\n".join(suite_history.compare(history, result["ratios"])))
    if args.record and not result["ratios"]:
        say("nothing is recorded, since there are no ratios")
    elif args.record:
        suite_history.append(suite_history.FILE, suite_history.line_of(result))
    return 1 if failed else 0


def main():
    args, parser = parse()
    if args.list:
        for s in SCENES:
            print(f"{s.name:15} {s.what}{' (with --all or --only)' if s.only_all else ''}")
        print(f"{'materials':15} nanoseconds per shading point")
        return 0
    try:
        history = suite_history.read(suite_history.FILE)
    except (OSError, ValueError) as e:
        parser.error(str(e))
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        with tempfile.TemporaryDirectory(prefix="etendue-bench-") as work:
            return run_all(args, history, work)
    except KeyboardInterrupt:
        say("interrupted")
        return 130
    except (Failed, OSError) as e:
        say(str(e))
        return 1


if __name__ == "__main__":
    sys.exit(main())
