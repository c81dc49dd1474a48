#include "density_csv.h"

#include <filesystem>

#include "error.h"
#include "parse_number.h"
#include "read_file.h"
#include "sha256.h"

namespace smx {

namespace {

constexpr std::size_t max_bytes = std::size_t{16} << 20;
constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
constexpr std::string_view blanks = " \t\r";

std::string_view trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(blanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

struct Fields {
    std::string_view first, second;
};

// Reads the lines that count, one after the other.
class DensityLines {
  public:
    DensityLines(std::string_view bytes, const std::string &path) : rest_(bytes), path_(path) {
        if (rest_.starts_with(byte_order_mark)) rest_.remove_prefix(byte_order_mark.size());
    }

    // The next line's two fields; nothing at the end.
    std::optional<Fields> next() {
        while (!rest_.empty()) {
            const std::size_t end = rest_.find('\n');
            const std::string_view line = trimmed(rest_.substr(0, end));
            rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
            ++number_;
            if (!line.empty() && !line.starts_with('#')) return fields(line);
        }
        return std::nullopt;
    }

    template <typename... Why>
    [[noreturn]] void refuse(const Why &...why) const {
        fail(Fault::BadFormat, path_, ", line ", number_, ": ", why...);
    }

  private:
    Fields fields(std::string_view line) const {
        const std::size_t comma = line.find(',');
        if (comma == std::string_view::npos || line.find(',', comma + 1) != std::string_view::npos)
            refuse("it must hold two values with a comma between them");
        return {trimmed(line.substr(0, comma)), trimmed(line.substr(comma + 1))};
    }

    std::string_view rest_;
    const std::string &path_;
    std::size_t number_ = 0;
};

double number(const DensityLines &lines, std::string_view field) {
    const std::optional<double> value = parse_number(field);
    if (!value) lines.refuse("\"", field.substr(0, 40), "\" is not a finite number");
    return *value;
}

void append(const DensityLines &lines, Fields fields, DensitySamples &samples) {
    const double theta = number(lines, fields.first), value = number(lines, fields.second);
    const auto fault = sample_fault(theta, value, samples.theta.empty() ? -1.0 : samples.theta.back());
    if (fault) lines.refuse(*fault);
    samples.theta.push_back(theta);
    samples.values.push_back(value);
}

// Whether the line is a header, which then says what the values are.
bool take_header(const DensityLines &lines, Fields fields, DensitySamples &samples) {
    if (parse_number(fields.first)) return false;
    const bool is_ndf = fields.second == "ndf", is_p22 = fields.second == "p22" || fields.second == "value";
    if (fields.first != "theta" || (!is_ndf && !is_p22))
        lines.refuse("\"", fields.first.substr(0, 40), ",", fields.second.substr(0, 40),
                     "\" is neither two numbers nor a header; that is theta,p22 or theta,ndf or theta,value");
    samples.kind = is_ndf ? DensityKind::Ndf : DensityKind::P22;
    return true;
}

} // namespace

DensitySamples parse_density_csv(std::string_view bytes, const std::string &path) {
    DensityLines lines(bytes, path);
    DensitySamples samples;
    bool at_first = true;
    while (const std::optional<Fields> fields = lines.next()) {
        if (!at_first || !take_header(lines, *fields, samples)) append(lines, *fields, samples);
        at_first = false;
    }
    if (samples.theta.size() < 2)
        fail(Fault::BadFormat, path, ": ", samples.theta.size(), " rows of numbers; a density needs at least 2");
    return samples;
}

SlopeDensity read_density_csv(const std::string &path) {
    const std::string bytes = read_file(path, max_bytes);
    SlopeDensity density = density_from_samples(parse_density_csv(bytes, path));
    density.name = std::filesystem::path(path).stem().string();
    density.source = path;
    density.sha256 = sha256_hex(bytes);
    return density;
}

} // namespace smx
