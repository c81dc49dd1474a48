// What the parts of `slopemix bench` share: one row per case, grade and baseline, times as medians of runs in which a
// case and its baselines take turns.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "handles.h"
#include "progress.h"

namespace slopemix::cli {

struct BenchRow {
    std::string name;
    smx_grade grade;
    double ns; // per evaluation, on the whole device
    std::string baseline;
    double baseline_ns;

    double ratio() const { return baseline_ns / ns; }
};

struct BenchJob {
    Context context;
    int rounds; // turns of a case and its baselines
    Progress &progress;
    std::vector<BenchRow> rows;
};

inline constexpr smx_grade bench_grades[] = {SMX_GRADE_PRECISE, SMX_GRADE_FAST};
inline constexpr int lobe_counts[] = {1, 2, 4, 8, 16};
inline constexpr int effect_lobe_counts[] = {1, 8};
inline constexpr int widening_orders[] = {1, 2, 3, 5, 8};

// In progress's units.
inline constexpr double shading_jobs = 10.0, widening_jobs = 2.0, reference_jobs = 5.0, geometric_jobs = 1.0,
                        effects_jobs = 2.0, evaluator_jobs = 2.0;

// Each adds its rows; throws CommandError where a baseline computes something else than the library.
void bench_shading(BenchJob &job);
void bench_widening(BenchJob &job);
void bench_effects(BenchJob &job);
void bench_evaluator(BenchJob &job);
void bench_reference(BenchJob &job);
void bench_geometric(BenchJob &job);

// Times of runs, and the one in the middle.
class Times {
  public:
    void add(double seconds, double evaluations) { ns_.push_back(1e9 * seconds / evaluations); }
    void add(const smx_render_report &report) { add(report.kernel_seconds, static_cast<double>(report.evaluations)); }
    double median() const;

  private:
    std::vector<double> ns_;
};

} // namespace slopemix::cli
