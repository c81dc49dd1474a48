// Invalid cells are filled from valid neighbours, so that no -1 is ever mixed in.
#include <gtest/gtest.h>

#include <algorithm>

#include "close.h"
#include "random.h"
#include "support.h"

using oracle::Masking;
using oracle::Table;

namespace {

// A lobe of 0.3 changes by up to 10 % between neighbouring cells away from its tail; most holes have a closer
// neighbour.
constexpr double typical_tolerance = 0.03;
constexpr double worst_tolerance = 0.5;

smx_brdf_info info_of(smx_brdf brdf) {
    smx_brdf_info info = SMX_BRDF_INFO_INIT;
    EXPECT_SMX_OK(smx_brdf_get_info(brdf, &info));
    return info;
}

// Marks 30 % of the cells above the horizon invalid; returns their indices within a channel.
std::vector<std::size_t> punch(Table &table) {
    test::Random random(23);
    std::vector<std::size_t> holes;
    for (std::size_t k = 0; k < table.cells(); ++k) {
        if (table.values[k] < 0.0 || random.uniform() >= 0.3) continue;
        holes.push_back(k);
        for (std::size_t c = 0; c < 3; ++c) table.values[c * table.cells() + k] = -1.0;
    }
    return holes;
}

uint64_t count_negative(const Table &table) {
    return static_cast<uint64_t>(
        std::count_if(table.values.begin(), table.values.end(), [](double v) { return !(v >= 0.0); }));
}

// Cells with a direction exactly at the horizon, which rounding puts on either side.
uint64_t cells_on_the_horizon() {
    uint64_t count = 0;
    for (int th = 0; th < 90; ++th)
        for (int td = 0; td < 90; ++td)
            for (int pd = 0; pd < 180; ++pd) {
                const oracle::Pair p = oracle::node_directions(th, td, pd);
                count += std::min(std::abs(p.wi.z), std::abs(p.wo.z)) < 1e-12;
            }
    return count;
}

} // namespace

TEST(Holes, AreFilledNearTheCleanValues) {
    const Table clean = test::beckmann_table({{1.0, 0.3}}, Masking::correlated);
    Table holed = clean;
    const std::vector<std::size_t> holes = punch(holed);
    ASSERT_GT(holes.size(), 100000u);
    const test::Brdf brdf = test::make_brdf(holed);
    EXPECT_NEAR(static_cast<double>(info_of(brdf).filled_cells), static_cast<double>(holes.size()),
                static_cast<double>(cells_on_the_horizon()));
    const Table filled = test::filled_table(brdf);
    EXPECT_EQ(count_negative(filled), 0u);
    std::vector<double> errors;
    for (const std::size_t k : holes)
        if (clean.values[k] > 1e-6) errors.push_back(std::abs(filled.values[k] / clean.values[k] - 1.0));
    std::sort(errors.begin(), errors.end());
    EXPECT_LT(errors[errors.size() / 2], typical_tolerance);
    EXPECT_LT(errors[errors.size() * 99 / 100], worst_tolerance);
    // Zeros in the holes' place would be seen.
    EXPECT_GT(std::abs(0.0 / clean.values[holes[0]] - 1.0), worst_tolerance);
}

TEST(Holes, ValidCellsAreUntouched) {
    Table holed = test::beckmann_table({{1.0, 0.3}}, Masking::correlated);
    punch(holed);
    const Table filled = test::filled_table(test::make_brdf(holed));
    for (std::size_t k = 0; k < holed.values.size(); ++k) {
        if (holed.values[k] < 0.0) continue;
        ASSERT_EQ(filled.values[k], holed.values[k]) << "value " << k;
    }
}

// The horizon's own cells have no measurement at all; every one of them gets a value.
TEST(Holes, BelowTheHorizonIsFilled) {
    const Table clean = test::beckmann_table({{1.0, 0.5}}, Masking::correlated);
    ASSERT_GT(count_negative(clean), 0u);
    EXPECT_EQ(count_negative(test::filled_table(test::make_brdf(clean))), 0u);
}

TEST(Holes, OneValidCellFillsAll) {
    Table table;
    table.values.assign(3 * table.cells(), -1.0);
    for (std::size_t c = 0; c < 3; ++c)
        table.values[c * table.cells() + table.index(30, 30, 30)] = static_cast<double>(c + 1);
    const Table filled = test::filled_table(test::make_brdf(table));
    for (std::size_t k = 0; k < filled.values.size(); ++k)
        ASSERT_EQ(filled.values[k], static_cast<double>(k / table.cells() + 1)) << "value " << k;
}

TEST(Holes, FitIsThatOfTheCleanTable) {
    Table table = test::beckmann_table({{1.0, 0.3}}, Masking::correlated);
    punch(table);
    const test::Density density = test::make_density(test::make_brdf(table), SMX_MASKING_CORRELATED);
    smx_density_info info = SMX_DENSITY_INFO_INIT;
    ASSERT_SMX_OK(smx_density_get_info(density, &info));
    EXPECT_CLOSE(info.alpha, 0.3, typical_tolerance, 0.0);
}
