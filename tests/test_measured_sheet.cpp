// The experiment's figures on gold paint: mean relRMSE over the 27 configurations about 0.6 with one lobe, about 0.1
// with eight (shared model, references of 128 x 128 samples).
#include <gtest/gtest.h>

#include "measured.h"
#include "shared_data.h"

TEST(MeasuredSheet, GoldPaint) {
    const std::string table = test::measured_table("gold-paint");
    SKIP_WITHOUT(table);
    test::Brdf brdf;
    ASSERT_SMX_OK(smx_brdf_open(table.c_str(), brdf.out()));
    test::Experiment sheet;
    sheet.size = 64;
    sheet.spp = 128 * 128;
    for (const double r : {0.1, 0.25, 0.5})
        for (const smx_displacement &x :
             {smx_displacement{r, r, 0.0, 0.0, 0.0}, {r, 0.0, 0.0, 0.0, 0.0}, {0.0, r, 0.0, 0.0, 0.0}})
            sheet.displacements.push_back(x);
    const std::vector<double> errors = test::mean_errors(brdf, sheet, {1, 8}, SMX_MODEL_SHARED);
    EXPECT_NEAR(errors[0], 0.6, 0.15);
    EXPECT_NEAR(errors[1], 0.1, 0.05);
    RecordProperty("one_lobe", std::to_string(errors[0]));
    RecordProperty("eight_lobes", std::to_string(errors[1]));
}
