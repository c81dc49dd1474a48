// Files that end too early, at every byte that may matter to their reader: an error that names the file, never a crash
// or half an object.
#include <gtest/gtest.h>

#include <filesystem>

#include "files.h"
#include "fit_job.h"
#include "fit_table.h"
#include "merl_writer.h"
#include "support.h"

namespace fs = std::filesystem;

namespace {

// Writes the first bytes of a file and reads them again, for every length below the whole.
template <class Reader>
void expect_refused_cuts(const std::string &whole, const std::string &path, Reader read) {
    ASSERT_GT(whole.size(), 0u);
    for (std::size_t size = 0; size < whole.size(); ++size) {
        test::write_file(path, whole.substr(0, size));
        read(size);
        if (testing::Test::HasFailure()) FAIL() << "cut at byte " << size << " of " << whole.size();
    }
}

// Everything after it is a blank.
std::size_t end_of(const std::string &text) { return text.find_last_not_of(" \n") + 1; }

smx_status open_brdf(const std::string &path, smx_brdf *brdf) { return smx_brdf_open(path.c_str(), brdf); }

std::vector<std::uintmax_t> interesting_lengths(std::uintmax_t plane) {
    std::vector<std::uintmax_t> lengths;
    const auto around = [&](std::uintmax_t byte, std::uintmax_t reach) {
        for (std::uintmax_t at = byte > reach ? byte - reach : 0; at <= byte + reach; ++at) lengths.push_back(at);
    };
    around(6, 6); // the header's fields
    for (std::uintmax_t k = 0; k <= 3; ++k) around(12 + k * plane, 9);
    around(12 + plane / 2, 9);
    return lengths;
}

} // namespace

TEST(CutFiles, Merl) {
    const test::TempDir dir;
    const std::string path = dir / "cut.binary";
    const oracle::Table table = oracle::make_table(180, [](const oracle::Vec &, const oracle::Vec &) {
        return oracle::Rgb{1.0, 1.0, 1.0};
    });
    const std::uintmax_t plane = 8 * table.cells(), whole = 12 + 3 * plane;
    test::write_file(path, test::merl_file(table));
    std::vector<std::uintmax_t> lengths = interesting_lengths(plane);
    std::sort(lengths.rbegin(), lengths.rend()); // a file that is lengthened has zeros at its end
    for (const std::uintmax_t length : lengths) {
        fs::resize_file(path, length);
        smx_brdf brdf = nullptr;
        if (length == whole) {
            EXPECT_SMX_OK(open_brdf(path, &brdf));
            smx_brdf_release(brdf);
        } else {
            EXPECT_SMX_FAILS(SMX_BAD_FORMAT, "cut.binary: " + std::to_string(length), open_brdf(path, &brdf)) << length;
            EXPECT_EQ(brdf, nullptr);
        }
    }
}

TEST(CutFiles, MaterialJson) {
    const test::TempDir dir;
    const std::string path = dir / "cut.json";
    for (const smx_model model : {SMX_MODEL_SHARED, SMX_MODEL_PER_LOBE}) {
        const std::vector<double> fresnel(model == SMX_MODEL_SHARED ? 6 : 12, 0.25);
        const test::Material material = test::make_material(model, {{0.25, 0.1}, {0.75, 0.5}}, fresnel, 2);
        ASSERT_SMX_OK(smx_material_save(material, path.c_str()));
        const std::string text = test::read_file(path);
        expect_refused_cuts(text.substr(0, end_of(text)), path, [&](std::size_t) {
            smx_material cut = nullptr;
            EXPECT_SMX_FAILS(SMX_BAD_FORMAT, "cut.json", smx_material_load(path.c_str(), &cut));
            EXPECT_EQ(cut, nullptr);
        });
    }
}

// A CSV file has no end of its own: what is left may be a shorter density.
TEST(CutFiles, DensityCsv) {
    const test::TempDir dir;
    const std::string path = dir / "cut.csv";
    const std::string text = "# paint\ntheta,ndf\n0,3.5\n0.25,1.5e-1\n1.5,0\n";
    const std::size_t second_row = text.find("0.25,1");
    expect_refused_cuts(text, path, [&](std::size_t size) {
        smx_density density = nullptr;
        const smx_status status = smx_density_read_csv(path.c_str(), &density);
        EXPECT_EQ(status == SMX_OK, density != nullptr);
        if (status != SMX_OK) {
            EXPECT_EQ(status, SMX_BAD_FORMAT);
            EXPECT_NE(std::string(smx_last_error()).find("cut.csv"), std::string::npos) << smx_last_error();
        }
        if (size < second_row + 6) {
            EXPECT_NE(status, SMX_OK);
        }
        smx_density_release(density);
    });
}

TEST(CutFiles, Exr) {
    const test::TempDir dir;
    const std::string path = dir / "cut.exr";
    std::vector<float> rgba(std::size_t{4} * 9 * 40); // three blocks of rows
    for (std::size_t k = 0; k < rgba.size(); ++k) rgba[k] = 0.01f * static_cast<float>(k % 61);
    test::Image image;
    ASSERT_SMX_OK(smx_image_create(9, 40, rgba.data(), image.out()));
    ASSERT_SMX_OK(smx_image_set_attribute(image, "slopemix.note", "whole"));
    ASSERT_SMX_OK(smx_image_write_exr(image, path.c_str()));
    expect_refused_cuts(test::read_file(path), path, [&](std::size_t) {
        smx_image cut = nullptr;
        EXPECT_SMX_FAILS(SMX_BAD_FORMAT, "cut.exr", smx_image_read_exr(path.c_str(), &cut));
        EXPECT_EQ(cut, nullptr);
    });
}

TEST(CutFiles, TableOfFits) {
    using namespace slopemix::cli;
    const test::TempDir dir;
    FitTable table(dir.path());
    table.put({{"name", "paint"}, {"alpha", {0.1, nullptr}}, {"options", "--lobes 2"}, {"seconds", 0.125}});
    table.save();
    const std::string path = FitTable::json_in(dir.path()), text = test::read_file(path);
    expect_refused_cuts(text.substr(0, end_of(text)), path, [&](std::size_t) {
        try {
            const FitTable cut(dir.path());
            ADD_FAILURE() << "read";
        } catch (const CommandError &error) {
            EXPECT_NE(std::string(error.what()).find("cannot read " + path), std::string::npos) << error.what();
        }
    });
}
