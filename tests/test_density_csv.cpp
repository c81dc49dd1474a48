// Slope densities from samples and from CSV files: known densities come back, and every fault of a file is named.
#include <gtest/gtest.h>

#include <cstdio>
#include <functional>
#include <numeric>

#include "close.h"
#include "files.h"
#include "support.h"

namespace {

// Of alpha, from a thousand rows: linear interpolation between them and the nodes' quadrature.
constexpr double alpha_tolerance = 1e-3;
// Of p22 on the nodes, from the same rows.
constexpr double density_tolerance = 2e-3;

using Radial = std::function<double(double theta)>;

double beckmann_p22(double theta, double alpha) {
    return std::exp(-std::pow(std::tan(theta) / alpha, 2)) / (oracle::pi * alpha * alpha);
}

double ggx_ndf(double theta, double alpha) {
    const double c2 = std::cos(theta) * std::cos(theta), root = c2 * (alpha * alpha - 1.0) + 1.0;
    return alpha * alpha / (oracle::pi * root * root);
}

// A thousand rows, denser towards 0.
std::string rows(const Radial &radial) {
    std::string text;
    for (int k = 0; k < 1000; ++k) {
        const double u = k / 999.0, theta = u * u * oracle::pi / 2.0;
        char line[80];
        std::snprintf(line, sizeof line, "%.17g,%.17g\n", theta, radial(theta));
        text += line;
    }
    return text;
}

test::Density read(const std::string &bytes) {
    const test::TempDir dir;
    test::write_file(dir / "d.csv", bytes);
    test::Density density;
    EXPECT_SMX_OK(smx_density_read_csv((dir / "d.csv").c_str(), density.out()));
    return density;
}

struct Nodes {
    std::vector<double> slope = std::vector<double>(90), p22 = slope, mass = slope;
};

Nodes nodes_of(smx_density density) {
    Nodes n;
    EXPECT_SMX_OK(smx_density_get_nodes(density, n.slope.data(), n.p22.data(), n.mass.data(), 90));
    return n;
}

smx_density_info info_of(smx_density density) {
    smx_density_info info = SMX_DENSITY_INFO_INIT;
    EXPECT_SMX_OK(smx_density_get_info(density, &info));
    return info;
}

void expect_fails(smx_status status, const std::string &needle, const std::string &bytes) {
    const test::TempDir dir;
    test::write_file(dir / "d.csv", bytes);
    smx_density density = nullptr;
    EXPECT_SMX_FAILS(status, needle, smx_density_read_csv((dir / "d.csv").c_str(), &density)) << bytes.substr(0, 80);
    EXPECT_EQ(density, nullptr);
}

} // namespace

TEST(DensityCsv, BeckmannGivesAlphaBack) {
    for (const double alpha : {0.05, 0.3, 0.8}) {
        const std::string body = rows([alpha](double t) { return 7.0 * beckmann_p22(t, alpha); });
        for (const char *header : {"theta,p22\n", "theta,value\n", ""}) {
            const test::Density density = read(header + body);
            EXPECT_CLOSE(info_of(density).alpha, alpha, alpha_tolerance, 0.0) << header;
            EXPECT_EQ(info_of(density).iterations, 0u);
            EXPECT_EQ(info_of(density).fresnel_knots, 91u);
            EXPECT_TRUE(info_of(density).converged);
            const std::vector<smx_lobe> lobes = test::lobes_of(test::fit(density, 1));
            EXPECT_CLOSE(lobes.at(0).alpha, alpha, alpha_tolerance, 0.0) << header;
        }
    }
}

TEST(DensityCsv, GgxIsNormalisedOnTheNodes) {
    constexpr double alpha = 0.3;
    const Nodes n = nodes_of(read("theta,ndf\n" + rows([](double t) { return 0.01 * ggx_ndf(t, alpha); })));
    EXPECT_CLOSE(std::accumulate(n.mass.begin(), n.mass.end(), 0.0), 1.0, 1e-12, 0.0);
    for (std::size_t j = 1; j < 90; ++j) {
        const double theta = std::atan(n.slope[j]);
        EXPECT_CLOSE(n.p22[j], ggx_ndf(theta, alpha) * std::pow(std::cos(theta), 4), density_tolerance, 0.0) << j;
    }
}

TEST(DensityCsv, BetweenAndBeyondTheRows) {
    // 1 up to theta = 0.5, then down to 0.5 at 1, then nothing. Ratios, since the density is normalised.
    const Nodes n = nodes_of(read("theta,p22\n0.5,1\n1,0.5\n"));
    for (std::size_t j = 1; j < 90; ++j) {
        const double theta = std::atan(n.slope[j]);
        const double wanted = theta <= 0.5 ? 1.0 : theta <= 1.0 ? 1.5 - theta : 0.0;
        EXPECT_CLOSE(n.p22[j] / n.p22[0], wanted, 1e-9, 0.0) << "theta " << theta;
    }
    EXPECT_GT(n.mass[0], 0.0);
}

TEST(DensityCsv, DialectsAreOneFile) {
    const Nodes plain = nodes_of(read("theta,ndf\n0,1\n0.25,0.5\n1.5707964,0\n"));
    for (const char *bytes :
         {"theta,ndf\r\n0,1\r\n0.25,0.5\r\n1.5707964,0\r\n", "\xEF\xBB\xBFtheta,ndf\n0,1\n0.25,5e-1\n1.5707964,0",
          "# a comment\n\n theta , ndf \n  0,\t1\n#0.1,7\n0.25 , .5\n\n1.5707964,0.\n"}) {
        const Nodes other = nodes_of(read(bytes));
        for (std::size_t j = 0; j < 90; ++j) ASSERT_EQ(plain.p22[j], other.p22[j]) << bytes;
    }
    const Nodes p22 = nodes_of(read("theta,p22\n0,1\n0.25,0.5\n1.5707964,0\n"));
    EXPECT_NE(plain.p22[50], p22.p22[50]);
}

TEST(DensityCsv, FaultsAreNamedWithTheirLine) {
    const std::pair<const char *, const char *> wrong[] = {
        {"", "0 rows"},
        {"theta,p22\n", "0 rows"},
        {"theta,p22\n0,1\n", "1 rows"},
        {"theta,ggx\n0,1\n1,0\n", "line 1"},
        {"angle,p22\n0,1\n1,0\n", "theta,ndf"},
        {"theta,p22\n# c\n0,1\n\n1,x\n", "line 5"},
        {"theta,p22\n0,1\ntheta,p22\n1,0\n", "line 3"},
        {"theta,p22\n0;1\n1;0\n", "line 2"},
        {"theta,p22\n0,1,2\n1,0,2\n", "comma"},
        {"theta,p22\n0,1\n,0\n", "line 3"},
        {"theta,p22\n0,1\n1,\n", "finite"},
        {"theta,p22\n0,1\n1,nan\n", "nan"},
        {"theta,p22\n0,1\n1,inf\n", "inf"},
        {"theta,p22\n0,1\n1,1e999\n", "1e999"},
        {"theta,p22\n0,1\n1,1e31\n", "1e+30"},
        {"theta,p22\n0,1\n1,-1e-9\n", "line 3: the value is -1e-09"},
        {"theta,p22\n0,1\n0,0.5\n", "not above"},
        {"theta,p22\n0.5,1\n0.25,0.5\n", "0.25"},
        {"theta,p22\n-0.1,1\n1,0\n", "line 2"},
        {"theta,p22\n0,1\n45,0.5\n90,0\n", "radians"},
        {"theta,p22\n0,1\n1.58,0.5\n", "1.58"},
        {"theta,p22\n0,\"1\"\n1,0\n", "line 2"},
    };
    for (const auto &[bytes, needle] : wrong) expect_fails(SMX_BAD_FORMAT, needle, bytes);
    expect_fails(SMX_NO_SOLUTION, "0 at every", "0,0\n1,0\n");
    expect_fails(SMX_BAD_FORMAT, "16777216", std::string((std::size_t{16} << 20) + 1, '\n'));
}

TEST(DensityCsv, MaterialsKeepTheFilesIdentity) {
    const test::TempDir dir;
    const std::string path = dir / "measured.csv";
    test::write_file(path, "0,1\n1,0\n");
    test::Density density;
    ASSERT_SMX_OK(smx_density_read_csv(path.c_str(), density.out()));
    const test::Material material = test::fit(density, 2);
    EXPECT_STREQ(test::info_of(material).name, "measured");
    EXPECT_EQ(test::info_of(material).source, path);
    // sha256sum of the eight bytes
    EXPECT_STREQ(test::info_of(material).sha256, "6101ec16015a127b9102cbc34d949c2a38335e11642cfd15c2f992197efa7722");
    for (const double f : test::curves_of(material).fresnel) EXPECT_EQ(f, 1.0);
    ASSERT_SMX_OK(smx_material_save(material, (dir / "m.json").c_str()));
    test::Material loaded;
    ASSERT_SMX_OK(smx_material_load((dir / "m.json").c_str(), loaded.out()));
}

TEST(DensitySamples, AreTheFilesOwn) {
    const double theta[] = {0.0, 0.3, 1.2}, values[] = {5.0, 1.0, 0.25};
    for (const auto &[kind, header] : {std::pair{SMX_DENSITY_P22, "theta,p22"}, {SMX_DENSITY_NDF, "theta,ndf"}}) {
        test::Density from_arrays;
        ASSERT_SMX_OK(smx_density_from_samples("x", kind, 3, theta, values, from_arrays.out()));
        const Nodes a = nodes_of(from_arrays), b = nodes_of(read(std::string(header) + "\n0,5\n0.3,1\n1.2,0.25\n"));
        for (std::size_t j = 0; j < 90; ++j) ASSERT_EQ(a.p22[j], b.p22[j]);
    }
}

TEST(DensitySamples, HaveNoPerLobeModel) {
    const double theta[] = {0.0, 1.0}, values[] = {1.0, 0.0};
    test::Density density;
    ASSERT_SMX_OK(smx_density_from_samples("x", SMX_DENSITY_P22, 2, theta, values, density.out()));
    smx_material material = nullptr;
    EXPECT_SMX_FAILS(SMX_INVALID_ARGUMENT, "no BRDF", smx_material_fit(density, nullptr, &material));
    EXPECT_EQ(material, nullptr);
}
