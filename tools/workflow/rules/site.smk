# What came out: the worst materials' errors split, the summary, the gallery's pages.

BUDGET = budget_flags(config)

checkpoint worst:
    input: expand("metrics/{name}.json", name=NAMES)
    output: "budget/worst.txt"
    params: names=joined(NAMES), how_many=config["worst"]
    log: "logs/worst.log"
    threads: 1
    resources: mem_mb=400, runtime=10
    shell: f"{JOB} {PYTHON} -m summary.worst . --only {{params.names:q}} --count {{params.how_many}} --to {{output:q}}"

def worst_names():
    with checkpoints.worst.get().output[0].open() as file:
        return file.read().splitlines()

def parts_of_page(wildcards):
    """What a page shows besides the sheet, of the materials that have it."""
    name = wildcards.name
    budget = [f"budget/{name}.json"] if name in worst_names() else []
    return budget + ([f"tradeoff/{name}/tradeoff.json"] if name in config["tradeoff"] else [])

rule budget:
    input: table
    output: "budget/{name}.json"
    params: version=VERSION, flags=BUDGET
    log: "logs/budget/{name}.log"
    threads: config["threads"]
    resources: mem_mb=600, runtime=60
    shell: f"{JOB} --to {{output:q}} {SLOPEMIX} budget {{input:q}} {{params.flags}}"

# Times mean something only where nothing else runs: the job takes all cores.
rule tradeoff:
    input: table
    output: "tradeoff/{name}/tradeoff.json", "tradeoff/{name}/tradeoff.svg"
    params: version=VERSION, folder=subpath(output[0], parent=True), flags=f"--quick --res {config['res']}"
    log: "logs/tradeoff/{name}.log"
    threads: config["cores"]
    resources: mem_mb=1000, runtime=60
    shell: f"{JOB} {SLOPEMIX} tradeoff {{input:q}} --out {{params.folder:q}} {{params.flags}}"

rule summarise:
    input:
        "materials.json",
        expand("metrics/{name}.json", name=NAMES),
        lambda wildcards: expand("budget/{name}.json", name=worst_names()),
    output: "gallery/summary.json"
    params: names=joined(NAMES)
    log: "logs/summarise.log"
    threads: 1
    resources: mem_mb=600, runtime=10
    shell: f"{JOB} {PYTHON} -m summary . --only {{params.names:q}}"

rule page:
    input: "materials.json", "metrics/{name}.json", parts_of_page
    output: "gallery/{name}.html"
    log: "logs/page/{name}.log"
    threads: 1
    resources: mem_mb=400, runtime=10
    shell: f"{JOB} {PYTHON} -m gallery . --page {{wildcards.name:q}}"

rule index:
    input: "materials.json", expand("gallery/{name}.html", name=NAMES)
    output: "gallery/index.html"
    log: "logs/index.log"
    threads: 1
    resources: mem_mb=600, runtime=10
    shell: f"{JOB} {PYTHON} -m gallery . --index"

rule summary_page:
    input: "gallery/summary.json"
    output: "gallery/summary.html"
    log: "logs/summary_page.log"
    threads: 1
    resources: mem_mb=400, runtime=10
    shell: f"{JOB} {PYTHON} -m gallery . --summary"

rule print:
    input: "gallery/index.html", "gallery/summary.html"
    output: "gallery/gallery.pdf"
    log: "logs/print.log"
    threads: 1
    resources: mem_mb=2000, runtime=60
    shell: f"{JOB} {PYTHON} -m gallery . --pdf"
