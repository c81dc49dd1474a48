"""summary.json for a terminal."""
from .times import clock

HEAD = ("median", "mean", "p90", "worst")


def lines_of(entries, measure):
    return [f"{entry['fit']:24s}" + "".join(f"{entry[measure][key]:9.3f}" for key in HEAD)
            + f"  {entry[measure]['worst_material']}" for entry in entries]


def text(summary):
    lines = [f"{summary['materials']} materials, {summary['resolution'][0]} x {summary['resolution'][1]} pixels"]
    for measure, title in (("relrmse", "relRMSE"), ("flip", "FLIP")):
        lines += ["", f"{title:24s}" + "".join(f"{key:>9s}" for key in HEAD), *lines_of(summary["models"], measure)]
    lines += ["", f"The worst under {summary['worst_fit']}:"]
    lines += [f"  {entry['relrmse']:.3f}  {entry['material']}: {entry['reason']}" for entry in summary["worst"]]
    everything, whole = summary["time"][-1], summary["extrapolation"]
    lines += ["", f"{everything['jobs']} jobs took {clock(everything['cpu_seconds'])} of one core; the references "
              f"of {whole['materials']} materials with {whole['samples']} samples a pixel would take "
              f"{whole['core_hours']:.1f} core-hours"]
    return "\n".join(lines) + "\n"
