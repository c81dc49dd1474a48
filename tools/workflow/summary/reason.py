"""Where a material's error comes from, in figures and in words: `slopemix budget`'s split (docs/budget.md)."""

# One part dominates where it is this much of the other.
DOMINATES = 1.5


def split(budget):
    """The parts under the per-lobe and the shared model, means over the displaced surfaces. The inversion is the shared
    model's alone: the per-lobe one takes no more than its first alphas from it."""
    parts = {row["model"]: row for row in budget["mean"]}
    keys = ("fit", "widening", "total")
    return {**{key: parts["per-lobe"][key] for key in keys}, "inversion": parts["shared"]["inversion"],
            **{f"shared_{key}": parts["shared"][key] for key in keys}}


def reason(parts):
    """Which part of the per-lobe model's error dominates, and what would help."""
    fit, widening = parts["fit"], parts["widening"]
    figures = f"fit {fit:.3f}, widening {widening:.3f}"
    if fit >= DOMINATES * widening:
        return f"the fit dominates ({figures}): lobes and curves do not have the table's values" + shared(parts)
    if widening >= DOMINATES * fit:
        return f"the widening dominates ({figures}): a higher widening order takes it away"
    return f"fit and widening are alike ({figures})"


def shared(parts):
    """What one curve for all lobes would leave, where that is less."""
    return "; one curve for all lobes leaves less" if parts["shared_fit"] < parts["fit"] else ""


def worst_entry(name, relrmse, budget):
    if budget is None:
        return {"material": name, "relrmse": relrmse, "reason": "its error was not split", "split": None}
    parts = split(budget)
    return {"material": name, "relrmse": relrmse, "reason": reason(parts), "split": parts}
