// Runs the real slopemix binary and keeps what it said.
#pragma once

#include <cstddef>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace test {

struct CliResult {
    int status = -1; // exit status; -1 after a signal
    std::string out, err;

    nlohmann::json json() const { return nlohmann::json::parse(out); }
};

struct CliSetting {
    std::vector<std::pair<std::string, std::string>> environment;
    std::size_t file_size_limit = 0; // bytes; 0: none. Longer writes fail, for root too
    int signal = 0;                  // sent once `signal_when` is true; 0: none
    std::function<bool()> signal_when = {};
    std::function<void()> meanwhile = {}; // while the command stands still, once `signal_when` is true
};

CliResult cli(const std::vector<std::string> &arguments, const CliSetting &setting = {});

// `base` with some more arguments; a later flag does not replace an earlier one.
std::vector<std::string> with(std::vector<std::string> base, const std::vector<std::string> &more);

// `base` with the value after `flag` replaced.
std::vector<std::string> replaced(std::vector<std::string> base, const std::string &flag, const std::string &value);

} // namespace test

// A run that must end with this exit status and say `needle` on standard error.
#define EXPECT_CLI_FAILS(wanted_status, needle, ...)                                                           \
    do {                                                                                                       \
        const test::CliResult result = test::cli(__VA_ARGS__);                                                 \
        EXPECT_EQ(result.status, wanted_status) << result.err;                                                 \
        EXPECT_NE(result.err.find(needle), std::string::npos) << "no \"" << needle << "\" in: " << result.err; \
    } while (false)

#define ASSERT_CLI_OK(result) ASSERT_EQ((result).status, 0) << (result).err
