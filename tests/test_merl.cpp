// MERL files: what is read, what is refused and why, and what is written.
#include <gtest/gtest.h>

#include <cstdio>
#include <limits>

#include "close.h"
#include "merl_writer.h"
#include "support.h"

using oracle::Rgb;
using oracle::Table;
using oracle::Vec;

namespace {

// One multiplication and one division by the channel's scale.
constexpr double scaling_tolerance = 1e-15;

// Different in every cell and channel, -1 below the horizon.
Table test_table(int phi_d) {
    double counter = 0.0;
    return oracle::make_table(phi_d, [&](const Vec &, const Vec &) {
        counter += 1.0;
        return Rgb{1e-6 * counter, 2e-6 * counter, 3e-6 * counter};
    });
}

const Table &table_180() {
    static const Table t = test_table(180);
    return t;
}

const std::string &file_180() {
    static const std::string bytes = test::merl_file(table_180());
    return bytes;
}

test::Brdf open(const std::string &path) {
    test::Brdf b;
    EXPECT_SMX_OK(smx_brdf_open(path.c_str(), b.out()));
    return b;
}

smx_brdf_info info_of(smx_brdf brdf) {
    smx_brdf_info info = SMX_BRDF_INFO_INIT;
    EXPECT_SMX_OK(smx_brdf_get_info(brdf, &info));
    return info;
}

void expect_refused(const std::string &bytes, smx_status status, const std::string &needle) {
    const test::TempDir dir;
    test::write_file(dir / "bad.binary", bytes);
    smx_brdf brdf = nullptr;
    EXPECT_SMX_FAILS(status, needle, smx_brdf_open((dir / "bad.binary").c_str(), &brdf));
    EXPECT_NE(std::string(smx_last_error()).find("bad"), std::string::npos) << smx_last_error();
    EXPECT_EQ(brdf, nullptr);
}

std::string with_value(std::size_t index, double value) {
    std::string bytes = file_180();
    std::memcpy(bytes.data() + 12 + 8 * index, &value, 8);
    return bytes;
}

std::string sha256_of_file(const std::string &path) {
    FILE *pipe = popen(("sha256sum '" + path + "'").c_str(), "r");
    char digest[65] = "";
    if (pipe == nullptr || std::fread(digest, 1, 64, pipe) != 64) ADD_FAILURE() << "no sha256sum";
    if (pipe != nullptr) pclose(pipe);
    return digest;
}

void expect_values_of(smx_brdf brdf, const Table &table) {
    const Table got = test::filled_table(brdf);
    for (std::size_t k = 0; k < table.values.size(); ++k) {
        if (table.values[k] < 0.0) continue;
        ASSERT_TRUE(test::is_close(got.values[k], table.values[k], scaling_tolerance, 0.0)) << "value " << k;
    }
}

} // namespace

TEST(Merl, ReadsBothAzimuths) {
    for (const int phi_d : {180, 360}) {
        const Table table = phi_d == 180 ? table_180() : test_table(360);
        const test::TempDir dir;
        test::write_file(dir / "ramp.binary", test::merl_file(table));
        const test::Brdf brdf = open(dir / "ramp.binary");
        const smx_brdf_info info = info_of(brdf);
        EXPECT_EQ(info.theta_h, 90u);
        EXPECT_EQ(info.theta_d, 90u);
        EXPECT_EQ(info.phi_d, static_cast<uint32_t>(phi_d));
        EXPECT_EQ(info.cells, table.cells());
        EXPECT_STREQ(info.name, "ramp");
        EXPECT_EQ(std::string(info.source), dir / "ramp.binary");
        EXPECT_EQ(std::string(info.sha256), sha256_of_file(dir / "ramp.binary"));
        expect_values_of(brdf, table);
    }
}

TEST(Merl, CountsInvalidCells) {
    const test::TempDir dir;
    Table table = table_180();
    uint64_t below = 0;
    for (std::size_t k = 0; k < table.cells(); ++k) below += table.values[k] < 0.0;
    // One negative channel makes a cell invalid; a negative zero does not.
    const std::size_t green = table.cells() + table.index(5, 20, 30);
    table.values[green] = -0.5;
    table.values[2 * table.cells() + table.index(6, 20, 30)] = -0.0;
    const smx_brdf_info info = info_of(test::make_brdf(table));
    EXPECT_EQ(info.invalid_cells, below + 1);
    EXPECT_EQ(info.filled_cells, 1u);
}

TEST(Merl, RefusesWrongDimensions) {
    for (const std::array<int32_t, 3> &dims :
         {std::array<int32_t, 3>{91, 90, 180}, {90, 89, 180}, {90, 90, 181}, {90, 90, 0}, {-90, -90, 180}, {0, 0, 0}}) {
        std::string bytes = file_180();
        std::memcpy(bytes.data(), dims.data(), 12);
        std::string wrong;
        for (std::size_t k = 0; k < 3; ++k)
            if (dims[k] != (k == 2 ? 180 : 90)) wrong = std::to_string(dims[k]);
        expect_refused(bytes, SMX_BAD_FORMAT, wrong);
    }
}

TEST(Merl, RefusesWrongLengths) {
    const std::string &good = file_180();
    expect_refused("", SMX_BAD_FORMAT, "0");
    expect_refused(good.substr(0, 11), SMX_BAD_FORMAT, "11");
    expect_refused(good.substr(0, 12), SMX_BAD_FORMAT, "12");
    expect_refused(good.substr(0, good.size() - 1), SMX_BAD_FORMAT, std::to_string(good.size() - 1));
    expect_refused(good + '\0', SMX_BAD_FORMAT, std::to_string(good.size() + 1));
    expect_refused(good + good, SMX_BAD_FORMAT, std::to_string(2 * good.size()));
}

TEST(Merl, RefusesNanAndInfinity) {
    const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
    const std::size_t last = 3 * table_180().cells() - 1;
    expect_refused(with_value(0, nan), SMX_BAD_FORMAT, "nan");
    expect_refused(with_value(last, nan), SMX_BAD_FORMAT, "nan");
    expect_refused(with_value(last, inf), SMX_BAD_FORMAT, "inf");
    expect_refused(with_value(12345, -inf), SMX_BAD_FORMAT, "inf");
}

TEST(Merl, RefusesTablesWithoutAValidCell) {
    const std::vector<double> invalid(3 * table_180().cells(), -1.0);
    expect_refused(test::merl_bytes({90, 90, 180}, invalid), SMX_BAD_FORMAT, "valid");
    smx_brdf brdf = nullptr;
    EXPECT_SMX_FAILS(SMX_BAD_FORMAT, "valid", smx_brdf_create("none", 180, invalid.data(), &brdf));
    EXPECT_EQ(brdf, nullptr);
}

TEST(Merl, MissingFilesCannotBeRead) {
    const test::TempDir dir;
    smx_brdf brdf = nullptr;
    EXPECT_SMX_FAILS(SMX_CANNOT_READ, "no-such-file", smx_brdf_open((dir / "no-such-file.binary").c_str(), &brdf));
    EXPECT_SMX_FAILS(SMX_CANNOT_READ, dir.path(), smx_brdf_open(dir.path().c_str(), &brdf));
    EXPECT_EQ(brdf, nullptr);
}

TEST(Merl, WritesWhatItRead) {
    const test::TempDir dir;
    test::write_file(dir / "in.binary", file_180());
    const test::Brdf in = open(dir / "in.binary");
    ASSERT_SMX_OK(smx_brdf_write(in, (dir / "out.binary").c_str()));
    const std::string out = test::read_file(dir / "out.binary");
    ASSERT_EQ(out.size(), file_180().size());
    EXPECT_EQ(out.substr(0, 12), file_180().substr(0, 12));
    for (std::size_t at = 12; at < out.size(); at += 8) {
        double got = 0.0, wanted = 0.0;
        std::memcpy(&got, out.data() + at, 8);
        std::memcpy(&wanted, file_180().data() + at, 8);
        ASSERT_TRUE(test::is_close(got, wanted, scaling_tolerance, 0.0)) << "byte " << at;
        ASSERT_EQ(got < 0.0, wanted < 0.0) << "byte " << at;
    }
    expect_values_of(open(dir / "out.binary"), table_180());
}

TEST(Merl, CreatedTablesHaveTheHashOfTheirFile) {
    const test::TempDir dir;
    const test::Brdf brdf = test::make_brdf(table_180());
    ASSERT_SMX_OK(smx_brdf_write(brdf, (dir / "made.binary").c_str()));
    EXPECT_EQ(std::string(info_of(brdf).sha256), sha256_of_file(dir / "made.binary"));
    expect_values_of(open(dir / "made.binary"), table_180());
}

TEST(Merl, FailedWritesLoseNothing) {
    const test::TempDir dir;
    const test::Brdf brdf = test::make_brdf(table_180());
    test::write_file(dir / "kept.binary", "precious");
    {
        const test::FileSizeLimit full(1 << 20);
        EXPECT_SMX_FAILS(SMX_CANNOT_WRITE, "kept.binary", smx_brdf_write(brdf, (dir / "kept.binary").c_str()));
    }
    EXPECT_EQ(test::read_file(dir / "kept.binary"), "precious");
    EXPECT_SMX_FAILS(SMX_CANNOT_WRITE, "absent", smx_brdf_write(brdf, (dir / "absent/x.binary").c_str()));
    std::filesystem::create_directory(dir / "folder");
    EXPECT_SMX_FAILS(SMX_CANNOT_WRITE, "folder", smx_brdf_write(brdf, (dir / "folder").c_str()));
    EXPECT_EQ(dir.names(), (std::vector<std::string>{"folder", "kept.binary"}));
}
