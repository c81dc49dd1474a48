// The picture of the displaced sphere: its shape shows, and follows the roughness and its direction.
#include <gtest/gtest.h>

#include "support.h"

namespace {

constexpr uint32_t size = 96;

test::Image draw(const smx_displacement &x, uint64_t seed = 0) {
    const smx_scene scene = test::make_scene(size, size, test::radians(60.0), x);
    const smx_render_options options = test::make_options(1, seed);
    test::Image image;
    EXPECT_SMX_OK(smx_render_geometry(test::context(), &scene, &options, image.out(), nullptr));
    return image;
}

// Mean squared difference of neighbours in the middle of the picture: along a row and along a column.
struct Relief {
    double across = 0.0, down = 0.0;
};

Relief relief(smx_image image) {
    const test::Pixels p = test::pixels(image);
    Relief r;
    for (uint32_t row = size / 3; row < 2 * size / 3; ++row)
        for (uint32_t column = size / 3; column < 2 * size / 3; ++column) {
            const double here = p.at(column, row)[1];
            r.across += std::pow(p.at(column + 1, row)[1] - here, 2.0);
            r.down += std::pow(p.at(column, row + 1)[1] - here, 2.0);
        }
    return r;
}

} // namespace

TEST(Geometry, ReliefGrowsWithRoughness) {
    const Relief flat = relief(draw({0.0, 0.0, 0.0, 0.0, 0.0})), gentle = relief(draw({0.1, 0.1, 0.0, 0.0, 0.0})),
                 rough = relief(draw({0.5, 0.5, 0.0, 0.0, 0.0}));
    EXPECT_GT(gentle.across + gentle.down, 2.0 * (flat.across + flat.down));
    EXPECT_GT(rough.across + rough.down, 2.0 * (gentle.across + gentle.down));
}

// Slopes along e_theta only (x) vary down the picture's middle; slopes along e_phi vary across it.
TEST(Geometry, ReliefFollowsTheAxis) {
    const Relief latitudinal = relief(draw({0.5, 0.0, 0.0, 0.0, 0.0})),
                 longitudinal = relief(draw({0.0, 0.5, 0.0, 0.0, 0.0}));
    EXPECT_GT(latitudinal.down, 2.0 * latitudinal.across);
    EXPECT_GT(longitudinal.across, 2.0 * longitudinal.down);
}
