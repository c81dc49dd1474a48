// The table of fits, DIR/fits.json: a table that is read is written, and written the same when it is read again.
#include "files.h"
#include "fit_job.h"
#include "fit_table.h"
#include "memory.h"
#include "target.h"

using slopemix::cli::CommandError;
using slopemix::cli::FitTable;

namespace {

// Of the file's length: the document, the rows, and the text of both files that is written of them.
constexpr std::size_t length_factor = 200;

} // namespace

std::vector<std::string> fuzz::seeds() {
    const std::string head = R"({"format": "slopemix-fits", "version": 1, "materials": [)";
    return {head + R"({"name": "a", "lobes": 2, "alpha": [0.1, null], "f0_r": 1e-300, "options": "x,\"y\""}]})",
            head + R"({"name": "b", "em_iterations": 18446744073709551615}, {"name": "c", "alpha": []}]})",
            head + R"({"name": "b"}, {"name": "b"}]})",
            head + "]}",
            R"({"format": "slopemix-fits", "version": 2, "materials": {}})",
            "[1"};
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static const test::TempDir dir;
    const std::string path = dir / "fits.json";
    test::write_file(path, std::string(reinterpret_cast<const char *>(data), size));
    try {
        const fuzz::MemoryLimit limit(length_factor * size + fuzz::always_legal);
        FitTable(dir.path()).save();
    } catch (const CommandError &) {
        return 0;
    }
    const std::string written = test::read_file(path);
    FitTable(dir.path()).save();
    fuzz::require(test::read_file(path) == written, "a table comes back the same");
    return 0;
}
