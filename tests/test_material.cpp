// Materials made from arrays: what goes in comes out, in order and normalised.
#include <gtest/gtest.h>

#include <cstring>

#include "close.h"
#include "support.h"

namespace {

const std::vector<double> curves{0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9};
const std::vector<oracle::Lobe> three{{3.0, 0.5}, {1.0, 0.01}, {4.0, 2.0}};

test::Material three_lobes() { return test::make_material(SMX_MODEL_SHARED, three, curves, 3); }

// Every lobe's curves are ten times its place in the arrays, plus the channel, in hundredths.
test::Material per_lobe() {
    std::vector<double> sets;
    for (int lobe = 0; lobe < 3; ++lobe)
        for (int channel = 0; channel < 3; ++channel) sets.insert(sets.end(), 2, 0.1 * (lobe + 1) + 0.01 * channel);
    return test::make_material(SMX_MODEL_PER_LOBE, three, sets, 2);
}

} // namespace

TEST(Material, LobesAreSortedAndNormalised) {
    const std::vector<smx_lobe> lobes = test::lobes_of(three_lobes());
    ASSERT_EQ(lobes.size(), 3u);
    const double alpha[] = {0.01, 0.5, 2.0}, weight[] = {0.125, 0.375, 0.5};
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(lobes[k].alpha, alpha[k]);
        EXPECT_CLOSE(lobes[k].weight, weight[k], 1e-15, 0.0);
    }
}

TEST(Material, FresnelIsKept) {
    const test::Curves c = test::curves_of(three_lobes());
    EXPECT_EQ(c.fresnel, curves);
    ASSERT_EQ(c.theta_d.size(), 3u);
    for (std::size_t k = 0; k < 3; ++k)
        EXPECT_CLOSE(c.theta_d[k], static_cast<double>(k) * oracle::pi / 4.0, 1e-15, 0.0);
}

// The lobes are sorted by alpha, and their curves go with them.
TEST(Material, CurvesFollowTheirLobes) {
    const test::Material m = per_lobe();
    const smx_material_info info = test::info_of(m);
    EXPECT_EQ(info.model, SMX_MODEL_PER_LOBE);
    EXPECT_EQ(info.fresnel_sets, 3u);
    const std::vector<double> fresnel = test::curves_of(m).fresnel;
    ASSERT_EQ(fresnel.size(), 18u);
    const int place[] = {2, 1, 3}; // of alphas 0.01, 0.5, 2 in the arrays
    for (std::size_t lobe = 0; lobe < 3; ++lobe)
        for (std::size_t channel = 0; channel < 3; ++channel)
            EXPECT_CLOSE(fresnel[6 * lobe + 2 * channel], 0.1 * place[lobe] + 0.01 * static_cast<double>(channel),
                         1e-15, 0.0);
    double sum = 0.0;
    for (const smx_lobe &l : test::lobes_of(m)) sum += l.weight;
    EXPECT_CLOSE(sum, 1.0, 1e-12, 0.0);
}

TEST(Material, UnevenKnotsAreKept) {
    const smx_lobe lobe{1.0, 0.1};
    const double theta_d[3] = {0.0, 0.2, oracle::pi / 2.0};
    smx_material_desc desc = SMX_MATERIAL_DESC_INIT;
    desc.lobes = &lobe;
    desc.lobe_count = 1;
    desc.theta_d = theta_d;
    desc.knots = 3;
    desc.fresnel = curves.data();
    test::Material m;
    ASSERT_SMX_OK(smx_material_create(&desc, m.out()));
    const test::Curves c = test::curves_of(m);
    EXPECT_EQ(c.theta_d, (std::vector<double>{0.0, 0.2, oracle::pi / 2.0}));
    EXPECT_EQ(c.fresnel, curves);
}

TEST(Material, InfoSaysWhatItIs) {
    const smx_material_info info = test::info_of(three_lobes());
    EXPECT_STREQ(info.name, "test");
    EXPECT_STREQ(info.sha256, "");
    EXPECT_EQ(info.model, SMX_MODEL_SHARED);
    EXPECT_EQ(info.lobes, 3u);
    EXPECT_EQ(info.fresnel_knots, 3u);
    EXPECT_EQ(info.fresnel_sets, 1u);
}

TEST(Material, ArraysHaveAReportOfZeros) {
    smx_fit_report report = SMX_FIT_REPORT_INIT;
    report.seconds = -1.0;
    ASSERT_SMX_OK(smx_material_get_report(three_lobes(), &report));
    EXPECT_EQ(report.em_iterations, 0u);
    EXPECT_EQ(report.seconds, 0.0);
    EXPECT_EQ(report.residual, 0.0);
    EXPECT_STREQ(report.refine_message, "");
}

TEST(Material, RangeOfAlphaIsClosed) {
    for (const double alpha : {1e-4, 1e4})
        EXPECT_EQ(test::lobes_of(test::make_material({{1.0, alpha}}))[0].alpha, alpha);
}

TEST(Material, FitKeepsTheSource) {
    const test::Brdf brdf = test::make_brdf(test::beckmann_table({{1.0, 0.2}}, oracle::Masking::coinciding), "lacquer");
    smx_brdf_info table = SMX_BRDF_INFO_INIT;
    ASSERT_SMX_OK(smx_brdf_get_info(brdf, &table));
    for (const smx_model model : {SMX_MODEL_SHARED, SMX_MODEL_PER_LOBE}) {
        const smx_material_info info =
            test::info_of(test::fit(test::make_density(brdf, SMX_MASKING_COINCIDES), 2, model));
        EXPECT_EQ(info.model, model);
        EXPECT_STREQ(info.name, "lacquer");
        EXPECT_STREQ(info.source, table.source);
        EXPECT_STREQ(info.sha256, table.sha256);
        EXPECT_EQ(std::strlen(info.sha256), 64u);
    }
}
