// cl/slopemix.clh, as a renderer includes it: that it gives what the library's evaluators give, at every width and with
// a surface for each lane; that none of its names but smx ones are left; and the buffer that it reads.
#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "close.h"
#include "context.h"
#include "device_buffer.h"
#include "directions.h"
#include "kernel_files.h"
#include "random.h"
#include "support.h"

using oracle::Vec;

namespace {

using Evaluator = test::Handle<smx_evaluator, smx_evaluator_release>;

// Two float32 evaluations of well-conditioned surfaces, the header's with what it makes of the surface on the device.
constexpr double tolerance = 3e-5;

smx::Context &device() {
    static smx::Context c("", 0);
    return c;
}

cl::Program build(const std::string &source, int width, const std::string &options = "") {
    cl::Program program(device().cl(), source);
    const std::string all = "-cl-std=CL1.2 -DSMX_WIDTH=" + std::to_string(width) + options;
    try {
        program.build(all.c_str());
    } catch (const cl::Error &) {
        ADD_FAILURE() << "width " << width << ":\n"
                      << program.getBuildInfo<CL_PROGRAM_BUILD_LOG>(device().cl().getInfo<CL_CONTEXT_DEVICES>()[0]);
        throw;
    }
    return program;
}

// Of pairs `at` ... `at` + width - 1, in planes of `n`: surface (xx, xy, yy, mean_x, mean_y), wi, wo, u in; f cos, pdf,
// ndf, sigma, g1, g2, and what is drawn out.
const char *const probe = R"(
#if SMX_WIDTH == 1
#define LOAD(p) (*(p))
#define STORE(v, p) (*(p) = (v))
#elif SMX_WIDTH == 4
#define LOAD(p) vload4(0, p)
#define STORE(v, p) vstore4(v, 0, p)
#elif SMX_WIDTH == 8
#define LOAD(p) vload8(0, p)
#define STORE(v, p) vstore8(v, 0, p)
#else
#define LOAD(p) vload16(0, p)
#define STORE(v, p) vstore16(v, 0, p)
#endif
__kernel void probe(__global float *out, __global const float *in, __global const float *words, int n) {
    int at = SMX_WIDTH * (int)get_global_id(0);
    smx_material m = smx_load_material(words);
    in += at, out += at;
    smx_surface x = smx_surface_of_covariance(LOAD(in), LOAD(in + n), LOAD(in + 2 * n), LOAD(in + 3 * n),
                                              LOAD(in + 4 * n));
    smx_vector wi = {LOAD(in + 5 * n), LOAD(in + 6 * n), LOAD(in + 7 * n)};
    smx_vector wo = {LOAD(in + 8 * n), LOAD(in + 9 * n), LOAD(in + 10 * n)};
    smx_vector u = {LOAD(in + 11 * n), LOAD(in + 12 * n), LOAD(in + 13 * n)};
    smx_rgb fcos = smx_eval(&m, &x, wi, wo);
    smx_drawn drawn = smx_sample(&m, &x, wo, u);
    STORE(fcos.r, out);
    STORE(fcos.g, out + n);
    STORE(fcos.b, out + 2 * n);
    STORE(smx_pdf(&m, &x, wi, wo), out + 3 * n);
    STORE(smx_ndf(&m, &x, wi), out + 4 * n);
    STORE(smx_sigma(&m, &x, wi), out + 5 * n);
    STORE(smx_g1(&m, &x, wi), out + 6 * n);
    STORE(smx_g2(&m, &x, wi, wo), out + 7 * n);
    STORE(drawn.wi.x, out + 8 * n);
    STORE(drawn.wi.y, out + 9 * n);
    STORE(drawn.wi.z, out + 10 * n);
    STORE(drawn.fcos.g, out + 11 * n);
    STORE(drawn.pdf, out + 12 * n);
}
)";
constexpr std::size_t inputs = 14, outputs = 13;

std::vector<float> packed(smx_material material) {
    std::size_t count = 0;
    EXPECT_SMX_OK(smx_material_pack(material, nullptr, &count));
    std::vector<float> words(count);
    EXPECT_SMX_OK(smx_material_pack(material, words.data(), &count));
    return words;
}

std::vector<float> run_probe(int width, const std::vector<float> &in, const std::vector<float> &words,
                             const std::string &options = "") {
    const std::size_t n = in.size() / inputs;
    const cl::Program program = build(std::string(smx_device_header()) + probe, width, options);
    cl::Kernel kernel(program, "probe");
    const cl::Buffer out = smx::empty_buffer<float>(device(), n * outputs), from = smx::buffer_from(device(), in);
    const cl::Buffer material = smx::buffer_from(device(), words);
    kernel.setArg(0, out);
    kernel.setArg(1, from);
    kernel.setArg(2, material);
    kernel.setArg(3, static_cast<cl_int>(n));
    device().queue().enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(n / static_cast<std::size_t>(width)));
    std::vector<float> result(n * outputs);
    device().queue().enqueueReadBuffer(out, CL_TRUE, 0, result.size() * sizeof(float), result.data());
    return result;
}

// Each pair with one of a few surfaces, so that neighbouring lanes differ.
const std::vector<smx_displacement> &surfaces() {
    static const std::vector<smx_displacement> list{
        {0.0, 0.0, 0.0, 0.0, 0.0},  {0.25, 0.25, 0.0, 0.0, 0.0}, {0.5, 0.1, 0.0, 0.0, 0.0},  {0.1, 0.5, 0.0, 0.0, 0.0},
        {0.3, 0.2, 0.8, 0.1, -0.2}, {0.3, 0.3, -0.9, 0.0, 0.3},  {0.4, 0.0, 0.0, -0.1, 0.0},
    };
    return list;
}

struct Inputs {
    std::vector<smx_displacement> x;
    test::Directions d;
    std::vector<float> u, planes;
};

Inputs make_inputs(std::size_t n) {
    Inputs in;
    test::Random random(11);
    while (in.x.size() < n) {
        const smx_displacement x = surfaces()[in.x.size() % surfaces().size()];
        const Vec wi = random.direction(0.1), wo = random.direction(0.1);
        if (oracle::plane(test::gaussian(x), wi) < 0.05 || oracle::plane(test::gaussian(x), wo) < 0.05) continue;
        in.x.push_back(x);
        in.d.add(wi, wo);
        for (int c = 0; c < 3; ++c) in.u.push_back(static_cast<float>(random.uniform()));
    }
    in.planes.resize(inputs * n);
    const auto put = [&](std::size_t plane, std::size_t k, double v) {
        in.planes[plane * n + k] = static_cast<float>(v);
    };
    for (std::size_t k = 0; k < n; ++k) {
        const smx_displacement &x = in.x[k];
        put(0, k, 0.5 * x.alpha_x * x.alpha_x);
        put(1, k, 0.5 * x.rho * x.alpha_x * x.alpha_y);
        put(2, k, 0.5 * x.alpha_y * x.alpha_y);
        put(3, k, x.mean_slope_x);
        put(4, k, x.mean_slope_y);
        for (std::size_t c = 0; c < 3; ++c) {
            put(5 + c, k, in.d.wi[3 * k + c]);
            put(8 + c, k, in.d.wo[3 * k + c]);
            put(11 + c, k, in.u[3 * k + c]);
        }
    }
    return in;
}

// The library's own answers, one pair at a time.
std::vector<float> by_evaluators(smx_material material, const Inputs &in) {
    const std::size_t n = in.x.size();
    std::vector<float> result(n * outputs);
    for (std::size_t s = 0; s < surfaces().size(); ++s) {
        Evaluator e;
        EXPECT_SMX_OK(
            smx_evaluator_create(test::context(), material, &surfaces()[s], SMX_G2_CORRELATED, nullptr, e.out()));
        // Every surfaces().size()-th pair.
        const std::size_t step = surfaces().size(), count = (n - s + step - 1) / step;
        const auto vectors = [&](const std::vector<float> &v) {
            const float *p = v.data() + 3 * s;
            return smx_vectors{p, p + 1, p + 2, 3 * step};
        };
        const auto plane = [&](std::size_t k) { return result.data() + k * n + s; };
        const smx_vectors wi = vectors(in.d.wi), wo = vectors(in.d.wo), u = vectors(in.u);
        const smx_vectors_out fcos = {plane(0), plane(1), plane(2), step},
                              drawn = {plane(8), plane(9), plane(10), step};
        std::vector<float> rgb(3 * count);
        const smx_vectors_out drawn_fcos = SMX_PACKED(rgb.data());
        const smx_scalars_out pdf = {plane(3), step}, ndf = {plane(4), step}, sigma = {plane(5), step};
        const smx_scalars_out g1 = {plane(6), step}, g2 = {plane(7), step}, drawn_pdf = {plane(12), step};
        EXPECT_SMX_OK(smx_evaluator_eval(e, count, &wi, &wo, &fcos));
        EXPECT_SMX_OK(smx_evaluator_pdf(e, count, &wi, &wo, &pdf));
        EXPECT_SMX_OK(smx_evaluator_ndf(e, count, &wi, &ndf));
        EXPECT_SMX_OK(smx_evaluator_sigma(e, count, &wi, &sigma));
        EXPECT_SMX_OK(smx_evaluator_g1(e, count, &wi, &g1));
        EXPECT_SMX_OK(smx_evaluator_g2(e, count, &wi, &wo, &g2));
        EXPECT_SMX_OK(smx_evaluator_sample(e, count, &u, &wo, &drawn, &drawn_fcos, &drawn_pdf));
        for (std::size_t k = 0; k < count; ++k) result[11 * n + s + k * step] = rgb[3 * k + 1];
    }
    return result;
}

// Curves over knots that are equidistant, or not.
test::Material make_material(smx_model model, bool equidistant) {
    const std::vector<smx_lobe> lobes = {{0.5, 0.15}, {0.3, 0.4}, {0.2, 1.2}};
    const std::size_t knots = 7, sets = model == SMX_MODEL_SHARED ? 1 : lobes.size();
    std::vector<double> theta_d, curves;
    for (std::size_t k = 0; k < knots; ++k) theta_d.push_back(oracle::pi / 2 * std::pow(double(k) / 6.0, 1.7));
    for (std::size_t k = 0; k < 3 * sets * knots; ++k) curves.push_back(0.1 + double(k * 37 % 19) / 19.0);
    smx_material_desc desc = SMX_MATERIAL_DESC_INIT;
    desc.model = model;
    desc.lobes = lobes.data();
    desc.lobe_count = lobes.size();
    desc.theta_d = equidistant ? nullptr : theta_d.data();
    desc.knots = knots;
    desc.fresnel = curves.data();
    test::Material material;
    EXPECT_SMX_OK(smx_material_create(&desc, material.out()));
    return material;
}

} // namespace

TEST(DeviceHeader, GivesWhatEvaluatorsGive) {
    const Inputs in = make_inputs(1120);
    for (const smx_model model : {SMX_MODEL_SHARED, SMX_MODEL_PER_LOBE})
        for (const bool equidistant : {true, false}) {
            const test::Material material = make_material(model, equidistant);
            const std::vector<float> wanted = by_evaluators(material, in), words = packed(material);
            for (const int width : {1, 4, 8, 16}) {
                const std::vector<float> got = run_probe(width, in.planes, words);
                for (std::size_t k = 0; k < got.size(); ++k) {
                    // What is drawn differs by what float32 moves a direction; values there by as much as it moves
                    // them.
                    const bool is_drawn = k / in.x.size() >= 8;
                    ASSERT_TRUE(test::is_close(got[k], wanted[k], is_drawn ? 1e-3 : tolerance, is_drawn ? 2e-5 : 0.0))
                        << "output " << k / in.x.size() << ", pair " << k % in.x.size() << ", width " << width
                        << ", model " << model << ": got " << got[k] << ", wanted " << wanted[k];
                }
            }
        }
}

TEST(DeviceHeader, HasTheFastGradeAndLeavesEffectsOut) {
    const test::Material material = make_material(SMX_MODEL_PER_LOBE, true);
    Inputs in = make_inputs(112);
    const std::vector<float> wanted = by_evaluators(material, in);
    const std::vector<float> fast = run_probe(8, in.planes, packed(material), " -DSMX_GRADE=1");
    for (std::size_t k = 0; k < 8 * in.x.size(); ++k) EXPECT_CLOSE(fast[k], wanted[k], 2e-3, 0.0);

    // One width and no mean slope, of pairs that have no more.
    const std::vector<float> simple =
        run_probe(8, in.planes, packed(material), " -DSMX_ANISOTROPY=0 -DSMX_MEAN_SLOPE=0");
    std::size_t same = 0, other = 0;
    for (std::size_t k = 0; k < in.x.size(); ++k) {
        const bool is_simple = in.x[k].alpha_x == in.x[k].alpha_y && in.x[k].rho == 0.0;
        if (is_simple) {
            EXPECT_CLOSE(simple[k], wanted[k], tolerance, 0.0);
            ++same;
        } else {
            other += std::abs(simple[k] - wanted[k]) > 1e-3 * wanted[k];
        }
    }
    EXPECT_GT(same, 20u);
    EXPECT_GT(other, 20u);
}

// A covariance on the device, against the oracle's projected areas: ratios of 1 : 1e6, correlations up to +-(1 - 1e-6).
TEST(DeviceHeader, SurfacesAreTheirCovariances) {
    test::Random random(12);
    const test::Material material = test::make_material({{1.0, 0.1}});
    const std::size_t n = 2048;
    std::vector<float> planes(inputs * n, 0.5f);
    std::vector<double> wanted;
    for (std::size_t k = 0; k < n; ++k) {
        const double ax = random.log_uniform(1e-3, 1e3), ay = random.log_uniform(1e-3, 1e3);
        const double rho = k % 4 == 0 ? 0.0 : (1.0 - random.log_uniform(1e-6, 1.0)) * (k % 2 ? 1.0 : -1.0);
        const Vec wi = random.direction(0.01);
        const float xx = static_cast<float>(0.5 * ax * ax), xy = static_cast<float>(0.5 * rho * ax * ay);
        const float yy = static_cast<float>(0.5 * ay * ay);
        planes[k] = xx, planes[n + k] = xy, planes[2 * n + k] = yy, planes[3 * n + k] = planes[4 * n + k] = 0.0f;
        planes[5 * n + k] = static_cast<float>(wi.x), planes[6 * n + k] = static_cast<float>(wi.y);
        planes[7 * n + k] = static_cast<float>(wi.z);
        oracle::Gaussian g = oracle::gaussian(0.1, 0.1);
        g.cov_xx += double{xx}, g.cov_xy += double{xy}, g.cov_yy += double{yy};
        wanted.push_back(
            oracle::sigma(g, {double{planes[5 * n + k]}, double{planes[6 * n + k]}, double{planes[7 * n + k]}}));
    }
    const std::vector<float> got = run_probe(16, planes, packed(material));
    for (std::size_t k = 0; k < n; ++k)
        // k' Cov k may cancel where the slopes are nearly one.
        EXPECT_CLOSE(got[5 * n + k], wanted[k], 1e-4, 1e-4 * std::sqrt(double{planes[k]} + double{planes[2 * n + k]}))
            << "covariance " << planes[k] << " " << planes[n + k] << " " << planes[2 * n + k];
}

TEST(DeviceHeader, BufferIsAsDocumented) {
    const test::Material material = make_material(SMX_MODEL_PER_LOBE, false);
    const std::vector<float> w = packed(material);
    const smx_material_info info = test::info_of(material);
    const std::vector<smx_lobe> lobes = test::lobes_of(material);
    const test::Curves curves = test::curves_of(material);
    EXPECT_EQ(w[0], float{0x534d58});
    EXPECT_EQ(w[1], 1.0f);
    ASSERT_EQ(w[2], static_cast<float>(w.size()));
    EXPECT_EQ(w[3], float{SMX_MODEL_PER_LOBE});
    EXPECT_EQ(w[4], static_cast<float>(info.lobes));
    EXPECT_EQ(w[5], static_cast<float>(info.fresnel_knots));
    EXPECT_EQ(w[6], 0.0f);
    const auto at = [&](std::size_t word) { return w.data() + static_cast<std::size_t>(w[word]); };
    double surface = 0.0, drawn = 0.0;
    for (std::size_t k = 0; k < lobes.size(); ++k) {
        const float *record = at(7) + 4 * k;
        EXPECT_EQ(record[0], static_cast<float>(lobes[k].alpha));
        EXPECT_EQ(record[1], 1.0f);
        EXPECT_EQ(record[2], static_cast<float>(lobes[k].weight));
        surface += double{record[2]}, drawn += double{record[3]};
    }
    EXPECT_NEAR(surface, 1.0, 1e-6);
    EXPECT_NEAR(drawn, 1.0, 1e-6);
    for (std::size_t k = 0; k < curves.theta_d.size(); ++k)
        EXPECT_FLOAT_EQ(at(8)[k], static_cast<float>(curves.theta_d[k] / (oracle::pi / 2)));
    const std::size_t knots = curves.theta_d.size();
    for (std::size_t k = 0; k < curves.fresnel.size(); ++k) {
        const std::size_t set = k / (3 * knots), channel = k / knots % 3, knot = k % knots;
        EXPECT_EQ(at(9)[4 * (set * knots + knot) + channel], static_cast<float>(curves.fresnel[k]));
    }

    // Only a buffer of the right size is written.
    std::vector<float> small(w.size() - 1, -1.0f);
    std::size_t count = small.size();
    EXPECT_SMX_FAILS(SMX_INVALID_ARGUMENT, "count", smx_material_pack(material, small.data(), &count));
    EXPECT_EQ(small[0], -1.0f);
}

namespace {

// Names of macros, functions and types that a file of cl/ defines at its top level.
void collect_names(const std::string &text, std::set<std::string> &macros, std::set<std::string> &names) {
    std::istringstream lines(text);
    const std::regex macro(R"(^\s*#\s*define\s+(\w+))"), function(R"(^inline [\w ]+?\**(\w+)\()"),
        type(R"(^\}\s*(\w+);)");
    const std::regex alias(R"(^typedef [^{]*?(\w+);)"), constant(R"(^    ([A-Z][A-Z0-9_]*),?)");
    bool in_enum = false;
    for (std::string line; std::getline(lines, line);) {
        std::smatch m;
        if (line.starts_with("enum {")) in_enum = true;
        if (line.starts_with("}")) in_enum = false;
        if (std::regex_search(line, m, macro)) macros.insert(m[1]);
        for (const std::regex &pattern : {function, type, alias})
            if (std::regex_search(line, m, pattern)) names.insert(m[1]);
        if (in_enum && std::regex_search(line, m, constant)) names.insert(m[1]);
    }
}

bool is_ours(const std::string &name) { return name.starts_with("smx") || name.starts_with("SMX"); }

} // namespace

// Macros of a renderer's by the names of its parameters would change what it computes: they are refused before it.
TEST(DeviceHeader, RefusesMacrosThatItNeeds) {
    const std::string header = smx_device_header(), kernel = "__kernel void k(__global float *x) { x[0] = W; }";
    for (const std::string name : {"W", "GRADE", "FRESNEL", "MASKING", "MEAN_SLOPE"}) {
        cl::Program program(device().cl(), "#define " + name + " 0\n" + header + kernel);
        EXPECT_THROW(program.build(), cl::Error) << name;
    }
    build(header + "#define W 3.0f\n" + kernel, 4);
}

// After the header, every name of its parts is free: a macro is not defined, and anything else can be a function.
TEST(DeviceHeader, LeavesNoNamesButItsOwn) {
    std::set<std::string> macros, names;
    const std::string header = smx_device_header();
    for (const smx::KernelFile &file : smx::kernel_files())
        if (header.find("\"" + std::string(file.name) + "\"") != std::string::npos && !file.name.starts_with("names"))
            collect_names(std::string(file.text), macros, names);
    ASSERT_GT(macros.size(), 20u);
    ASSERT_GT(names.size(), 60u);
    ASSERT_TRUE(names.contains("visible_slope") && names.contains("Lobe") && names.contains("PACKED_ALPHA"));
    std::string source = header;
    for (const std::string &name : macros)
        if (!is_ours(name)) source += "#ifdef " + name + "\n#error macro " + name + " is left\n#endif\n";
    for (const std::string &name : names)
        if (!is_ours(name) && !macros.contains(name))
            source += "#ifdef " + name + "\n#error name " + name + " is left\n#endif\nvoid " + name + "(void) {}\n";
    build(source + "__kernel void nothing(__global float *out) { out[0] = 1.0f; }\n", 1);
}
