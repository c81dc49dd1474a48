// What a filtered image would be without some effects or lobes, from a few of its pixels, on the host in double and in
// closed form: the formulas of cl/mixture.clh, where the error of leaving something out is asked for, and not the
// image.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "effects.h"
#include "image_samples.h"

namespace smx {

// What is simulated: effects, and of the material's lobes those that are kept.
struct Simulated {
    Effects on;
    std::vector<bool> lobes;
};

class EffectTrial {
  public:
    // `all` is what an image is compared with; a scene of any masking.
    EffectTrial(const Material &material, const Scene &scene, const Simulated &all);

    bool is_black() const { return !(value2_ > 0.0); } // nothing is lit, or nothing reflects
    const Simulated &all() const { return all_; }

    // Root mean square of what `simulated` differs by, over that of the image. The image must not be black.
    double error(const Simulated &simulated) const;

    // What a lobe adds, by the same measure: the error of leaving it out, but for its part in the shared masking.
    // Infinity for a lobe that is too narrow for the pixels, of which a few may happen to have all of it.
    std::vector<double> lobe_shares() const;

    // The largest Lambda = sigma / p - 1 of the mixture towards wi and wo, over the pixels.
    double largest_lambda_i() const { return largest_lambda(true); }
    double largest_lambda_o() const { return largest_lambda(false); }

    // What single scattering loses (rough_surface.h), over the pixels.
    double lost_energy() const;

  private:
    // By pixel and lobe, on one displaced surface.
    struct Parts {
        std::vector<double> p_i, p_o;                // by pixel; 0 where not visible
        std::vector<double> ndf, beyond_i, beyond_o; // [pixel][lobe]; of a lobe of weight 1
    };
    Parts parts_on(const Displacement &x) const;
    const Parts &parts(Effects on) const;
    std::vector<Rgb> fresnel(Effects on) const; // of the image's theta_d: of the lobes, or one for all
    bool is_per_lobe(Effects on) const { return material_.model == Model::PerLobe && (on & lobe_color_effect) != 0; }
    std::vector<double> values(const Simulated &simulated) const; // [pixel][channel]
    double mean_square(const std::vector<double> &values) const;
    double largest_lambda(bool towards_light) const;

    const Material &material_;
    const Scene &scene_;
    Simulated all_;
    std::vector<ImageSample> samples_;
    mutable std::array<Parts, 4> parts_; // with and without anisotropy, mean slope; made when asked for
    std::vector<double> value_;
    double value2_ = 0.0;
};

} // namespace smx
