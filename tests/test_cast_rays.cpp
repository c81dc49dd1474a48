// The ray caster against a plain one in double on the same tile, and the tile's statistics as its facets have them.
#include <gtest/gtest.h>

#include <algorithm>

#include "cast_rays.h"
#include "oracle_rays.h"
#include "random.h"
#include "support.h"

namespace {

constexpr std::uint32_t log2_side = 10;

// The library's own context: the tests of the C API have no way to single rays.
smx::Context &context() {
    static smx::Context c("", 0);
    return c;
}

const smx::HeightField &field() {
    static const smx::HeightField f = smx::make_height_fields(log2_side, 5)[0];
    return f;
}

smx::RayPair random_ray(test::Random &random) {
    const oracle::Vec wo = random.direction(0.05), wi = random.direction(0.05);
    const auto bits = [&] { return static_cast<std::uint32_t>(random.uniform() * 0x1p32); };
    const auto f = [](double v) { return static_cast<float>(v); };
    return {{bits(), bits()}, {f(wo.x), f(wo.y), f(wo.z)}, {f(wi.x), f(wi.y), f(wi.z)}};
}

oracle::Vec tile_direction(const smx::TileFrame &a, const std::array<float, 3> &w) {
    const double x = w[0], y = w[1], z = w[2];
    return {a.a_xx * x + a.a_xy * y, a.a_yx * x + a.a_yy * y, z - x * a.mean_x - y * a.mean_y};
}

// Rays of which triangle, place, normal or shadow differ.
struct Differences {
    std::size_t triangle = 0, place = 0, lit = 0, missed = 0;
};

// Cells. A ray that comes in flat turns its own rounding, 1e-6 of its way, into a hundred times as much.
constexpr double place_tolerance = 1e-3;

Differences compare(const smx::Displacement &x, std::size_t count, std::uint64_t seed) {
    test::Random random(seed);
    std::vector<smx::RayPair> rays;
    for (std::size_t k = 0; k < count; ++k) rays.push_back(random_ray(random));
    const std::vector<smx::CastRay> cast = smx::cast_rays(context(), field(), x, rays);
    const smx::TileFrame a = smx::tile_frame(field(), x);
    const oracle::TileRays plain(field());
    Differences d;
    for (std::size_t k = 0; k < count; ++k) {
        const double side = field().side();
        // The device's origin is cut to 24 bits within its cell.
        const std::uint32_t kept = ~((1u << (8 - std::min(8u, log2_side))) - 1u);
        const oracle::Vec start{(rays[k].origin[0] & kept) * 0x1p-32 * side,
                                (rays[k].origin[1] & kept) * 0x1p-32 * side, field().top};
        const oracle::Vec o = tile_direction(a, rays[k].wo), i = tile_direction(a, rays[k].wi);
        const auto hit = plain.cast(start, {-o.x, -o.y, -o.z});
        const smx::CastRay &r = cast[k];
        if (!hit || r.upper == -1) {
            d.missed += hit.has_value() != (r.upper != -1);
            continue;
        }
        const double away = std::max({std::abs(r.cell_x + double{r.x} - hit->p.x),
                                      std::abs(r.cell_y + double{r.y} - hit->p.y), std::abs(r.z - hit->p.z)});
        d.place += !(away < place_tolerance);
        if (r.cell_x != hit->cell_x || r.cell_y != hit->cell_y || r.upper != hit->upper) {
            ++d.triangle;
            continue;
        }
        const double slope_x = a.a_xx * hit->gradient_x + a.a_yx * hit->gradient_y + a.mean_x,
                     slope_y = a.a_xy * hit->gradient_x + a.a_yy * hit->gradient_y + a.mean_y;
        d.triangle +=
            !(std::hypot(r.slope_x - slope_x, r.slope_y - slope_y) < 1e-5 * (1.0 + std::hypot(slope_x, slope_y)));
        const std::array<float, 3> &w = rays[k].wi;
        const bool lit = w[2] - w[0] * slope_x - w[1] * slope_y > 0.0 && !plain.cast(hit->p, i, &*hit);
        d.lit += lit != (r.lit != 0);
    }
    return d;
}

// Share of the rays that are given up (MOST_STEPS), where a ray goes `flatness` as far across the tile as it falls; all
// along one axis, where the tile comes back after its side, or in all directions.
double share_given_up(double flatness, bool is_along_axis) {
    constexpr std::size_t count = 2000;
    test::Random random(3);
    std::vector<smx::RayPair> rays(count);
    for (smx::RayPair &r : rays) {
        r = random_ray(random);
        const double phi = is_along_axis ? 0.0 : random.uniform(0.0, 2 * oracle::pi);
        r.wo = {static_cast<float>(std::cos(phi)), static_cast<float>(std::sin(phi)),
                static_cast<float>(1.0 / flatness)};
    }
    const std::vector<smx::CastRay> cast = smx::cast_rays(context(), field(), {1.0, 1.0, 0.0, 0.0, 0.0}, rays);
    const auto given_up = std::count_if(cast.begin(), cast.end(), [](const smx::CastRay &r) { return r.upper == -1; });
    return static_cast<double>(given_up) / count;
}

} // namespace

// What comes from above meets the surface at last. Ever flatter rays are given up, few of them.
TEST(CastRays, FlatRaysMeetTheSurface) {
    for (const bool is_along_axis : {false, true}) {
        for (const double flatness : {1e3, 1e4, 1e5})
            EXPECT_EQ(share_given_up(flatness, is_along_axis), 0.0) << flatness << ", along an axis: " << is_along_axis;
        EXPECT_LT(share_given_up(1e7, is_along_axis), 0.01) << "along an axis: " << is_along_axis;
    }
    EXPECT_GT(share_given_up(1e7, false), 0.0); // so that the limit is seen at all
}

TEST(CastRays, AgreeWithAPlainCasterInDouble) {
    constexpr std::size_t count = 250000;
    Differences all;
    for (const smx::Displacement &x : {smx::Displacement{0.25, 0.25, 0.0, 0.0, 0.0},
                                       {1.0, 1.0, 0.0, 0.0, 0.0},
                                       {0.5, 0.1, 0.6, 0.2, -0.1},
                                       {0.0, 0.5, 0.0, 0.0, 0.0}}) {
        const Differences d = compare(x, count, 11);
        all.triangle += d.triangle, all.place += d.place, all.lit += d.lit, all.missed += d.missed;
    }
    EXPECT_LE(all.triangle + all.place + all.lit + all.missed, 10u);
}
