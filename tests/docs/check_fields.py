"""Every function of the public headers has a comment with its fields: what it computes, a @param for each parameter and
none besides, @return where it returns no status, @threads, @statuses where it does, and @ownership where it gives a
handle or memory of the library's. Lists what is missing, and fails.

    check_fields.py CAPI
"""
import pathlib
import re
import sys

FUNCTION = re.compile(r"(?:/\*\*((?:(?!\*/).)*)\*/\s*)?^SMX_API ([^;(]*?)(\w+)\(([^;]*)\);", re.S | re.M)
HANDLE = re.compile(r"typedef struct \w+_s \*(\w+);")
STATUSES = set("INVALID_ARGUMENT CANNOT_READ CANNOT_WRITE BAD_FORMAT NO_DEVICE KERNEL_BUILD DEVICE_ERROR OUT_OF_MEMORY "
               "NO_SOLUTION CANCELLED".split())


def fields_of(comment):
    """{field: [text, ...]} of a comment; what stands before the first field is 'brief'."""
    text = re.sub(r"^\s*\* ?", "", comment, flags=re.M)
    fields = {"brief": [re.split(r"^@", text, flags=re.M)[0].strip()]}
    for name, value in re.findall(r"^@(\w+)\s+((?:(?!^@).)*)", text, re.S | re.M):
        fields.setdefault(name, []).append(value.strip())
    return fields


def parameters(declaration):
    return [] if declaration.strip() == "void" else [re.search(r"(\w+)\s*$", p)[1] for p in declaration.split(",")]


def documented(fields):
    """Names of the @param fields, `a, b  text` for two."""
    lists = [re.match(r"(\w+(?:, \w+)*)\s+\S", text) for text in fields.get("param", [])]
    return [name for found in lists if found for name in found[1].split(", ")]


def gives_handle(declaration, handles):
    return any(re.fullmatch(r"(\w+) \*\w+", " ".join(p.split())) and p.split()[0] in handles
               for p in declaration.split(","))


def faults(returned, name, declaration, comment, handles, functions):
    if comment is None:
        yield "has no /** comment"
        return
    fields, returns_status = fields_of(comment), returned == "smx_status "
    if not fields["brief"][0]:
        yield "does not say what it computes"
    for parameter in parameters(declaration):
        if parameter not in documented(fields):
            yield f"has no @param {parameter}"
    for parameter in documented(fields):
        if parameter not in parameters(declaration):
            yield f"has no parameter '{parameter}', which its comment documents"
    wanted = {"threads": True, "statuses": returns_status, "return": returned not in ("smx_status ", "void "),
              "ownership": "*" in returned or gives_handle(declaration, handles)}
    for field, needed in wanted.items():
        if needed and not any(fields.get(field, [])):
            yield f"has no @{field}"
    for text in fields.get("statuses", []):
        yield from unknown_statuses(text, functions)


def unknown_statuses(text, functions):
    """@statuses lists names without SMX_, or is that of another function: "those of smx_...", or both."""
    for word in re.findall(r"\b[A-Z]+_[A-Z_]+\b|\bCANCELLED\b|\bsmx_\w+", re.sub(r"\([^)]*\)", "", text)):
        if word not in STATUSES and word not in functions:
            yield f"@statuses names {word}, which is none"
    if not re.match(r"(INVALID_ARGUMENT|those of smx_)", text):
        yield "@statuses begins with neither INVALID_ARGUMENT nor 'those of smx_...'"


def main(folder):
    headers = sorted(pathlib.Path(folder).glob("slopemix*.h")) + sorted(pathlib.Path(folder).glob("slopemix/*.h"))
    texts = {path: path.read_text() for path in headers}
    everything = "".join(texts.values())
    handles = set(HANDLE.findall(everything))
    functions = {match[3] for match in FUNCTION.finditer(everything)}
    found = [(path, match[3], fault) for path, text in texts.items() for match in FUNCTION.finditer(text)
             for fault in faults(match[2], match[3], match[4], match[1], handles, functions)]
    for path, name, fault in found:
        print(f"{path}: {name}: {fault}", file=sys.stderr)
    declared = everything.count("\nSMX_API ")
    if declared != len(functions):
        print(f"{declared} declarations begin with SMX_API, and {len(functions)} were understood", file=sys.stderr)
    print(f"{len(functions)} functions, {len(handles)} handles, {len(found)} faults")
    return 1 if found or declared != len(functions) or not functions else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
