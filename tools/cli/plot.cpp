#include "plot.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>

#include "handles.h"
#include "interrupt.h"
#include "text.h"

namespace slopemix::cli {

namespace {

// An unnamed file, so that neither side of a pipe waits for the other.
class Scratch {
  public:
    Scratch() : file_(std::tmpfile()) {
        if (!file_) throw CommandError(std::string("cannot make a temporary file: ") + std::strerror(errno));
        fcntl(descriptor(), F_SETFD, FD_CLOEXEC);
    }

    int descriptor() const { return fileno(file_.get()); }

    void fill(const std::string &text) {
        if (std::fwrite(text.data(), 1, text.size(), file_.get()) != text.size() || std::fflush(file_.get()) != 0)
            throw CommandError(std::string("cannot write a temporary file: ") + std::strerror(errno));
        std::rewind(file_.get());
    }

    std::string content() {
        std::rewind(file_.get());
        std::string text;
        std::array<char, 65536> part;
        while (const std::size_t size = std::fread(part.data(), 1, part.size(), file_.get()))
            text.append(part.data(), size);
        return text;
    }

  private:
    struct Close {
        void operator()(std::FILE *file) const { std::fclose(file); }
    };
    std::unique_ptr<std::FILE, Close> file_;
};

// The three standard streams of a child.
class Streams {
  public:
    Streams(const Scratch &in, const Scratch &out, const Scratch &err) {
        posix_spawn_file_actions_init(&actions_);
        posix_spawn_file_actions_adddup2(&actions_, in.descriptor(), STDIN_FILENO);
        posix_spawn_file_actions_adddup2(&actions_, out.descriptor(), STDOUT_FILENO);
        posix_spawn_file_actions_adddup2(&actions_, err.descriptor(), STDERR_FILENO);
    }
    ~Streams() { posix_spawn_file_actions_destroy(&actions_); }
    Streams(const Streams &) = delete;
    Streams &operator=(const Streams &) = delete;

    const posix_spawn_file_actions_t *get() const { return &actions_; }

  private:
    posix_spawn_file_actions_t actions_;
};

std::string ending_of(int status) {
    if (WIFSIGNALED(status)) return "signal " + std::to_string(WTERMSIG(status));
    return "status " + std::to_string(WEXITSTATUS(status));
}

// Runs gnuplot, without the user's own settings, and returns what it wrote.
std::string gnuplot(const std::string &argument, const std::string &script) {
    Scratch in, out, err;
    in.fill(script);
    const Streams streams(in, out, err);
    std::string program = "gnuplot", defaults = "-d", last = argument;
    const std::array<char *, 4> arguments = {program.data(), defaults.data(), last.data(), nullptr};
    pid_t child = 0;
    if (const int error = posix_spawnp(&child, "gnuplot", streams.get(), nullptr, arguments.data(), environ))
        throw CommandError(std::string("cannot run gnuplot, which draws the pictures: ") + std::strerror(error) +
                           "; it is Debian's package gnuplot-nox");
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    stop_if_interrupted();
    if (status != 0) throw CommandError("gnuplot ended with " + ending_of(status) + ": " + err.content());
    return out.content();
}

std::string hexadecimal(const std::array<double, 3> &rgb) {
    std::string colour = "#";
    for (const double channel : rgb) {
        const auto byte = static_cast<unsigned>(std::lround(channel));
        colour += {"0123456789abcdef"[byte / 16], "0123456789abcdef"[byte % 16]};
    }
    return colour;
}

} // namespace

void require_gnuplot() { gnuplot("--version", ""); }

std::string run_gnuplot(const std::string &script) {
    std::string svg = gnuplot("-", script);
    if (svg.find("</svg>") == std::string::npos) throw CommandError("gnuplot drew nothing");
    return svg;
}

std::string chart_head(int width, int height) {
    return "set encoding utf8\n"
           "set terminal svg size " +
           std::to_string(width) + ',' + std::to_string(height) +
           " dynamic enhanced font 'sans-serif,13' background '#ffffff'\n"
           "set border 3 linecolor '#555555' linewidth 0.8\n"
           "set tics nomirror scale 0.6,0.3 textcolor '#333333'\n"
           "set grid xtics ytics linetype 1 linecolor '#e4e4e4' linewidth 0.6\n"
           "set title offset 0,-0.3 textcolor '#111111'\n"
           "set key textcolor '#333333' samplen 1.6 spacing 1.1 noautotitle\n";
}

std::string chart_text(const std::string &text) {
    std::string quoted = "'";
    for (const char c : to_utf8(text)) {
        if (c == '\'') quoted += c;
        quoted += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? ' ' : c;
    }
    return quoted + '\'';
}

std::string chart_number(double value) {
    if (!std::isfinite(value)) return "NaN";
    std::array<char, 32> buffer;
    return {buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr};
}

std::string chart_data(const std::string &name, const std::vector<std::vector<double>> &rows) {
    std::string block = '$' + name + " << EOD\n";
    for (const std::vector<double> &row : rows) {
        for (const double value : row) block += chart_number(value) + ' ';
        block.back() = '\n';
    }
    return block + "EOD\n";
}

std::vector<std::string> chart_shades(std::size_t count) {
    constexpr std::array<std::array<double, 3>, 3> stops = {{{166, 208, 232}, {52, 128, 188}, {10, 32, 74}}};
    std::vector<std::string> shades;
    for (std::size_t k = 0; k < count; ++k) {
        const double at = count > 1 ? 2.0 * static_cast<double>(k) / static_cast<double>(count - 1) : 2.0;
        const std::size_t stop = at < 1.0 ? 0 : 1;
        std::array<double, 3> rgb;
        for (std::size_t c = 0; c < 3; ++c)
            rgb[c] = std::lerp(stops[stop][c], stops[stop + 1][c], at - static_cast<double>(stop));
        shades.push_back(hexadecimal(rgb));
    }
    return shades;
}

} // namespace slopemix::cli
