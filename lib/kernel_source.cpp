#include <set>
#include <string_view>

#include "context.h"
#include "error.h"
#include "kernel_files.h"

namespace smx {

namespace {

std::string_view file_text(std::string_view name) {
    for (const KernelFile &file : kernel_files())
        if (file.name == name) return file.text;
    fail(Fault::Internal, "no kernel file ", name);
}

constexpr std::string_view include_directive = "#include \"";

void append(std::string_view name, std::set<std::string_view> &seen, std::string &source) {
    if (!seen.insert(name).second) return;
    source += text("#line 1 \"", name, "\"\n");
    std::string_view rest = file_text(name);
    for (unsigned line = 1; !rest.empty(); ++line) {
        const std::size_t end = std::min(rest.find('\n'), rest.size() - 1) + 1;
        const std::string_view current = rest.substr(0, end);
        rest.remove_prefix(end);
        if (current.starts_with(include_directive)) {
            const std::string_view included = current.substr(include_directive.size());
            append(included.substr(0, included.find('"')), seen, source);
            source += text("#line ", line + 1, " \"", name, "\"\n");
        } else {
            source += current;
        }
    }
}

} // namespace

std::string kernel_source(const std::string &file) {
    std::string source;
    std::set<std::string_view> seen;
    append(file, seen, source);
    return source;
}

std::string build_options(const Defines &defines) {
    std::string options = "-cl-std=CL1.2";
    for (const auto &[name, value] : defines) options += text(" -D", name, "=", value);
    return options;
}

} // namespace smx
