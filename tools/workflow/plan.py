"""Which images a sheet has, which jobs make them, and the flags that all calls of a sheet share.

Images are named table.row.column as `slopemix sheet --help` has them: column 1 the geometry, then for each light the
reference and a filtered image per number of lobes under the shared model, then the per-lobe model with the last number
of lobes, widened in closed form and by quadrature of the orders asked for, for each light.
"""
import dataclasses

LIGHTS = 3
TABLES = (1, 2, 3)
SHARDS = ("light", "row", "table", "sheet")


@dataclasses.dataclass(frozen=True)
class Plan:
    radii: tuple
    lobes: tuple
    orders: tuple  # of the widening, besides the closed form

    @classmethod
    def of(cls, settings):
        orders = [order for order in settings["widening_order"] if str(order) != "0"]
        return cls(tuple(settings["radii"]), tuple(settings["lobes"]), tuple(orders))

    @property
    def references(self):
        """The columns that hold references."""
        return [2 + light * (1 + len(self.lobes)) for light in range(LIGHTS)]

    @property
    def others(self):
        """The columns that take next to no time: geometry and filtered images."""
        last = 1 + LIGHTS * (1 + len(self.lobes)) + LIGHTS * (1 + len(self.orders))
        return [column for column in range(1, last + 1) if column not in self.references]

    @property
    def fits(self):
        """Model and lobes of each fit, in the order of the columns."""
        return [f"shared-{lobes}" for lobes in self.lobes] + [f"per-lobe-{self.lobes[-1]}"]

    def images(self, shard, columns):
        """The images of one job, as patterns: what the shard leaves open is a wildcard."""
        tables = TABLES if shard == "sheet" else ("{table}",)
        rows = range(1, len(self.radii) + 1) if shard in ("table", "sheet") else ("{row}",)
        if shard == "light":
            columns = ("{column}",)
        return [f"{table}.{row}.{column}" for table in tables for row in rows for column in columns]

    def all_images(self):
        return self.images("sheet", sorted(self.references + self.others))


def job_name(shard):
    """The name of a shard's job among those of its material, a pattern."""
    return {"light": "{table}.{row}.{column}", "row": "{table}.{row}", "table": "{table}", "sheet": "sheet"}[shard]


def joined(values):
    return ",".join(map(str, values))


def sampling_flags(settings):
    sampling = f"--spp {settings['spp']}" if settings["spp"] else f"--target-error {settings['target_error']}"
    return f"--res {settings['res']} {sampling} --seed {settings['seed']}"


def sheet_flags(settings):
    """The settings of a sheet, the same in every call."""
    orders = f" --widening-order {joined(settings['widening_order'])}" if settings["widening_order"] else ""
    return (f"{sampling_flags(settings)} --radii {joined(settings['radii'])} --lobes {joined(settings['lobes'])} "
            f"--model both{orders}")


def budget_flags(settings):
    """The sheet's surfaces, lobes and samples."""
    alphas = " ".join(f"--alpha {r},{r} --alpha {r},0 --alpha 0,{r}" for r in settings["radii"])
    return f"{sampling_flags(settings)} --lobes {settings['lobes'][-1]} {alphas} --json"
