#include "cli.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

#include "files.h"

namespace test {
namespace {

// In the child: streams to files, the setting, and the binary. Does not return.
[[noreturn]] void become_cli(const std::vector<std::string> &arguments, const CliSetting &setting,
                             const std::string &out, const std::string &err) {
    if (!std::freopen("/dev/null", "r", stdin) || !std::freopen(out.c_str(), "w", stdout) ||
        !std::freopen(err.c_str(), "w", stderr))
        _exit(126);
    for (const auto &[name, value] : setting.environment) setenv(name.c_str(), value.c_str(), 1);
    if (setting.file_size_limit > 0) {
        std::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{setting.file_size_limit, setting.file_size_limit};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    std::vector<char *> argv;
    std::string program = SLOPEMIX_CLI;
    argv.push_back(program.data());
    std::vector<std::string> copies = arguments;
    for (std::string &a : copies) argv.push_back(a.data());
    argv.push_back(nullptr);
    execv(program.c_str(), argv.data());
    _exit(127);
}

// Looks every few milliseconds; false: the child has ended.
bool wait_for(pid_t child, const std::function<bool()> &moment) {
    siginfo_t ended{};
    while (!moment()) {
        if (waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOHANG | WNOWAIT) != 0 || ended.si_pid != 0)
            return false;
        usleep(2000);
    }
    return true;
}

void hold(pid_t child, const std::function<void()> &meanwhile) {
    siginfo_t stopped{};
    kill(child, SIGSTOP);
    waitid(P_PID, static_cast<id_t>(child), &stopped, WSTOPPED | WEXITED | WNOWAIT);
    meanwhile();
    kill(child, SIGCONT);
}

} // namespace

CliResult cli(const std::vector<std::string> &arguments, const CliSetting &setting) {
    const TempDir dir;
    const std::string out = dir / "out", err = dir / "err";
    const pid_t child = fork();
    if (child < 0) throw std::runtime_error("cannot fork");
    if (child == 0) become_cli(arguments, setting, out, err);
    int status = 0;
    if (setting.signal_when && wait_for(child, setting.signal_when)) {
        if (setting.signal != 0) kill(child, setting.signal);
        if (setting.meanwhile) hold(child, setting.meanwhile);
    }
    if (waitpid(child, &status, 0) != child) throw std::runtime_error("cannot wait");
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_file(out), read_file(err)};
}

std::vector<std::string> with(std::vector<std::string> base, const std::vector<std::string> &more) {
    base.insert(base.end(), more.begin(), more.end());
    return base;
}

std::vector<std::string> replaced(std::vector<std::string> base, const std::string &flag, const std::string &value) {
    const auto at = std::find(base.begin(), base.end(), flag);
    if (at == base.end() || at + 1 == base.end()) throw std::logic_error("no " + flag + " to replace");
    *(at + 1) = value;
    return base;
}

} // namespace test
