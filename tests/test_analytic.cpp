// Materials by parameter: their tables against the formulas written out again, and what comes back from a fit.
#include <gtest/gtest.h>

#include "close.h"
#include "support.h"

using oracle::Table;
using oracle::Vec;

namespace {

// Of formulas that are exact up to rounding.
constexpr double exact = 1e-9;
// Of Blinn-Phong's projected area, which is linear between samples (lib/projected_area.cpp).
constexpr double tabulated = 1e-4;
// As in test_inversion.cpp: the table's cells limit what an inversion gives back.
constexpr double alpha_tolerance = 0.01;
constexpr double fresnel_tolerance = 0.02;

test::Brdf open(const std::string &specification) {
    test::Brdf b;
    EXPECT_SMX_OK(smx_brdf_open(("analytic:" + specification).c_str(), b.out()));
    return b;
}

double schlick(double f0, double cos_d) { return f0 + (1.0 - f0) * std::pow(1.0 - cos_d, 5); }

// Compares the table at a spread of nodes with f(wi, wo), before the Fresnel factor. The larger the stride, the fewer.
template <class Lobe>
void expect_table(const std::string &specification, const oracle::Rgb &f0, double tolerance, int stride, Lobe lobe) {
    const Table table = test::filled_table(open(specification));
    int compared = 0;
    for (int h = 0; h < 90; h += 3 * stride)
        for (int d = 0; d < 90; d += 4 * stride)
            for (int p = 0; p < 180; p += 5 * stride + 3) {
                if (!oracle::above_horizon(h, d, p)) continue;
                const auto [wi, wo] = oracle::node_directions(h, d, p);
                const double f = lobe(wi, wo), cos_d = std::cos(test::radians(d));
                for (int c = 0; c < 3; ++c)
                    ASSERT_PRED_FORMAT4(test::close_to, table.at(c, h, d, p),
                                        schlick(f0[static_cast<std::size_t>(c)], cos_d) * f, tolerance, 1e-100)
                        << specification << " at " << h << ", " << d << ", " << p << ", channel " << c;
                ++compared;
            }
    EXPECT_GT(compared, 3000 / (stride * stride * stride));
}

// Masking by Smith's Lambda, as GGX is mostly written.
double ggx_lobe(const Vec &wi, const Vec &wo, double alpha) {
    const Vec h = oracle::half_vector(wi, wo);
    const double slope2 = (h.x * h.x + h.y * h.y) / (h.z * h.z), a2 = alpha * alpha;
    const double ndf = 1.0 / (oracle::pi * a2 * std::pow(h.z, 4) * std::pow(1.0 + slope2 / a2, 2));
    const auto lambda = [a2](const Vec &k) {
        return (std::sqrt(1.0 + a2 * (k.x * k.x + k.y * k.y) / (k.z * k.z)) - 1.0) / 2.0;
    };
    return ndf / (1.0 + lambda(wi) + lambda(wo)) / (4.0 * wi.z * wo.z);
}

double blinn_phong_ndf(double cos_h, double exponent) {
    return (exponent + 2.0) / (2.0 * oracle::pi) * std::pow(cos_h, exponent);
}

// Projected area by brute force over the hemisphere of normals.
double blinn_phong_sigma(const Vec &k, double exponent) {
    constexpr int polar = 600, azimuths = 300;
    const double sin_k = std::sqrt(std::max(1.0 - k.z * k.z, 0.0));
    double sum = 0.0;
    for (int j = 0; j < polar; ++j) {
        const double u = (j + 0.5) / polar, theta = u * u * oracle::pi / 2.0;
        double ring = 0.0;
        for (int a = 0; a < azimuths; ++a) {
            const double phi = (a + 0.5) * oracle::pi / azimuths;
            ring += std::max(k.z * std::cos(theta) + sin_k * std::sin(theta) * std::cos(phi), 0.0);
        }
        sum += ring / azimuths * blinn_phong_ndf(std::cos(theta), exponent) * std::sin(theta) * u;
    }
    return sum * 2.0 * oracle::pi * oracle::pi / polar;
}

double blinn_phong_lobe(const Vec &wi, const Vec &wo, double exponent) {
    const double sigma_i = blinn_phong_sigma(wi, exponent), sigma_o = blinn_phong_sigma(wo, exponent);
    const double ndf = blinn_phong_ndf(oracle::half_vector(wi, wo).z, exponent);
    return ndf / (4.0 * (sigma_i * wo.z + sigma_o * wi.z - wi.z * wo.z));
}

} // namespace

TEST(Analytic, BeckmannIsTheOracles) {
    expect_table("beckmann,alpha=0.3,f0=0.9/0.5/0.1", {0.9, 0.5, 0.1}, exact, 2, [](const Vec &wi, const Vec &wo) {
        return oracle::brdf(oracle::Mixture{{{1.0, 0.3}}, {}}, oracle::Masking::correlated, wi, wo);
    });
}

TEST(Analytic, GgxIsTheFormulaByLambda) {
    for (const double alpha : {0.05, 0.5})
        expect_table("ggx,alpha=" + std::to_string(alpha) + ",f0=0.25", {0.25, 0.25, 0.25}, exact, 2,
                     [alpha](const Vec &wi, const Vec &wo) { return ggx_lobe(wi, wo, alpha); });
}

TEST(Analytic, BlinnPhongIsMaskedByItsOwnNormals) {
    for (const double exponent : {0.0, 8.0, 200.0})
        expect_table("blinn-phong,exponent=" + std::to_string(exponent) + ",f0=1/0.5/0", {1.0, 0.5, 0.0}, tabulated, 5,
                     [exponent](const Vec &wi, const Vec &wo) { return blinn_phong_lobe(wi, wo, exponent); });
}

TEST(Analytic, LambertIsConstant) {
    const Table table = test::filled_table(open("lambert,albedo=0.5/1/0"));
    const double albedo[3] = {0.5, 1.0, 0.0};
    for (std::size_t k = 0; k < table.values.size(); ++k)
        ASSERT_NEAR(table.values[k], albedo[k / table.cells()] / oracle::pi, 1e-15);
}

TEST(Analytic, BeckmannGivesAlphaAndF0Back) {
    for (const double alpha : {0.02, 0.3, 0.8}) {
        const test::Brdf brdf = open("beckmann,alpha=" + std::to_string(alpha) + ",f0=0.9/0.6/0.3");
        const test::Material material = test::fit(test::make_density(brdf, SMX_MASKING_CORRELATED), 1);
        ASSERT_EQ(test::lobes_of(material).size(), 1u);
        EXPECT_CLOSE(test::lobes_of(material)[0].alpha, alpha, alpha_tolerance, 0.0);
        const test::Curves curves = test::curves_of(material);
        const double f0[3] = {0.9, 0.6, 0.3};
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t k : {std::size_t{0}, std::size_t{45}, std::size_t{70}})
                EXPECT_CLOSE(curves.fresnel[c * 91 + k], schlick(f0[c], std::cos(curves.theta_d[k])), fresnel_tolerance,
                             0.0)
                    << "alpha " << alpha << ", channel " << c << ", knot " << k;
    }
}

TEST(Analytic, DescribesItself) {
    smx_brdf_info info = SMX_BRDF_INFO_INIT;
    ASSERT_SMX_OK(smx_brdf_get_info(open("ggx,f0=0.9/0.6/0.5,alpha=0.2"), &info));
    EXPECT_STREQ(info.source, "analytic:ggx,f0=0.9/0.6/0.5,alpha=0.2");
    EXPECT_STREQ(info.name, "ggx,f0=0.9_0.6_0.5,alpha=0.2");
    EXPECT_EQ(info.filled_cells, 0u);
    EXPECT_EQ(std::string(info.sha256).size(), 64u);
}

TEST(Analytic, EndsOfTheRangesAreTables) {
    for (const char *legal : {"beckmann,alpha=1e-3,f0=0", "beckmann,alpha=10,f0=1", "ggx,alpha=1e-3,f0=1",
                              "ggx,alpha=10,f0=0", "blinn-phong,exponent=1e6,f0=1", "lambert,albedo=0"})
        EXPECT_TRUE(open(legal).get() != nullptr) << legal;
}

TEST(Analytic, WrongOnesAreRefusedByName) {
    const std::pair<const char *, const char *> wrong[] = {
        {"", "there are beckmann, ggx"},
        {"phong,exponent=3", "phong"},
        {"ggx", "alpha is missing"},
        {"ggx,alpha=0.2", "f0 is missing"},
        {"lambert,alpha=0.2", "no key \"alpha\""},
        {"ggx,alpha=0.2,f0=1,albedo=0.5", "no key \"albedo\""},
        {"ggx,alpha=0.2,f0=1,f0=1", "f0 is given twice"},
        {"ggx,alpha=0.2,f0", "not key=value"},
        {"ggx,alpha=0.2,f0=1,", "not key=value"},
        {"ggx,alpha=0.2,f0=", "0..1"},
        {"ggx,alpha=0.2,f0=0.1/0.2", "slashes"},
        {"ggx,alpha=0.2,f0=0.1/0.2/1.5", "1.5"},
        {"ggx,alpha=0.2,f0=-0.1", "0..1"},
        {"ggx,alpha=0.0009,f0=1", "0.001..10"},
        {"beckmann,alpha=10.1,f0=1", "0.001..10"},
        {"ggx,alpha=nan,f0=1", "nan"},
        {"ggx,alpha=0.2x,f0=1", "0.2x"},
        {"ggx,alpha=0.1/0.2/0.3,f0=1", "alpha"},
        {"blinn-phong,exponent=-1,f0=1", "0..1e+06"},
        {"lambert,albedo=1.01", "1.01"},
    };
    smx_brdf brdf = nullptr;
    for (const auto &[specification, needle] : wrong)
        EXPECT_SMX_FAILS(SMX_INVALID_ARGUMENT, needle,
                         smx_brdf_open((std::string("analytic:") + specification).c_str(), &brdf));
    EXPECT_EQ(brdf, nullptr);
}
