#include "oracle_widening.h"

#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/tools/minima.hpp>
#include <limits>

namespace oracle {
namespace {

// Relative, of an integral over all facets, and of one along a line of them.
constexpr double outer_tolerance = 1e-6, inner_tolerance = 1e-8;
constexpr unsigned bisections = 12;
// In exponents: what lies so far below the peak is left out. Jacobians grow by no more than e^20 over it.
constexpr double reach = 50.0;

Vec about(const Vec &wm, const Vec &k) { return {length(cross(wm, k)), 0.0, dot(wm, k)}; }

// One lobe, masked by all of `masks`.
FacetBrdf lobe_brdf(const Lobe &lobe, const std::vector<Lobe> &masks, Masking masking) {
    const Mixture base{masks, {}};
    return [=](const Vec &wi, const Vec &wo, const Vec &wm) -> Rgb {
        const Vec i = about(wm, wi), o = about(wm, wo), h = about(wm, half_vector(wi, wo));
        const double f =
            lobe.weight * ndf(gaussian(lobe.alpha, lobe.alpha), h) * g2(masking, base, i, o) / (4.0 * i.z * o.z);
        return {f, f, f};
    };
}

std::vector<Lobe> masks_of(Base base, const std::vector<Lobe> &lobes, const Lobe &lobe) {
    return base == Base::shared ? lobes : std::vector<Lobe>{{1.0, lobe.alpha}};
}

struct Range {
    double low, high;

    // Keeps where at + slope x > 0.
    void cut(double at, double slope) {
        if (slope > 0.0)
            low = std::max(low, -at / slope);
        else if (slope < 0.0)
            high = std::min(high, -at / slope);
        else if (at <= 0.0)
            high = low;
    }
};

// Integral of g over the range, in y with x = peak + width sinh(y): as fine at the peak as its width asks for, and
// coarser away from it. Where the peak is outside, its nearest end stands for it.
template <class G>
Estimate peaked_integral(const G &g, Range range, double peak, double width, double tolerance) {
    using Rule = boost::math::quadrature::gauss_kronrod<double, 31>;
    Estimate sum;
    if (!(range.low < range.high)) return sum;
    peak = std::clamp(peak, range.low, range.high);
    const double ends[3] = {std::asinh((range.low - peak) / width), 0.0, std::asinh((range.high - peak) / width)};
    for (int side = 0; side < 2; ++side) {
        if (!(ends[side] < ends[side + 1])) continue;
        double error = 0.0;
        sum.value += Rule::integrate([&](double y) { return g(peak + width * std::sinh(y)) * width * std::cosh(y); },
                                     ends[side], ends[side + 1], bisections, tolerance, &error);
        sum.error += error;
    }
    return sum;
}

template <class G>
double lowest(const G &g, double from, double to) {
    return boost::math::tools::brent_find_minima(g, std::min(from, to), std::max(from, to), 30).first;
}

// The integral of one lobe over the facets of X: slopes are mean + L f with L the Cholesky factor of twice the
// covariance, so that their density is exp(-|f|^2) whatever X is.
class FacetIntegral {
  public:
    FacetIntegral(FacetBrdf f, double alpha, const Gaussian &x, const Vec &wi, const Vec &wo)
        : f_(std::move(f)),
          alpha_(alpha),
          wi_(wi),
          wo_(wo),
          wh_(half_vector(wi, wo)),
          mean_{-x.mean_x, -x.mean_y, 1.0} {
        const double l11 = std::sqrt(2.0 * x.cov_xx), l21 = l11 > 0.0 ? 2.0 * x.cov_xy / l11 : 0.0;
        const double l22 = std::sqrt(std::max(2.0 * x.cov_yy - l21 * l21, 0.0));
        along_1_ = {-l11, -l21, 0.0};
        along_2_ = {0.0, -l22, 0.0};
        if (l11 == 0.0) std::swap(along_1_, along_2_);
        rank_ = (length(along_1_) > 0.0) + (length(along_2_) > 0.0);
    }

    Estimate operator()() {
        if (rank_ == 0) return {value(0.0, 0.0), 0.0};
        // The peak of the two Gaussians is no farther from X's mean than the half vector is.
        const double most = distance_of_h();
        const double peak = lowest([this](double f1) { return exponent(f1, lowest_on_line(f1)); }, -most, most);
        lowest_exponent_ = exponent(peak, lowest_on_line(peak));
        const double far = std::sqrt(lowest_exponent_ + reach);
        double line_error = 0.0, highest_line = 0.0;
        const auto line = [&](double f1) {
            const Estimate e = rank_ == 1 ? Estimate{value(f1, 0.0), 0.0} : over_line(f1, far);
            line_error = std::max(line_error, e.error), highest_line = std::max(highest_line, e.value);
            return e.value;
        };
        Range range{-far, far};
        if (rank_ == 1) cut_to_seen(range, mean_, along_1_);
        Estimate sum = peaked_integral(line, range, peak, width(along_1_), outer_tolerance);
        if (highest_line > 0.0) sum.error += sum.value * line_error / highest_line;
        return sum;
    }

  private:
    Vec facet(double f1, double f2) const { return mean_ + f1 * along_1_ + f2 * along_2_; }

    double exponent(double f1, double f2) const {
        const Vec v = facet(f1, f2);
        const double cosine = dot(v, wh_);
        if (cosine <= 0.0) return 1e30 * (1.0 - cosine / length(v));
        const double tangent = length(cross(v, wh_)) / cosine / alpha_;
        return tangent * tangent + f1 * f1 + f2 * f2;
    }

    double value(double f1, double f2) const {
        const Vec v = facet(f1, f2);
        const double density = std::exp(-f1 * f1 - f2 * f2) / (rank_ == 0 ? 1.0 : rank_ == 1 ? std::sqrt(pi) : pi);
        return density * facet_integrand(f_, wi_, wo_, -v.x, -v.y)[0];
    }

    void cut_to_seen(Range &range, const Vec &from, const Vec &along) const {
        for (const Vec &k : {wi_, wo_}) range.cut(dot(k, from), dot(k, along));
    }

    // Where the line from + s along comes closest to the half vector, in angle.
    double towards_h(const Vec &from, const Vec &along) const {
        const double ff = dot(from, from), fa = dot(from, along), aa = dot(along, along);
        const double fh = dot(from, wh_), ah = dot(along, wh_);
        const double of_from = fh * aa - ah * fa, of_along = ah * ff - fh * fa;
        const double most = 1e6;
        return of_from > std::abs(of_along) / most ? of_along / of_from : std::copysign(most, of_along);
    }

    double distance_of_h() const {
        if (rank_ == 1) return std::abs(towards_h(mean_, along_1_)) + 1e-3;
        const Vec off = (1.0 / wh_.z) * wh_ - mean_;
        const double f1 = off.x / along_1_.x, f2 = (off.y - f1 * along_1_.y) / along_2_.y;
        return std::hypot(f1, f2) + 1e-3;
    }

    // Along a line it lies between the two Gaussians' own.
    double lowest_on_line(double f1) const {
        if (rank_ == 1) return 0.0;
        return lowest([&](double f2) { return exponent(f1, f2); }, 0.0, towards_h(facet(f1, 0.0), along_2_));
    }

    // Of the product of the Gaussians along an axis of f, at least: an angle changes slopes by no less than itself.
    double width(const Vec &along) const { return std::min(1.0, alpha_ / length(along)); }

    Estimate over_line(double f1, double far) const {
        const double peak = lowest_on_line(f1);
        if (exponent(f1, peak) > lowest_exponent_ + reach) return {};
        const double most = std::sqrt(std::max(far * far - f1 * f1, 0.0));
        Range range{-most, most};
        cut_to_seen(range, facet(f1, 0.0), along_2_);
        return peaked_integral([&](double f2) { return value(f1, f2); }, range, peak, width(along_2_), inner_tolerance);
    }

    FacetBrdf f_;
    double alpha_;
    Vec wi_, wo_, wh_, mean_, along_1_, along_2_;
    int rank_;
    double lowest_exponent_ = 0.0;
};

} // namespace

FacetBrdf lobes_brdf(Base base, const std::vector<Lobe> &lobes, Masking masking) {
    std::vector<FacetBrdf> parts;
    for (const Lobe &lobe : lobes) parts.push_back(lobe_brdf(lobe, masks_of(base, lobes, lobe), masking));
    return [parts](const Vec &wi, const Vec &wo, const Vec &wm) {
        Rgb sum{};
        for (const FacetBrdf &part : parts) {
            const Rgb f = part(wi, wo, wm);
            for (std::size_t c = 0; c < 3; ++c) sum[c] += f[c];
        }
        return sum;
    };
}

Estimate widened_fcos(Base base, const std::vector<Lobe> &lobes, Masking masking, const Gaussian &x, const Vec &wi,
                      const Vec &wo) {
    if (wi.z <= 0.0 || wo.z <= 0.0 || plane(x, wi) <= 0.0 || plane(x, wo) <= 0.0) return {};
    const double factor = g2(masking, x, wi, wo) / plane(x, wo);
    Estimate sum;
    for (const Lobe &lobe : lobes) {
        const Estimate part =
            FacetIntegral(lobe_brdf(lobe, masks_of(base, lobes, lobe), masking), lobe.alpha, x, wi, wo)();
        sum.value += factor * part.value;
        sum.error += factor * part.error;
    }
    return sum;
}

} // namespace oracle
