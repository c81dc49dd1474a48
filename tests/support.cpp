#include "support.h"

#include <cctype>
#include <stdexcept>

namespace test {
namespace {

std::string lower(std::string text) {
    for (char &c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

} // namespace

::testing::AssertionResult succeeded(const char *expression, smx_status status) {
    if (status == SMX_OK) return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure() << expression << "\n  gave " << smx_status_name(status) << " (" << status
                                         << "): " << smx_last_error();
}

::testing::AssertionResult failed_with(const char *expression, const char *, const char *, smx_status got,
                                       smx_status wanted, const std::string &needle) {
    const std::string message = smx_last_error();
    if (got == wanted && !message.empty() && lower(message).find(lower(needle)) != std::string::npos)
        return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure() << expression << "\n  gave " << smx_status_name(got) << " with the message \""
                                         << message << "\"\n  wanted " << smx_status_name(wanted)
                                         << " with a message that has \"" << needle << "\"";
}

namespace {

// Goes before main() ends: an OpenCL implementation may keep what a release needs in thread-local objects, which are
// gone when static ones go.
class SharedContext : public ::testing::Environment {
  public:
    smx_context get() {
        if (!context_) {
            EXPECT_SMX_OK(smx_context_create(nullptr, context_.out()));
        }
        return context_;
    }
    void TearDown() override { context_ = Context(); }

  private:
    Context context_;
};

SharedContext *const shared_context = new SharedContext;
[[maybe_unused]] const auto *const registered = ::testing::AddGlobalTestEnvironment(shared_context);

} // namespace

smx_context context() { return shared_context->get(); }

bool has_double() {
    static const bool found = [] {
        const Material material = make_material({{1.0, 0.1}});
        const smx_scene scene = make_scene(1, 1, 0.0, {});
        smx_render_options options = SMX_RENDER_OPTIONS_INIT;
        options.effects = SMX_EFFECTS_ALL;
        options.grade = SMX_GRADE_DOUBLE;
        Image image;
        return smx_render_filtered(context(), material, &scene, &options, image.out(), nullptr) == SMX_OK;
    }();
    return found;
}

Brdf make_brdf(const oracle::Table &table, const char *name) {
    Brdf b;
    EXPECT_SMX_OK(smx_brdf_create(name, static_cast<uint32_t>(table.phi_d), table.values.data(), b.out()));
    return b;
}

oracle::Table filled_table(smx_brdf brdf) {
    smx_brdf_info info = SMX_BRDF_INFO_INIT;
    EXPECT_SMX_OK(smx_brdf_get_info(brdf, &info));
    oracle::Table t;
    t.phi_d = static_cast<int>(info.phi_d);
    t.values.resize(3 * t.cells());
    EXPECT_SMX_OK(smx_brdf_get_values(brdf, t.values.data(), t.values.size()));
    return t;
}

Material make_material(smx_model model, const std::vector<oracle::Lobe> &lobes, const std::vector<double> &fresnel,
                       std::size_t knots) {
    std::vector<smx_lobe> array;
    for (const oracle::Lobe &l : lobes) array.push_back({l.weight, l.alpha});
    smx_material_desc desc = SMX_MATERIAL_DESC_INIT;
    desc.name = "test";
    desc.model = model;
    desc.lobes = array.data();
    desc.lobe_count = array.size();
    desc.fresnel = fresnel.data();
    desc.knots = knots;
    Material m;
    EXPECT_SMX_OK(smx_material_create(&desc, m.out()));
    return m;
}

Material make_material(const std::vector<oracle::Lobe> &lobes, const Colour &fresnel) {
    return make_material(SMX_MODEL_SHARED, lobes,
                         {fresnel[0], fresnel[0], fresnel[1], fresnel[1], fresnel[2], fresnel[2]}, 2);
}

Material make_per_lobe_material(const std::vector<oracle::Lobe> &lobes, const std::vector<Colour> &fresnel) {
    std::vector<double> curves;
    for (const Colour &colour : fresnel)
        for (const double f : colour) curves.insert(curves.end(), {f, f});
    return make_material(SMX_MODEL_PER_LOBE, lobes, curves, 2);
}

smx_material_info info_of(smx_material material) {
    smx_material_info info = SMX_MATERIAL_INFO_INIT;
    EXPECT_SMX_OK(smx_material_get_info(material, &info));
    return info;
}

std::vector<smx_lobe> lobes_of(smx_material material) {
    std::vector<smx_lobe> lobes(info_of(material).lobes);
    EXPECT_SMX_OK(smx_material_get_lobes(material, lobes.data(), lobes.size()));
    return lobes;
}

Curves curves_of(smx_material material) {
    const smx_material_info info = info_of(material);
    Curves c{std::vector<double>(info.fresnel_knots),
             std::vector<double>(std::size_t{3} * info.fresnel_sets * info.fresnel_knots)};
    EXPECT_SMX_OK(smx_material_get_fresnel(material, c.theta_d.data(), c.fresnel.data(), c.fresnel.size()));
    return c;
}

Density make_density(smx_brdf brdf, smx_masking_kernel kernel) {
    smx_inversion_options options = SMX_INVERSION_OPTIONS_INIT;
    options.masking_kernel = kernel;
    Density d;
    EXPECT_SMX_OK(smx_density_create(brdf, &options, d.out()));
    return d;
}

Material fit(smx_density density, uint32_t lobes, smx_model model) {
    smx_fit_options options = SMX_FIT_OPTIONS_INIT;
    options.model = model;
    options.lobes = lobes;
    Material m;
    EXPECT_SMX_OK(smx_material_fit(density, &options, m.out()));
    return m;
}

oracle::Gaussian gaussian(const smx_displacement &x) {
    return oracle::gaussian(x.alpha_x, x.alpha_y, x.rho, x.mean_slope_x, x.mean_slope_y);
}

oracle::Masking masking(smx_masking g) {
    return g == SMX_G2_SEPARABLE ? oracle::Masking::separable : oracle::Masking::correlated;
}

oracle::Table beckmann_table(const std::vector<oracle::Lobe> &lobes, oracle::Masking masking, int phi_d) {
    const oracle::Mixture mixture{lobes, {}};
    return oracle::make_table(phi_d, [&](const oracle::Vec &wi, const oracle::Vec &wo) {
        const double f = oracle::brdf(mixture, masking, wi, wo);
        return oracle::Rgb{channel_fresnel[0] * f, channel_fresnel[1] * f, channel_fresnel[2] * f};
    });
}

Pixels pixels(smx_image image) {
    Pixels p;
    EXPECT_SMX_OK(smx_image_get_size(image, &p.width, &p.height));
    p.rgba = smx_image_pixels(image);
    if (p.rgba == nullptr) throw std::runtime_error("there is no image");
    return p;
}

smx_scene make_scene(uint32_t width, uint32_t height, double light_phi, const smx_displacement &x,
                     smx_masking masking) {
    smx_scene s = SMX_SCENE_INIT;
    s.width = width;
    s.height = height;
    s.light_phi = light_phi;
    s.displacement = x;
    s.masking = masking;
    return s;
}

smx_render_options make_options(uint32_t spp, uint64_t seed, smx_lookup lookup) {
    smx_render_options o = SMX_RENDER_OPTIONS_INIT;
    o.effects = SMX_EFFECTS_ALL;
    o.sampler = SMX_SAMPLER_GRID;
    o.spp = spp;
    o.seed = seed;
    o.lookup = lookup;
    return o;
}

Image render_filtered(smx_material material, const smx_scene &scene, smx_context where) {
    smx_render_options all = SMX_RENDER_OPTIONS_INIT;
    all.effects = SMX_EFFECTS_ALL;
    Image image;
    EXPECT_SMX_OK(smx_render_filtered(where ? where : context(), material, &scene, &all, image.out(), nullptr));
    return image;
}

Image render_reference(smx_brdf brdf, const smx_scene &scene, const smx_render_options &options, smx_context where) {
    Image image;
    EXPECT_SMX_OK(smx_render_reference(where ? where : context(), brdf, &scene, &options, image.out(), nullptr));
    return image;
}

double relrmse(smx_image image, smx_image reference) {
    smx_comparison c = SMX_COMPARISON_INIT;
    c.relrmse = -1.0;
    EXPECT_SMX_OK(smx_image_compare(image, reference, &c));
    return c.relrmse;
}

} // namespace test
