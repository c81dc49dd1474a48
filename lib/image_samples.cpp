#include "image_samples.h"

#include <algorithm>
#include <cmath>

#include "rough_surface.h"

namespace smx {

namespace {

constexpr int draws = 128;             // of either kind
constexpr int most_taken_whole = 1024; // pixels of an image

// Facet slopes of the widened lobes, and the pixels where wh is the normal of such a facet. On the sphere
// (cl/sphere.clh) a slope tells the pixel: the first gives the polar angle theta, of cotangent -slope_x, and the second
// the azimuth from wh, of tangent -slope_y sin(theta).
class Highlights {
  public:
    Highlights(const Material &material, const Scene &scene);

    Point2 position(int n) const;                   // on the image plane, the disc of radius 1; of draw n
    double density(const LocalDirections &d) const; // over that plane

  private:
    struct DrawnLobe {
        double share, alpha2; // of the draws
    };
    const DrawnLobe &drawn_by(int n) const;

    RoughSurface x_;
    std::vector<DrawnLobe> lobes_;
    double wh_x_, wh_y_;
};

Highlights::Highlights(const Material &material, const Scene &scene) : x_(scene.displacement) {
    const DeviceView view = to_device<double>(scene);
    wh_x_ = view.wh_x, wh_y_ = view.wh_y;
    // A lobe narrower than a pixel is drawn as wide as one, whose centre may be that far off.
    const double pixel = pixel_slope(scene), pixel2 = pixel * pixel;
    const double angle = theta_d(scene);
    double total = 0.0;
    for (std::size_t k = 0; k < material.lobes.size(); ++k) {
        const auto [weight, alpha] = material.lobes[k];
        const bool own_curves = material.model == Model::PerLobe;
        const Rgb f = fresnel_at(material.theta_d, material.fresnel[own_curves ? k : 0], angle);
        const double alpha2 = alpha * alpha + pixel2, var = std::sqrt(x_.var_1(alpha2) * x_.var_2(alpha2));
        // The square of a density integrates to its peak, over 2.
        const double power = (own_curves ? 1.0 : weight) * (f[0] + f[1] + f[2]) / std::sqrt(var);
        lobes_.push_back({power, alpha2});
        total += power;
    }
    const double even = 1.0 / static_cast<double>(lobes_.size());
    for (DrawnLobe &lobe : lobes_) lobe.share = total > 0.0 ? 0.5 * lobe.share / total + 0.5 * even : even;
}

const Highlights::DrawnLobe &Highlights::drawn_by(int n) const {
    double up_to = 0.0;
    for (const DrawnLobe &lobe : lobes_) {
        up_to += lobe.share;
        if (n + 0.5 < up_to * draws) return lobe;
    }
    return lobes_.back();
}

Point2 Highlights::position(int n) const {
    const auto [slope_x, slope_y] = x_.slope(drawn_by(n).alpha2, even_point(n));
    const double sin_theta = 1.0 / std::hypot(1.0, slope_x), tangent = -slope_y * sin_theta;
    const double across = sin_theta / std::hypot(1.0, tangent);
    if (across * (wh_y_ - wh_x_ * tangent) <= 0.0) return {2.0, 2.0}; // turned away from the camera
    return {across * (wh_x_ + wh_y_ * tangent), -slope_x * sin_theta};
}

double Highlights::density(const LocalDirections &d) const {
    Direction3 h{};
    for (std::size_t c = 0; c < 3; ++c) h[c] = d.wi[c] + d.wo[c];
    const double slope_x = -h[0] / h[2], slope_y = -h[1] / h[2];
    double sum = 0.0;
    for (const auto &[share, alpha2] : lobes_) sum += share * x_.p22(alpha2, slope_x, slope_y);
    // The slopes' determinant by the position, 1 / (sin(theta)^2 cos_h^2 cos_o).
    const double cos2_h = h[2] * h[2] / (h[0] * h[0] + h[1] * h[1] + h[2] * h[2]);
    const double sin2_theta = 1.0 / (1.0 + slope_x * slope_x);
    return sum / (sin2_theta * cos2_h * d.wo[2]);
}

class Draw {
  public:
    Draw(const Material &material, const Scene &scene)
        : scene_(scene), side_(std::min(scene.width, scene.height)), highlights_(material, scene) {}

    // At a point of the plane in which the sphere is the disc of radius 1.
    void add(Point2 p) {
        if (!(std::abs(p.x) < 1.0 && std::abs(p.y) < 1.0)) return;
        const auto column = static_cast<std::uint32_t>((scene_.width + p.x * side_) / 2);
        const auto row = static_cast<std::uint32_t>((scene_.height - p.y * side_) / 2);
        if (const auto d = lit_pixel(scene_, column, row)) samples.push_back({*d, 1.0 / drawn_of_pixel(*d)});
    }
    void add_even(int n) {
        const auto [x, y] = even_point(n);
        add({2 * x - 1, 2 * y - 1});
    }
    void add_highlight(int n) { add(highlights_.position(n)); }

    std::vector<ImageSample> samples;

  private:
    double drawn_of_pixel(const LocalDirections &d) const {
        return draws * (1.0 + 4.0 * highlights_.density(d)) / (side_ * side_);
    }

    const Scene &scene_;
    double side_;
    Highlights highlights_;
};

std::vector<ImageSample> all_pixels(const Scene &scene) {
    std::vector<ImageSample> samples;
    for (std::uint32_t row = 0; row < scene.height; ++row)
        for (std::uint32_t column = 0; column < scene.width; ++column)
            if (const auto d = lit_pixel(scene, column, row)) samples.push_back({*d, 1.0});
    return samples;
}

} // namespace

double pixel_slope(const Scene &scene) {
    const DeviceView view = to_device<double>(scene);
    return 2.0 * view.inv_side / view.wh_y;
}

std::vector<ImageSample> image_samples(const Material &material, const Scene &scene) {
    if (std::uint64_t{scene.width} * scene.height <= most_taken_whole) return all_pixels(scene);
    Draw draw(material, scene);
    for (int n = 0; n < draws; ++n) {
        draw.add_even(n);
        draw.add_highlight(n);
    }
    return std::move(draw.samples);
}

} // namespace smx
