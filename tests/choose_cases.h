// Cases for the choice by error: scenes, materials and errors asked for; and what was chosen against what would have
// done, by rendering all that is cheaper.
#pragma once

#include <string>
#include <vector>

#include "configuration.h"
#include "random.h"
#include "support.h"

namespace test {

// A table with the fits that are chosen from: both models, 1 and 8 lobes.
struct ChooseSubject {
    std::string name;
    Brdf brdf;
    std::vector<Material> materials;
    std::vector<smx::Material> shapes; // as many lobes, for the costs
};
ChooseSubject choose_subject(const std::string &path_or_builtin);

struct ChooseCase {
    smx_scene scene;
    double max_error;
};

// Roughness 0.05..1, in turn isotropic, anisotropic and along one axis; lights -60..90 degrees; errors 0.003..0.3.
ChooseCase choose_case(Random &random, uint32_t resolution);

struct ChooseOutcome {
    smx_choice choice;
    double true_error; // of the image that was chosen
    double cost_ratio; // its cost over that of the cheapest whose true error is at most max_error; 1 if none is cheaper
    double time_ratio; // measured seconds over predicted ones
    bool holds(double max_error) const { return true_error <= 1.25 * max_error; }
};
ChooseOutcome outcome_of(const ChooseSubject &subject, const ChooseCase &c);

// By a configuration of the API's choice, or of the library's list.
Image render_configuration(const ChooseSubject &subject, const smx_scene &scene, const smx_configuration &c,
                           smx_render_report *report = nullptr);

} // namespace test
