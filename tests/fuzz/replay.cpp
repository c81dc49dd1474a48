// Runs a target for some seconds without a fuzzing engine: its seeds, each of them cut short at every byte, then
// changes of them, the same ones in every run.
//
//   fuzz_NAME [SECONDS]        10 by default
//   fuzz_NAME --input FILE     one input, such as a crash that was kept
//
// A crash, more than a second of processor time for an input, or more memory than it declares (memory.h) ends it with
// the input in crash-NAME in the working directory.
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "files.h"
#include "random.h"
#include "target.h"

namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr int seconds_per_input = 5; // instrumented code is some times slower
constexpr long memory = 4L << 20;    // kB
#else
constexpr int seconds_per_input = 1;
constexpr long memory = 1L << 20; // kB; a table over the full azimuth takes 0.4 GB while it is read
#endif
constexpr std::size_t longest_input = 1 << 16;
constexpr std::size_t fewest_changes = 8; // also where seeds took all the time

std::string crash_file;
std::string current;

// Only what a signal handler may call.
void keep_input(int signal) {
    const int file = open(crash_file.c_str(), O_CREAT | O_TRUNC | O_WRONLY | O_CLOEXEC, 0644);
    const bool kept = file >= 0 && write(file, current.data(), current.size()) >= 0;
    constexpr char slow[] = "fuzz: an input took too long\n", crash[] = "fuzz: an input crashed\n";
    const char *const what = signal == SIGPROF ? slow : crash;
    const bool told = write(STDERR_FILENO, what, std::strlen(what)) >= 0;
    _exit(kept && told ? 1 : 2);
}

void run(const std::string &input) {
    current = input;
    const itimerval limit{{0, 0}, {seconds_per_input, 0}}, none{};
    setitimer(ITIMER_PROF, &limit, nullptr);
    LLVMFuzzerTestOneInput(reinterpret_cast<const uint8_t *>(current.data()), current.size());
    setitimer(ITIMER_PROF, &none, nullptr);
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    fuzz::require(usage.ru_maxrss <= memory, "an input took too much memory");
}

// What readers trip over.
const std::vector<std::string> &tokens() {
    static const std::vector<std::string> list{"0",
                                               "-1",
                                               "1e999",
                                               "-0.0",
                                               "nan",
                                               "inf",
                                               "18446744073709551616",
                                               "1e-400",
                                               "\"",
                                               "[",
                                               "]",
                                               "{",
                                               "}",
                                               ",",
                                               "\n",
                                               "null",
                                               "true",
                                               "\\ud800",
                                               "\xff\xfe",
                                               "\xc3",
                                               "--",
                                               "=",
                                               ".",
                                               std::string(4, '\0'),
                                               std::string(8, '\0'),
                                               "\xff\xff\xff\xff",
                                               "\xff\xff\xff\x7f",
                                               std::string("\0\0\0\x80", 4),
                                               std::string("\x01\0\0\0\0\0\0\0", 8)};
    return list;
}

std::string changed(std::string input, const std::vector<std::string> &seeds, test::Random &random) {
    const std::size_t at = random.below(input.size() + 1);
    const std::string &other = seeds[random.below(seeds.size())];
    const std::size_t rest = input.size() - at, count = rest == 0 ? 0 : random.below(std::min<std::size_t>(rest, 64));
    switch (random.below(7)) {
        case 0:
            return input.substr(0, at);
        case 1:
            return input.erase(at, count);
        case 2:
            return input.insert(at, input.substr(at, count));
        case 3:
            return input.insert(at, tokens()[random.below(tokens().size())]);
        case 4:
            return input.replace(at, count, tokens()[random.below(tokens().size())]);
        case 5:
            return input.substr(0, at) + other.substr(random.below(other.size() + 1));
        default:
            if (rest > 0) input[at] = static_cast<char>(input[at] ^ (1 << random.below(8)));
            return input;
    }
}

std::size_t run_cuts(const std::vector<std::string> &seeds, auto has_time) {
    std::size_t runs = 0;
    for (const std::string &seed : seeds)
        for (std::size_t size = 0; size <= seed.size() && has_time(); ++size, ++runs) run(seed.substr(0, size));
    return runs;
}

std::size_t run_changes(const std::vector<std::string> &seeds, auto has_time) {
    test::Random random(47);
    std::size_t runs = 0;
    for (; runs < fewest_changes || has_time(); ++runs) {
        std::string input = seeds[runs % seeds.size()];
        for (std::size_t changes = 1 + random.below(4); changes > 0; --changes) input = changed(input, seeds, random);
        run(input.substr(0, longest_input));
    }
    return runs;
}

} // namespace

int main(int argc, char **argv) {
    crash_file = std::string("crash-") + program_invocation_short_name;
    for (const int signal : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGPROF}) std::signal(signal, keep_input);
    if (argc == 3 && std::string(argv[1]) == "--input") {
        run(test::read_file(argv[2]));
        return 0;
    }
    const std::chrono::duration<double> limit(argc > 1 ? std::atof(argv[1]) : 10.0);
    const auto start = std::chrono::steady_clock::now();
    const auto elapsed = [&] { return std::chrono::steady_clock::now() - start; };
    const std::vector<std::string> seeds = fuzz::seeds();
    for (const std::string &seed : seeds) run(seed);
    const std::size_t cuts = run_cuts(seeds, [&] { return elapsed() < limit / 2; });
    const std::size_t changes = run_changes(seeds, [&] { return elapsed() < limit; });
    std::printf("%zu seeds, %zu cuts, %zu changes\n", seeds.size(), cuts, changes);
    return 0;
}
