#include "tradeoff_journal.h"

#include "digest.h"
#include "output.h"
#include "tradeoff_entry.h"

namespace slopemix::cli {

namespace fs = std::filesystem;

namespace {

using Json = Journal::Json;

Json fits_json(const TradeoffResult &result) {
    Json fits = Json::array();
    for (const TradeoffFit &fit : result.fits) fits.push_back(fit_item(fit));
    return fits;
}

} // namespace

void TradeoffJournal::open(const std::vector<Configuration> &plan, TradeoffResult &result) {
    lock_.emplace(job_.out);
    remove_leftovers({job_.journal_file(), job_.truth_file(), job_.file("tradeoff.json"), job_.file("tradeoff.csv"),
                      job_.file("tradeoff.svg")});
    const Json settings = tradeoff_settings(job_, result);
    journal_.emplace(job_.journal_file(), settings);
    switch (journal_->start(job_.resume, job_.file("tradeoff.json"), "sweep")) {
        case Journal::Start::resumed:
            return take_over(plan, result);
        case Journal::Start::complete:
            return require_complete(settings);
        case Journal::Start::anew:
            return;
    }
}

void TradeoffJournal::take_over(const std::vector<Configuration> &plan, TradeoffResult &result) {
    const Journal::Content content = journal_->read();
    const Json &totals = content.totals;
    if (totals.at("truth_sha256") != sha256_of_file(job_.truth_file())) {
        note(job_.truth_file().string() + " is not the truth that was finished: beginning anew");
        return;
    }
    totals.at("truth_sha256").get_to(truth_sha256_);
    totals.at("total_seconds").get_to(result.earlier_seconds);
    totals.at("build_seconds").get_to(result.earlier_build_seconds);
    result.truth = truth_of(totals.at("truth"));
    result.truth.image = acquire<Image>(smx_image_read_exr, job_.truth_file().c_str());
    for (const Json &fit : totals.at("fits")) result.fits.push_back(fit_of(fit));
    for (const Json &item : content.items) result.points.push_back(point_of(item, plan));
    result.kept_points = result.points.size();
}

void TradeoffJournal::require_complete(const Json &settings) {
    const fs::path file = job_.file("tradeoff.json");
    Journal::require_settings(file, Journal::read_object(file), settings);
    is_complete_ = true;
}

// An earlier sweep's results go first: tradeoff.json never stands beside a truth that is not its own.
void TradeoffJournal::keep_truth(const TradeoffResult &result) {
    StagedFiles files;
    const fs::path temporary = files.write(job_.truth_file(), [&](const fs::path &file) {
        check(smx_image_write_exr(result.truth.image.get(), file.c_str()));
    });
    truth_sha256_ = sha256_of_file(temporary);
    for (const char *name : {"tradeoff.json", "tradeoff.csv", "tradeoff.svg"}) remove_file(job_.file(name));
    files.commit();
    keep_point(result);
}

void TradeoffJournal::keep_point(const TradeoffResult &result) {
    Json items = Json::array();
    for (const TradeoffPoint &point : result.points) items.push_back(point_item(point));
    journal_->write({items,
                     {{"total_seconds", result.total_seconds},
                      {"build_seconds", result.build_seconds},
                      {"truth", truth_item(result.truth)},
                      {"truth_sha256", truth_sha256_},
                      {"fits", fits_json(result)}}});
}

} // namespace slopemix::cli
