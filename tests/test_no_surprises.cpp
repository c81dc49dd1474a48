// What the library leaves as it is: standard streams, the locale, the floating-point mode, signals, the folder, the
// environment, descriptors and memory; and that it works where the caller's locale writes numbers in another way.
#include <gtest/gtest.h>

#include <fcntl.h>
#include <malloc.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cfenv>
#include <clocale>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <locale>
#include <sstream>

#include "files.h"
#include "slopemix_opencl.h"
#include "support.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

extern char **environ;

namespace {

using Evaluator = test::Handle<smx_evaluator, smx_evaluator_release>;
namespace fs = std::filesystem;

// A bit of everything, with files in `folder`. Returns numbers that depend on all of it.
std::vector<double> use_library(const test::TempDir &folder, smx_context context) {
    test::Brdf brdf, read_brdf;
    test::Density density, read_density;
    test::Material material, loaded;
    EXPECT_SMX_OK(smx_brdf_open("analytic:ggx,alpha=0.25,f0=0.5/0.3/0.1", brdf.out()));
    EXPECT_SMX_OK(smx_brdf_write(brdf, (folder / "ggx.binary").c_str()));
    EXPECT_SMX_OK(smx_brdf_open((folder / "ggx.binary").c_str(), read_brdf.out()));
    EXPECT_SMX_OK(smx_density_create(read_brdf, nullptr, density.out()));
    test::write_file(folder / "d.csv", "theta,p22\n0,1.5\n0.5,0.25\n1.25,0.0\n");
    EXPECT_SMX_OK(smx_density_read_csv((folder / "d.csv").c_str(), read_density.out()));
    smx_fit_options fit = SMX_FIT_OPTIONS_INIT;
    fit.model = SMX_MODEL_SHARED;
    fit.lobes = 2;
    EXPECT_SMX_OK(smx_material_fit(density, &fit, material.out()));
    EXPECT_SMX_OK(smx_material_save(material, (folder / "m.json").c_str()));
    EXPECT_SMX_OK(smx_material_load((folder / "m.json").c_str(), loaded.out()));

    const smx_scene scene = test::make_scene(24, 24, 1.0, {0.25, 0.25, 0.0, 0.0, 0.0});
    smx_render_options options = test::make_options(16);
    smx_geometric_options paths = SMX_GEOMETRIC_OPTIONS_INIT;
    paths.tile = 64;
    test::Image filtered, reference, geometric, read;
    EXPECT_SMX_OK(smx_render_filtered(context, loaded, &scene, nullptr, filtered.out(), nullptr));
    EXPECT_SMX_OK(smx_render_reference(context, brdf, &scene, &options, reference.out(), nullptr));
    EXPECT_SMX_OK(smx_render_geometric(context, brdf, &scene, &options, &paths, geometric.out(), nullptr));
    EXPECT_SMX_OK(smx_image_write_exr(filtered, (folder / "i.exr").c_str()));
    EXPECT_SMX_OK(smx_image_write_png(filtered, (folder / "i.png").c_str(), 1.5));
    EXPECT_SMX_OK(smx_image_read_exr((folder / "i.exr").c_str(), read.out()));

    Evaluator evaluator;
    EXPECT_SMX_OK(
        smx_evaluator_create(context, material, &scene.displacement, SMX_G2_CORRELATED, nullptr, evaluator.out()));
    const float up[] = {0.0f, 0.6f, 0.8f};
    float wi[3] = {}, fcos[3] = {}, pdf = 0.0f;
    const smx_vectors v = SMX_PACKED(up);
    const smx_vectors_out drawn = SMX_PACKED(wi), value = SMX_PACKED(fcos);
    const smx_scalars_out density_out = {&pdf, 1};
    EXPECT_SMX_OK(smx_evaluator_sample(evaluator, 1, &v, &v, &drawn, &value, &density_out));

    // Errors say numbers too.
    EXPECT_SMX_FAILS(SMX_CANNOT_READ, "nowhere", smx_material_load("nowhere/at/all.json", loaded.out()));
    EXPECT_SMX_FAILS(SMX_INVALID_ARGUMENT, "1.5", smx_brdf_open("analytic:lambert,albedo=1.5", brdf.out()));
    const char *alpha = smx_image_get_attribute(read, "slopemix.alpha_x");
    double quantile = 0.0;
    EXPECT_SMX_OK(smx_image_quantile(geometric, 0.9, &quantile));
    return {test::lobes_of(material)[0].alpha,
            test::relrmse(read, reference),
            quantile,
            double{fcos[1]},
            double{pdf},
            alpha ? static_cast<double>(std::strlen(alpha)) : -1.0};
}

// What beside the rounding is a mode: traps, and what becomes of denormal numbers.
unsigned mode_of_floats() {
#if defined(__x86_64__)
    constexpr unsigned flags = 0x3f; // of what has happened
    return _mm_getcsr() & ~flags;
#else
    return static_cast<unsigned>(fegetexcept());
#endif
}

// What a caller has a right to find again.
struct State {
    std::string c_locale, cxx_locale;
    int rounding;
    unsigned float_mode;
    std::vector<struct sigaction> handlers;
    sigset_t blocked;
    std::string folder;
    mode_t mask;
    std::vector<std::string> environment;

    static State now() {
        State s;
        s.c_locale = std::setlocale(LC_ALL, nullptr);
        s.cxx_locale = std::locale().name();
        s.rounding = std::fegetround();
        s.float_mode = mode_of_floats();
        for (int signal = 1; signal < NSIG; ++signal) {
            struct sigaction action {};
            sigaction(signal, nullptr, &action);
            s.handlers.push_back(action);
        }
        sigprocmask(SIG_SETMASK, nullptr, &s.blocked);
        s.folder = fs::current_path();
        s.mask = umask(0);
        umask(s.mask);
        for (char **entry = environ; *entry; ++entry) s.environment.emplace_back(*entry);
        return s;
    }
};

void expect_same(const State &before, const State &after) {
    EXPECT_EQ(before.c_locale, after.c_locale);
    EXPECT_EQ(before.cxx_locale, after.cxx_locale);
    EXPECT_EQ(before.rounding, after.rounding);
    EXPECT_EQ(before.float_mode, after.float_mode);
    ASSERT_EQ(before.handlers.size(), after.handlers.size());
    for (std::size_t k = 0; k < before.handlers.size(); ++k) {
        EXPECT_EQ(before.handlers[k].sa_handler, after.handlers[k].sa_handler) << "signal " << k + 1;
        EXPECT_EQ(before.handlers[k].sa_flags, after.handlers[k].sa_flags) << "signal " << k + 1;
    }
    for (int signal = 1; signal < NSIG; ++signal)
        EXPECT_EQ(sigismember(&before.blocked, signal), sigismember(&after.blocked, signal)) << "signal " << signal;
    EXPECT_EQ(before.folder, after.folder);
    EXPECT_EQ(before.mask, after.mask);
    EXPECT_EQ(before.environment, after.environment);
}

std::size_t open_descriptors() {
    std::size_t count = 0;
    for (const auto &entry : fs::directory_iterator("/proc/self/fd")) count += !entry.path().empty();
    return count;
}

// A kernel of no use, as any program builds one.
void use_opencl() {
    cl_device_id device = nullptr;
    EXPECT_SMX_OK(smx_context_get_opencl(test::context(), nullptr, nullptr, &device));
    const cl_context context = clCreateContext(nullptr, 1, &device, nullptr, nullptr, nullptr);
    const cl_command_queue queue = clCreateCommandQueue(context, device, 0, nullptr);
    const char *source = "__kernel void one(__global float *x) { x[get_global_id(0)] = 1.0f; }";
    const cl_program program = clCreateProgramWithSource(context, 1, &source, nullptr, nullptr);
    EXPECT_EQ(clBuildProgram(program, 1, &device, "", nullptr, nullptr), CL_SUCCESS);
    const cl_kernel kernel = clCreateKernel(program, "one", nullptr);
    const cl_mem x = clCreateBuffer(context, CL_MEM_READ_WRITE, 64, nullptr, nullptr);
    const std::size_t size = 16;
    clSetKernelArg(kernel, 0, sizeof x, &x);
    EXPECT_EQ(clEnqueueNDRangeKernel(queue, kernel, 1, nullptr, &size, nullptr, 0, nullptr, nullptr), CL_SUCCESS);
    clFinish(queue);
    clReleaseMemObject(x);
    clReleaseKernel(kernel);
    clReleaseProgram(program);
    clReleaseCommandQueue(queue);
    clReleaseContext(context);
}

// Standard output and error go to a file while it lives.
class Captured {
  public:
    explicit Captured(const std::string &path) : path_(path) {
        std::fflush(nullptr);
        const int file = open(path.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0600);
        for (int stream = 1; stream <= 2; ++stream) {
            kept_[static_cast<std::size_t>(stream) - 1] = dup(stream);
            dup2(file, stream);
        }
        close(file);
    }
    std::string end() {
        std::fflush(nullptr);
        for (int stream = 1; stream <= 2; ++stream) {
            dup2(kept_[static_cast<std::size_t>(stream) - 1], stream);
            close(kept_[static_cast<std::size_t>(stream) - 1]);
        }
        return test::read_file(path_);
    }

  private:
    std::string path_;
    std::array<int, 2> kept_{};
};

// 1.234,5 in place of 1234.5.
struct Comma : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
};

// C's locale too, where the system can make one.
bool set_german_locale(const test::TempDir &dir) {
    const std::string make = "localedef -c -i de_DE -f UTF-8 '" + (dir / "de_DE.UTF-8") + "' >/dev/null 2>&1";
    const int made = std::system(make.c_str());
    setenv("LOCPATH", dir.path().c_str(), 1);
    const bool is_set = std::setlocale(LC_ALL, "de_DE.UTF-8") != nullptr;
    unsetenv("LOCPATH");
    return made == 0 && is_set && std::localeconv()->decimal_point[0] == ',';
}

long resident_bytes() {
    malloc_trim(0);
    std::ifstream in("/proc/self/statm");
    long size = 0, resident = 0;
    in >> size >> resident;
    return resident * sysconf(_SC_PAGESIZE);
}

} // namespace

TEST(NoSurprises, EverythingIsAsItWas) {
    const test::TempDir dir, place;
    // The first time, which builds kernels and makes what is made once. OpenCL's own first build may do more: PoCL
    // handles signals and sets a variable.
    use_opencl();
    const State untouched = State::now();
    use_library(dir, test::context());
    expect_same(untouched, State::now());

    const auto here = fs::current_path();
    fs::current_path(place.path());
    std::fesetround(FE_UPWARD);
    signal(SIGPIPE, SIG_IGN);
    const State before = State::now();
    const std::size_t descriptors = open_descriptors();
    Captured output(dir / "output.txt");
    use_library(dir, test::context());
    const std::string said = output.end();
    const State after = State::now();
    EXPECT_EQ(open_descriptors(), descriptors);
    std::fesetround(FE_TONEAREST);
    fs::current_path(here);
    EXPECT_EQ(said, "");
    expect_same(before, after);
    EXPECT_TRUE(fs::is_empty(place.path()));
}

TEST(NoSurprises, NumbersAreReadAndWrittenAlikeInEveryLocale) {
    const test::TempDir dir;
    const std::vector<double> wanted = use_library(dir, test::context());
    const std::string json = test::read_file(dir / "m.json");

    const std::locale old = std::locale::global(std::locale(std::locale::classic(), new Comma));
    const bool has_german = set_german_locale(dir);
    std::ostringstream seen;
    seen << 1234.5;
    EXPECT_EQ(seen.str(), "1.234,5");
    const std::vector<double> got = use_library(dir, test::context());
    std::locale::global(old);
    std::setlocale(LC_ALL, "C");
    EXPECT_EQ(got, wanted);
    const std::string json_again = test::read_file(dir / "m.json");
    // But for what the fit's seconds are.
    EXPECT_EQ(json.substr(0, json.find("\"fit\"")), json_again.substr(0, json_again.find("\"fit\"")));
    if (!has_german) std::printf("no locale de_DE.UTF-8 here: only C++'s was another\n");
}

namespace {

void one_cycle(smx_context shared) {
    static const float up[] = {0.0f, 0.6f, 0.8f};
    static const double theta[] = {0.0, 0.5, 1.2}, values[] = {1.0, 0.3, 0.0};
    float fcos[3];
    const smx_vectors v = SMX_PACKED(up);
    const smx_vectors_out value = SMX_PACKED(fcos);
    const smx_displacement x = {0.25, 0.25, 0.0, 0.0, 0.0};
    const test::Material material = test::make_material({{0.5, 0.2}, {0.5, 0.6}});
    Evaluator evaluator;
    test::Context context;
    test::Image image;
    test::Density density;
    ASSERT_SMX_OK(smx_context_create(nullptr, context.out()));
    ASSERT_SMX_OK(smx_evaluator_create(shared, material, &x, SMX_G2_CORRELATED, nullptr, evaluator.out()));
    ASSERT_SMX_OK(smx_evaluator_eval(evaluator, 1, &v, &v, &value));
    ASSERT_SMX_OK(smx_image_create(64, 64, nullptr, image.out()));
    ASSERT_SMX_OK(smx_image_set_attribute(image, "key", "value"));
    ASSERT_SMX_OK(smx_density_from_samples("d", SMX_DENSITY_P22, 3, theta, values, density.out()));
    EXPECT_EQ(smx_material_load("nowhere.json", nullptr), SMX_INVALID_ARGUMENT);
}

} // namespace

// Ten thousand of every handle that is made quickly: 100 bytes kept by each cycle would be a megabyte.
TEST(NoSurprises, MemoryDoesNotGrow) {
    for (int k = 0; k < 500; ++k) one_cycle(test::context());
    const long before = resident_bytes();
    for (int k = 0; k < 10000; ++k) one_cycle(test::context());
    const long after = resident_bytes();
    EXPECT_LT(after - before, 1 << 20) << before << " bytes, then " << after;
    std::printf("resident memory: %ld kB before, %ld kB after 10,000 cycles\n", before / 1024, after / 1024);
}
