// Which effects a filtered image calls for: before it is rendered, each is judged by what the image would be without
// it.
#pragma once

#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "effect_trial.h"
#include "render.h"

namespace smx {

struct Verdict {
    Effect effect;
    bool supported, on;
    double contribution; // relRMSE of the image without it; negative where nobody can tell
    std::string reason;
};

struct EffectChoice {
    Simulated simulated;
    std::vector<Verdict> verdicts; // as in named_effects
    double left_out = 0.0;         // relRMSE of the image without all that is left out, as estimated
    double seconds = 0.0;          // of the judgement
    std::size_t dropped() const;   // lobes
};

// All that options.effects names, or with auto_effects all that the image cannot do without: the rest is together below
// options.effect_tolerance of its root mean square. Throws InvalidArgument.
EffectChoice choose_effects(const Material &material, const Scene &scene, const RenderOptions &options);

// The choices of one material, kept: those of its last few scenes. One that was kept took no time.
class EffectChoices {
  public:
    explicit EffectChoices(std::shared_ptr<const Material> material) : material_(std::move(material)) {}

    EffectChoice judged(const Scene &scene, const RenderOptions &options);

    // What is to be simulated, and the time that it took to tell: none, and no judgement, of a set that is named.
    std::pair<Simulated, double> simulated(const Scene &scene, const RenderOptions &options);

  private:
    struct Kept {
        Scene scene;
        Effects effects;
        double tolerance;
        int order;
        EffectChoice choice;
    };

    std::shared_ptr<const Material> material_;
    std::mutex mutex_;
    std::list<Kept> kept_; // the latest first
};

// Every lobe, and the effects that are named; of auto, all.
Simulated everything(const Material &material, Effects asked, Masking masking);

} // namespace smx
