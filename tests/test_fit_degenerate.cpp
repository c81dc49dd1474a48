// Tables that try to break the fit: it gives a material of finite, ordered numbers, the one that the clean table gives,
// or an error.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "support.h"

namespace {

// Of the alphas, and of the relRMSE on a displaced sphere, of a spoilt table's fit against the clean one's.
constexpr double alpha_tolerance = 0.05;
constexpr double relrmse_tolerance = 0.01;
// One lobe is one lobe, however many were asked for.
constexpr double likelihood_tolerance = 1e-6;
// A table's scale is in its curves alone; relative.
constexpr double scale_tolerance = 1e-6;
// A Lambertian on a displaced surface under the closed form: its own error grows with the roughness (0.03, 0.08, 0.22
// at alpha 0.1, 0.25 and 0.5; the fit makes up for what it can without spoiling the base).
constexpr double lambertian_base_limit = 0.05, lambertian_displaced_limit = 0.13;
// Above its bound an albedo may be by the roundings of the curves' interpolation to whole degrees.
constexpr double albedo_tolerance = 2e-3;

constexpr std::size_t theta_h = 90, theta_d = 90, phi_d = 180, cells = theta_h * theta_d * phi_d;

struct Values {
    std::vector<double> of = std::vector<double>(3 * cells);
    double &at(std::size_t channel, std::size_t h, std::size_t d, std::size_t p) {
        return of[channel * cells + (h * theta_d + d) * phi_d + p];
    }
};

test::Brdf open(const std::string &input) {
    test::Brdf brdf;
    EXPECT_SMX_OK(smx_brdf_open(input.c_str(), brdf.out()));
    return brdf;
}

Values values_of(const std::string &input) {
    Values values;
    EXPECT_SMX_OK(smx_brdf_get_values(open(input), values.of.data(), values.of.size()));
    return values;
}

test::Brdf brdf_of(const Values &values) {
    test::Brdf brdf;
    EXPECT_SMX_OK(smx_brdf_create("degenerate", phi_d, values.of.data(), brdf.out()));
    return brdf;
}

struct Fitted {
    test::Material material;
    smx_fit_report report = SMX_FIT_REPORT_INIT;
    std::vector<smx_lobe> lobes;
};

Fitted fit(smx_brdf brdf, uint32_t lobes, smx_model model = SMX_MODEL_PER_LOBE) {
    Fitted fitted;
    fitted.material = test::fit(test::make_density(brdf, SMX_MASKING_COINCIDES), lobes, model);
    EXPECT_SMX_OK(smx_material_get_report(fitted.material, &fitted.report));
    fitted.lobes = test::lobes_of(fitted.material);
    return fitted;
}

void expect_sound(const Fitted &fitted) {
    double sum = 0.0, before = 0.0;
    for (const smx_lobe &lobe : fitted.lobes) {
        EXPECT_TRUE(std::isfinite(lobe.weight) && lobe.weight >= 0.0) << lobe.weight;
        EXPECT_TRUE(lobe.alpha >= 1e-4 && lobe.alpha <= 1e4) << lobe.alpha;
        EXPECT_GE(lobe.alpha, before);
        before = lobe.alpha;
        sum += lobe.weight;
    }
    EXPECT_NEAR(sum, 1.0, 1e-9);
    for (const double f : test::curves_of(fitted.material).fresnel) EXPECT_TRUE(std::isfinite(f) && f >= 0.0) << f;
    const smx_fit_report &r = fitted.report;
    for (const double figure : {r.log_likelihood, r.residual, r.brdf_residual, r.base_relrmse, r.displaced_relrmse})
        EXPECT_TRUE(std::isfinite(figure)) << figure;
    EXPECT_GE(r.log_likelihood, r.log_likelihood_em - likelihood_tolerance);
}

void expect_within_albedo_bound(smx_material material) {
    std::array<std::array<double, 3>, SMX_ALBEDO_ANGLES> table{}, fit{};
    ASSERT_SMX_OK(smx_material_get_albedo(material, nullptr, table[0].data(), fit[0].data()));
    for (std::size_t t = 0; t < SMX_ALBEDO_ANGLES; ++t)
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_GT(table[t][c], 0.0);
            EXPECT_LE(fit[t][c], std::max(1.0, table[t][c]) * (1.0 + albedo_tolerance)) << "angle " << t;
        }
}

double displaced_relrmse(smx_material material, smx_brdf brdf) {
    const smx_scene scene = test::make_scene(32, 32, test::radians(0), {0.25, 0.25, 0.0, 0.0, 0.0});
    smx_render_options options = test::make_options(4096);
    options.sampler = SMX_SAMPLER_SOBOL;
    return test::relrmse(test::render_filtered(material, scene), test::render_reference(brdf, scene, options));
}

// The material of `spoilt` is that of the clean table.
void expect_same_material(const Values &clean, const Values &spoilt) {
    const test::Brdf brdf = brdf_of(clean);
    const Fitted a = fit(brdf, 4), b = fit(brdf_of(spoilt), 4);
    expect_sound(b);
    ASSERT_EQ(a.lobes.size(), b.lobes.size());
    for (std::size_t k = 0; k < a.lobes.size(); ++k)
        EXPECT_NEAR(b.lobes[k].alpha, a.lobes[k].alpha, alpha_tolerance * a.lobes[k].alpha) << "lobe " << k;
    const double right = displaced_relrmse(a.material, brdf), got = displaced_relrmse(b.material, brdf);
    EXPECT_NEAR(got, right, relrmse_tolerance);
}

// Calls spoil(channel 0..2, cell) on a share of the cells.
void spoil_some(Values &values, double share, const std::function<void(double &)> &spoil) {
    std::mt19937 random(3);
    std::bernoulli_distribution hit(share);
    for (std::size_t cell = 0; cell < cells; ++cell)
        if (hit(random))
            for (std::size_t c = 0; c < 3; ++c) spoil(values.of[c * cells + cell]);
}

} // namespace

TEST(FitDegenerate, MirrorWithAllMassInTheFirstNode) {
    Values values;
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t d = 0; d < theta_d; ++d)
            for (std::size_t p = 0; p < phi_d; ++p) values.at(c, 0, d, p) = 1e4;
    for (const smx_model model : {SMX_MODEL_SHARED, SMX_MODEL_PER_LOBE}) {
        const Fitted fitted = fit(brdf_of(values), 8, model);
        expect_sound(fitted);
        EXPECT_LT(fitted.lobes.front().alpha, 1e-3);
    }
}

TEST(FitDegenerate, OneLobeFittedWithManyIsOneLobe) {
    const test::Brdf brdf = open("analytic:beckmann,alpha=0.3,f0=0.9");
    const Fitted one = fit(brdf, 1, SMX_MODEL_SHARED);
    for (const uint32_t lobes : {8u, 16u}) {
        const Fitted many = fit(brdf, lobes, SMX_MODEL_SHARED);
        expect_sound(many);
        EXPECT_NEAR(many.report.log_likelihood, one.report.log_likelihood, likelihood_tolerance);
    }
    expect_sound(fit(brdf, 16));
}

TEST(FitDegenerate, LambertianAndConstant) {
    Values constant;
    for (double &value : constant.of) value = 0.3;
    const test::Brdf tables[] = {open("analytic:lambert,albedo=0.5"), brdf_of(constant)};
    for (const test::Brdf &brdf : tables) {
        const Fitted fitted = fit(brdf, 8);
        expect_sound(fitted);
        expect_within_albedo_bound(fitted.material);
        EXPECT_LT(fitted.report.base_relrmse, lambertian_base_limit);
        EXPECT_LT(fitted.report.displaced_relrmse, lambertian_displaced_limit);
    }
}

TEST(FitDegenerate, HeavyTail) {
    const Fitted fitted = fit(open("analytic:ggx,alpha=0.5,f0=0.9"), 8);
    expect_sound(fitted);
    expect_within_albedo_bound(fitted.material);
    EXPECT_LT(fitted.report.base_relrmse, 0.05);
}

TEST(FitDegenerate, EnergyStaysWithinABrightTable) {
    const Fitted fitted = fit(open("analytic:ggx,alpha=0.1,f0=1"), 4);
    expect_within_albedo_bound(fitted.material);
}

TEST(FitDegenerate, HolesChangeLittle) {
    const Values clean = values_of("builtin:two-layer");
    Values spoilt = clean;
    spoil_some(spoilt, 0.3, [](double &value) { value = -1.0; });
    expect_same_material(clean, spoilt);
}

TEST(FitDegenerate, OutliersChangeLittle) {
    const Values clean = values_of("builtin:two-layer");
    Values spoilt = clean;
    spoil_some(spoilt, 0.01, [](double &value) { value *= 1000.0; });
    expect_same_material(clean, spoilt);
}

TEST(FitDegenerate, BlackChannelStaysBlack) {
    Values values = values_of("builtin:two-layer");
    std::fill_n(values.of.begin() + cells, cells, 0.0);
    for (const smx_model model : {SMX_MODEL_SHARED, SMX_MODEL_PER_LOBE}) {
        const Fitted fitted = fit(brdf_of(values), 4, model);
        expect_sound(fitted);
        const test::Curves curves = test::curves_of(fitted.material);
        const std::size_t knots = curves.theta_d.size();
        for (std::size_t k = 0; k < curves.fresnel.size(); ++k)
            EXPECT_TRUE(k / knots % 3 != 1 || curves.fresnel[k] == 0.0) << curves.fresnel[k];
    }
}

namespace {

Fitted fit_scaled(const Values &values, double scale) {
    Values scaled = values;
    for (double &value : scaled.of) value *= value > 0.0 ? scale : 1.0;
    return fit(brdf_of(scaled), 4);
}

// `got` is the fit of a table `factor` times as bright.
void expect_scaled(const Fitted &got, const Fitted &right, double factor) {
    expect_sound(got);
    ASSERT_EQ(got.lobes.size(), right.lobes.size());
    for (std::size_t k = 0; k < right.lobes.size(); ++k)
        EXPECT_NEAR(got.lobes[k].alpha, right.lobes[k].alpha, scale_tolerance * right.lobes[k].alpha) << factor;
    const std::vector<double> curves = test::curves_of(right.material).fresnel;
    const std::vector<double> scaled = test::curves_of(got.material).fresnel;
    const double largest = *std::max_element(curves.begin(), curves.end());
    for (std::size_t k = 0; k < curves.size(); ++k)
        EXPECT_NEAR(scaled[k] / factor, curves[k], 10 * scale_tolerance * largest) << factor << " at " << k;
}

} // namespace

// A fit reflects at most what came, or as much as its table: 1 is no unit's choice. So tables that stay below 1 are
// fitted alike at every scale, and those that are above it at every angle are.
TEST(FitDegenerate, ScaleIsInTheCurvesAlone) {
    const Values clean = values_of("analytic:ggx,alpha=0.2,f0=0.5/0.3/0.1");
    const Fitted dim = fit_scaled(clean, 1.0), bright = fit_scaled(clean, 1e3);
    for (const double scale : {1e-12, 1e-3}) expect_scaled(fit_scaled(clean, scale), dim, scale);
    for (const double scale : {1e6, 1e12}) expect_scaled(fit_scaled(clean, scale), bright, scale / 1e3);
}

TEST(FitDegenerate, TableOfZerosIsAnError) {
    const test::Brdf brdf = brdf_of(Values());
    smx_density density = nullptr;
    EXPECT_SMX_FAILS(SMX_NO_SOLUTION, "reflects nothing", smx_density_create(brdf, nullptr, &density));
    EXPECT_EQ(density, nullptr);
}

TEST(FitDegenerate, AutomaticNumberOfLobesSaysWhy) {
    const Fitted one = fit(open("analytic:beckmann,alpha=0.3,f0=0.9"), SMX_LOBES_AUTO, SMX_MODEL_SHARED);
    EXPECT_EQ(one.lobes.size(), 1u);
    EXPECT_NE(std::string(one.report.choice).find("1 lobes"), std::string::npos) << one.report.choice;
    const Fitted two = fit(open("builtin:two-layer"), SMX_LOBES_AUTO, SMX_MODEL_SHARED);
    EXPECT_GT(two.lobes.size(), 1u);
    EXPECT_LT(two.lobes.size(), 16u);
}

TEST(FitDegenerate, DeviationsTellWhatIsAtABound) {
    const Fitted fitted = fit(open("builtin:two-layer"), 4);
    std::vector<double> alpha(fitted.lobes.size()), curves(fitted.lobes.size() * 3 * SMX_CURVE_COEFFICIENTS);
    ASSERT_SMX_OK(smx_material_get_deviations(fitted.material, alpha.data(), curves.data(), alpha.size()));
    std::size_t held = 0;
    for (const std::vector<double> &all : {alpha, curves})
        for (const double deviation : all) {
            EXPECT_TRUE(deviation == SMX_HELD || (std::isfinite(deviation) && deviation >= 0.0)) << deviation;
            held += deviation == SMX_HELD;
        }
    EXPECT_GT(held, 0u); // the body's lobes have no gloss in them
    for (std::size_t k = 0; k < alpha.size(); ++k)
        if (fitted.lobes[k].weight > 0.05) {
            EXPECT_GT(alpha[k], 0.0);
            EXPECT_LT(alpha[k], 0.2 * fitted.lobes[k].alpha);
        }
}
