# From a table to its fits, its images and their errors. Memory is 1.5 times and more the measured peak; `runtime`, in
# minutes, holds for the defaults of config.yaml, and matters on clusters only.

# References by config["shard"]; the rest takes milliseconds an image, so that a row is its smallest job.
REFERENCE_SHARD = config["shard"]
OTHER_SHARD = "row" if REFERENCE_SHARD == "light" else REFERENCE_SHARD

def table(wildcards):
    return f"{config['merl']}/{wildcards.name}.binary"

def fitted(wildcards):
    return [f"fits/{wildcards.name}/{fit}/{wildcards.name}.json" for fit in PLAN.fits]

def fit_flags(wildcards, input):
    return " ".join(f"--fit {shlex.quote(fit)}" for fit in input.fits)

def files(images):
    return [f"sheets/{{name}}/{image}.{ending}" for image in images for ending in ("exr", "json")]

def only(wildcards, output):
    return joined(file.split("/")[-1].removesuffix(".exr") for file in output if file.endswith(".exr"))

rule fit:
    input: table
    output:
        "fits/{name}/{fit}/{name}.json",
        "fits/{name}/{fit}/{name}.svg",
        "fits/{name}/{fit}/fits.json",
        "fits/{name}/{fit}/fits.csv",
    params:
        version=VERSION,
        folder=subpath(output[0], parent=True),
        flags=lambda wildcards: "--model {} --lobes {}".format(*wildcards.fit.rsplit("-", 1)),
    log: "logs/fit/{name}/{fit}.log"
    threads: 1
    resources: mem_mb=400, runtime=10
    shell: f"{JOB} {SLOPEMIX} fit {{input:q}} {{params.flags}} --jobs 1 --refit --plot --out {{params.folder:q}}"

rule reference:
    input: table
    output: files(PLAN.images(REFERENCE_SHARD, PLAN.references))
    params: version=VERSION, flags=sheet_flags(config), only=only
    log: f"logs/reference/{{name}}/{job_name(REFERENCE_SHARD)}.log"
    threads: config["threads"]
    resources: mem_mb=400, runtime=60
    shell:
        f"{JOB} {SLOPEMIX} sheet {{input:q}} --out sheets/{{wildcards.name:q}} {{params.flags}} "
        "--only {params.only}"

rule filtered:
    input: table=table, fits=fitted
    output: files(PLAN.images(OTHER_SHARD, PLAN.others))
    params: version=VERSION, flags=sheet_flags(config), fits=fit_flags, only=only
    log: f"logs/filtered/{{name}}/{job_name(OTHER_SHARD)}.log"
    threads: config["threads"]
    resources: mem_mb=400, runtime=10
    shell:
        f"{JOB} {SLOPEMIX} sheet {{input.table:q}} --out sheets/{{wildcards.name:q}} {{params.flags}} "
        "{params.fits} --only {params.only}"

rule compare:
    input: table=table, images=files(PLAN.all_images())
    output: "sheets/{name}/sheet.json", "sheets/{name}/sheet.png"
    params: version=VERSION, flags=sheet_flags(config)
    log: "logs/compare/{name}.log"
    threads: 1
    resources: mem_mb=400, runtime=10
    shell: f"{JOB} {SLOPEMIX} sheet {{input.table:q}} --out sheets/{{wildcards.name:q}} {{params.flags}} --collect"

rule measure:
    input: "sheets/{name}/sheet.json"
    output: "metrics/{name}.json"
    params: pixels_per_degree=config["pixels_per_degree"]
    log: "logs/measure/{name}.log"
    threads: 1
    resources: mem_mb=400, runtime=10
    shell:
        f"{JOB} {PYTHON} -m summary.measure sheets/{{wildcards.name:q}} --to {{output:q}} "
        "--pixels-per-degree {params.pixels_per_degree}"
