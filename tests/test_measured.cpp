// A measured material, small: eight lobes explain gold paint far better than one, and its images are sound.
#include <gtest/gtest.h>

#include "measured.h"
#include "shared_data.h"

TEST(Measured, EightLobesBeatOne) {
    const std::string table = test::measured_table("gold-paint");
    SKIP_WITHOUT(table);
    test::Brdf brdf;
    ASSERT_SMX_OK(smx_brdf_open(table.c_str(), brdf.out()));
    test::Experiment small;
    small.displacements = {{0.1, 0.1, 0.0, 0.0, 0.0}, {0.25, 0.0, 0.0, 0.0, 0.0}, {0.0, 0.5, 0.0, 0.0, 0.0}};
    const std::vector<double> errors = test::mean_errors(brdf, small, {1, 8}, SMX_MODEL_SHARED);
    EXPECT_LT(errors[1], 0.5 * errors[0]);
    EXPECT_LT(errors[1], 0.25); // the whole sheet's mean is about 0.1, one lobe's about 0.6
}

TEST(Measured, HolesOfMeasurementsAreBelowTheHorizon) {
    const std::string table = test::measured_table("gold-paint");
    SKIP_WITHOUT(table);
    test::Brdf brdf;
    ASSERT_SMX_OK(smx_brdf_open(table.c_str(), brdf.out()));
    smx_brdf_info info = SMX_BRDF_INFO_INIT;
    ASSERT_SMX_OK(smx_brdf_get_info(brdf, &info));
    EXPECT_STREQ(info.name, "gold-paint");
    EXPECT_GT(info.invalid_cells, 0u);
    EXPECT_EQ(info.filled_cells, 0u);
    for (const double v : test::filled_table(brdf).values) ASSERT_TRUE(v >= 0.0 && std::isfinite(v)) << v;
}
