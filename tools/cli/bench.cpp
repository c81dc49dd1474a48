// slopemix bench: nanoseconds per evaluation of shading and per sample of the reference, beside baselines written
// plainly.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "bench_job.h"
#include "commands.h"
#include "flags.h"
#include "input.h"
#include "text.h"

namespace slopemix::cli {

namespace {

using Json = nlohmann::ordered_json;

struct BenchFlags {
    RenderFlags render; // its device
    bool quick = false, json = false;
};

void print_json(const std::vector<BenchRow> &rows, const std::string &device) {
    Json document = Json::array();
    for (const BenchRow &row : rows)
        document.push_back({{"name", row.name},
                            {"device", device},
                            {"grade", word_for(row.grade, grades)},
                            {"ns", row.ns},
                            {"baseline", row.baseline},
                            {"baseline_ns", row.baseline_ns},
                            {"ratio", row.ratio()}});
    std::cout << document.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
}

void print_text(const std::vector<BenchRow> &rows, const std::string &device) {
    std::vector<TextRow> lines{{"name", "grade", "ns", "baseline", "its ns", "ratio"}};
    for (const BenchRow &row : rows)
        lines.push_back({row.name, word_for(row.grade, grades), fixed(row.ns, 2), row.baseline,
                         fixed(row.baseline_ns, 1), fixed(row.ratio(), 2)});
    std::cout << device << '\n';
    print_table(std::cout, lines);
}

void run(const BenchFlags &flags) {
    Progress progress(shading_jobs + widening_jobs + effects_jobs + evaluator_jobs + reference_jobs + geometric_jobs);
    BenchJob job{open_context(flags.render), flags.quick ? 1 : 7, progress, {}};
    const smx_device_info device = info_of(job.context);
    if (device.devices > 1)
        throw CommandError("bench measures one device, and these are " + std::to_string(device.devices));
    bench_shading(job);
    bench_widening(job);
    bench_effects(job);
    bench_evaluator(job);
    bench_reference(job);
    bench_geometric(job);
    progress.clear();
    (flags.json ? print_json : print_text)(job.rows, device.name);
}

} // namespace

double Times::median() const {
    std::vector<double> sorted = ns_;
    std::sort(sorted.begin(), sorted.end());
    const std::size_t middle = sorted.size() / 2;
    return sorted.size() % 2 == 1 ? sorted[middle] : 0.5 * (sorted[middle - 1] + sorted[middle]);
}

void add_bench(CLI::App &app) {
    CLI::App *command = app.add_subcommand("bench", "Measure shading and the reference against plain baselines");
    const auto flags = std::make_shared<BenchFlags>();
    command->add_option("--device", flags->render.device, "OpenCL device: its number in `slopemix info`, or its name")
        ->type_name("D");
    command->add_flag("--quick", flags->quick, "One round instead of seven: sooner done, and less to be trusted");
    command->add_flag("--json", flags->json, "Print JSON: a list of rows");
    command->footer(
        "Nanoseconds per evaluation, or per sample of the reference, on the whole device: medians of runs in which a\n"
        "case and its baselines take turns. Baselines: scalar-one-core, a loop of floats and libm; builtin-kernel and\n"
        "plain-kernel, one evaluation or sample per work-item with built-in functions; closed-form, the same shading\n"
        "without the quadrature; all-effects, the same with what `effects.*` leaves out; kernel-alone, an\n"
        "evaluator's kernel on buffers, for the whole call on the host's arrays; statistical, a sample of the "
        "statistical\n"
        "reference, for a path of the geometric one.");
    command->callback([flags] { run(*flags); });
}

} // namespace slopemix::cli
