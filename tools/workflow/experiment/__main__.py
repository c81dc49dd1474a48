"""tools/experiment, once everything that it needs is there."""
import json
import os
import shutil
import sys
import time

from . import arguments, engine, folder, report


def say(text):
    print(f"experiment: {text}", file=sys.stderr, flush=True)


def target_of(until):
    return until or ("pdf" if shutil.which("chromium") else "gallery")


def write_settings(out, settings, left_out=()):
    text = json.dumps(settings | {"left_out": sorted(left_out)}, indent=2)
    folder.write_if_changed(out / "settings.json", text + "\n")


def settings_of(parsed, settings, listed):
    slopemix = os.environ["SLOPEMIX"]
    return settings | {
        "tradeoff": folder.chosen(listed, settings["tradeoff"], "--tradeoff") if settings["tradeoff"] else [],
        "names": folder.chosen(listed, parsed.only, "--only"), "merl": folder.link_tables(parsed.merl, parsed.out),
        "slopemix": str(folder.program(slopemix)), "version": folder.call(slopemix, "--version").split()[-1],
        "python": sys.executable, "cores": parsed.cores}


def make(parsed, settings, target, lock):
    """All that can be made: what waits for every material is made without those that failed. Returns whether that is
    all, the materials that it is not, and the logs of the jobs that failed."""
    out, left_out, logs = parsed.out.resolve(), set(), set()
    while True:
        write_settings(out, settings, left_out)
        folder.drop_pages(out, set(settings["names"]) - left_out)
        done, failed = engine.run(parsed, out, target, lock, say)
        logs |= failed
        if done:
            return not left_out, left_out, logs
        more = engine.unfinished(parsed, out, "metrics")[1] or engine.unfinished(parsed, out, target)[1]
        left_out |= more
        if not more or left_out >= set(settings["names"]):
            return False, left_out, logs
        say(f"going on without {', '.join(sorted(more))}")


def experiment(parsed, settings):
    start = time.monotonic()
    lock = folder.lock(parsed.out)
    listed = folder.materials(os.environ["SLOPEMIX"], parsed.merl, parsed.out)
    settings = settings_of(parsed, settings, listed)
    target = target_of(parsed.until)
    if not settings["names"]:
        raise folder.Refused(f"{parsed.merl} has none of the tables that are wanted")
    if parsed.dry_run:
        write_settings(parsed.out, settings)
        print(f"{engine.unfinished(parsed, parsed.out.resolve(), target)[0]} jobs to run")
        return 0

    done, left_out, logs = make(parsed, settings, target, lock)
    lines = report.missing(listed, parsed.only) + report.failed(parsed.out, logs) + report.without_page(left_out)
    if target != "pdf" and not parsed.until:
        lines.append("left out: gallery.pdf: there is no chromium (tools/setup --gallery)")
    where = f"the profile {parsed.profile}" if parsed.profile else f"{parsed.cores} cores"
    lines += report.took(parsed.out, time.monotonic() - start, where)
    report.write(parsed.out, lines)
    if target != "metrics" and (parsed.out / "gallery" / "summary.json").exists():
        print(report.table(parsed.out))
    print("\n".join(report.shortened(lines)))
    print(f"{parsed.out}/report.txt")
    return 0 if done else 1


def main():
    parsed, settings = arguments.parse()
    try:
        return experiment(parsed, settings)
    except folder.Refused as refused:
        say(refused)
        return 2


if __name__ == "__main__":
    sys.exit(main())
