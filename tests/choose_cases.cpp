#include "choose_cases.h"

#include <algorithm>

namespace test {

namespace {

// The truth's standard error, as a share of the error that is asked for: 1.4 % of both together.
constexpr double truth_share = 1.0 / 6.0;
constexpr uint64_t truth_seed = 77;

smx_configuration to_c(const smx::Configuration &c) {
    return {c.material ? static_cast<int32_t>(*c.material) : SMX_BY_REFERENCE,
            c.widening_order,
            static_cast<smx_sampler>(c.sampler),
            c.spp,
            0.0,
            c.seconds};
}

bool is_same(const smx_configuration &a, const smx_configuration &b) {
    if (a.material != b.material) return false;
    return a.material == SMX_BY_REFERENCE ? a.sampler == b.sampler && a.spp == b.spp
                                          : a.widening_order == b.widening_order;
}

// The library's list of all configurations, cheapest first.
std::vector<smx_configuration> all_configurations(const ChooseSubject &subject, const smx_scene &s) {
    const smx::Scene scene{s.width, s.height, s.light_phi, {s.displacement.alpha_x, s.displacement.alpha_y}};
    std::vector<const smx::Material *> shapes;
    for (const smx::Material &shape : subject.shapes) shapes.push_back(&shape);
    std::vector<smx_configuration> all;
    for (const smx::Configuration &c : smx::configurations(shapes, true, scene)) all.push_back(to_c(c));
    return all;
}

} // namespace

ChooseSubject choose_subject(const std::string &path_or_builtin) {
    ChooseSubject subject;
    subject.name = path_or_builtin;
    EXPECT_SMX_OK(smx_brdf_open(path_or_builtin.c_str(), subject.brdf.out()));
    const Density density = make_density(subject.brdf, SMX_MASKING_COINCIDES);
    for (const smx_model model : {SMX_MODEL_SHARED, SMX_MODEL_PER_LOBE})
        for (const uint32_t lobes : {1u, 8u}) {
            subject.materials.push_back(fit(density, lobes, model));
            subject.shapes.emplace_back().lobes.resize(info_of(subject.materials.back()).lobes);
        }
    return subject;
}

ChooseCase choose_case(Random &random, uint32_t resolution) {
    const double r = random.log_uniform(0.05, 1.0), other = random.log_uniform(0.05, 1.0);
    const smx_displacement kinds[] = {{r, r, 0, 0, 0}, {r, other, 0, 0, 0}, {r, 0, 0, 0, 0}, {0, r, 0, 0, 0}};
    // Isotropic, anisotropic, and one of the lines in turn.
    const std::size_t kind = random.below(3), line = random.below(2);
    const smx_displacement x = kinds[kind == 2 ? 2 + line : kind];
    const double light = radians(random.uniform(-60.0, 90.0));
    return {make_scene(resolution, resolution, light, x), random.log_uniform(0.003, 0.3)};
}

Image render_configuration(const ChooseSubject &subject, const smx_scene &scene, const smx_configuration &c,
                           smx_render_report *report) {
    smx_render_options options = SMX_RENDER_OPTIONS_INIT;
    Image image;
    if (c.material == SMX_BY_REFERENCE) {
        options.sampler = c.sampler;
        options.spp = c.spp;
        EXPECT_SMX_OK(smx_render_reference(context(), subject.brdf, &scene, &options, image.out(), report));
    } else {
        options.widening_order = c.widening_order;
        const smx_material material = subject.materials[static_cast<std::size_t>(c.material)];
        EXPECT_SMX_OK(smx_render_filtered(context(), material, &scene, &options, image.out(), report));
    }
    return image;
}

ChooseOutcome outcome_of(const ChooseSubject &subject, const ChooseCase &c) {
    ChooseOutcome outcome{SMX_CHOICE_INIT, 0.0, 1.0, 1.0};
    std::vector<smx_material> materials;
    for (const Material &material : subject.materials) materials.push_back(material);
    smx_choose_options options = SMX_CHOOSE_OPTIONS_INIT;
    options.max_error = c.max_error;
    EXPECT_SMX_OK(smx_choose(context(), subject.brdf, materials.data(), materials.size(), &c.scene, nullptr, &options,
                             &outcome.choice));

    smx_render_options exact = SMX_RENDER_OPTIONS_INIT;
    exact.target_error = truth_share * c.max_error;
    exact.seed = truth_seed;
    const Image truth = render_reference(subject.brdf, c.scene, exact);
    smx_render_report report = SMX_RENDER_REPORT_INIT;
    const smx_configuration &picked = outcome.choice.picked;
    outcome.true_error = relrmse(render_configuration(subject, c.scene, picked, &report), truth);
    outcome.time_ratio = report.kernel_seconds / picked.seconds;

    const std::vector<smx_configuration> all = all_configurations(subject, c.scene);
    const auto chosen = std::find_if(all.begin(), all.end(), [&](const auto &one) { return is_same(one, picked); });
    EXPECT_NE(chosen, all.end());
    const auto enough = std::find_if(all.begin(), chosen, [&](const smx_configuration &one) {
        return relrmse(render_configuration(subject, c.scene, one), truth) <= c.max_error;
    });
    outcome.cost_ratio = chosen->seconds / enough->seconds;
    return outcome;
}

} // namespace test
