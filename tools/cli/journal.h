// What a long command has finished, on disk while it works, for a later run with --resume: its settings, an item per
// finished part, and totals. `sheet` and `tradeoff` keep one each, and add the form of their items; `fit` needs none,
// because its table of fits tells what is up to date.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace slopemix::cli {

class Journal {
  public:
    using Json = nlohmann::ordered_json;

    struct Content {
        Json items = Json::array(), totals;
    };

    // `settings`: an object of all that the items depend on. Nothing is read or written yet.
    Journal(std::filesystem::path file, Json settings);

    bool exists() const;

    // How a run begins, by what stands beside `finished`, the file that ends one. Says so where there is nothing to
    // resume, or a run of this `work` that was interrupted and is not resumed.
    enum class Start { anew, resumed, complete };
    Start start(bool resume, const std::filesystem::path &finished, const std::string &work) const;

    // Throws CommandError where the file is damaged, or of other settings, and then names the first that differs.
    Content read() const;

    // Atomic: a run that is killed leaves this content or the one before.
    void write(const Content &content) const;
    void remove() const;

    // A file that --resume cannot take up. Throws CommandError.
    [[noreturn]] static void refuse(const std::filesystem::path &file, const std::string &reason);

    // The object in a JSON file, which has all of `settings` among its members as they are here. Throws as read() does.
    static Json read_object(const std::filesystem::path &file);
    static void require_settings(const std::filesystem::path &file, const Json &object, const Json &settings);

    // Says which of `settings` is another in `object`, "it was made with ...", or nothing.
    static std::string difference(const Json &object, const Json &settings);

  private:
    std::filesystem::path file_;
    Json settings_;
};

// A sentence for the person at the terminal.
void note(const std::string &sentence);

} // namespace slopemix::cli
