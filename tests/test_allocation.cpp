// Memory that runs out: the n-th allocation of a call fails, once or from there on, for every n up to some and for a
// share of those above. The status is SMX_OUT_OF_MEMORY, nothing is kept, and what comes after works.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <functional>
#include <new>

#include "files.h"
#include "support.h"

namespace {

std::atomic<long> countdown{-1}; // allocations until one fails; negative: none does
std::atomic<bool> for_good{false};
std::atomic<bool> has_failed{false};
std::atomic<long> live{0};

bool fails() {
    long left = countdown.load();
    while (left >= 0) {
        if (left == 0 && for_good) return has_failed = true;
        if (countdown.compare_exchange_weak(left, left - 1)) return left == 0 && (has_failed = true);
    }
    return false;
}

void *allocate(std::size_t size, std::size_t alignment) {
    void *memory = fails() ? nullptr : std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
    if (!memory) return nullptr;
    ++live;
    return memory;
}

void *allocate_or_throw(std::size_t size, std::size_t alignment) {
    void *memory = allocate(size ? size : 1, alignment);
    if (!memory) throw std::bad_alloc();
    return memory;
}

void deallocate(void *memory) {
    if (!memory) return;
    --live;
    std::free(memory);
}

constexpr std::size_t plain = alignof(std::max_align_t);

} // namespace

// They stand in for all of the process, the library's own calls too.
#pragma GCC visibility push(default)
void *operator new(std::size_t size) { return allocate_or_throw(size, plain); }
void *operator new[](std::size_t size) { return allocate_or_throw(size, plain); }
void *operator new(std::size_t size, std::align_val_t align) { return allocate_or_throw(size, std::size_t(align)); }
void *operator new[](std::size_t size, std::align_val_t align) { return allocate_or_throw(size, std::size_t(align)); }
void *operator new(std::size_t size, const std::nothrow_t &) noexcept { return allocate(size ? size : 1, plain); }
void *operator new[](std::size_t size, const std::nothrow_t &) noexcept { return allocate(size ? size : 1, plain); }
void operator delete(void *memory) noexcept { deallocate(memory); }
void operator delete[](void *memory) noexcept { deallocate(memory); }
void operator delete(void *memory, std::size_t) noexcept { deallocate(memory); }
void operator delete[](void *memory, std::size_t) noexcept { deallocate(memory); }
void operator delete(void *memory, std::align_val_t) noexcept { deallocate(memory); }
void operator delete[](void *memory, std::align_val_t) noexcept { deallocate(memory); }
void operator delete(void *memory, std::size_t, std::align_val_t) noexcept { deallocate(memory); }
void operator delete[](void *memory, std::size_t, std::align_val_t) noexcept { deallocate(memory); }
#pragma GCC visibility pop

namespace {

using Call = std::function<smx_status()>; // makes something and lets go of it

smx_status call_failing_at(const Call &call, long n, bool on) {
    has_failed = false;
    for_good = on;
    countdown = n;
    const smx_status status = call();
    countdown = -1;
    return status;
}

// Every n below `all`, then steps that grow: a fit allocates a hundred thousand times.
// OpenEXR itself keeps some bytes where an allocation fails in it.
void expect_out_of_memory(const char *what, long all, const Call &call, bool is_openexr = false) {
    EXPECT_SMX_OK(call()) << what;  // what is kept for later calls is kept now
    for (int k = 0; k < 300; ++k) { // so is the memory of the handles released last, as much as there will be
        test::Image image;
        EXPECT_SMX_OK(smx_image_create(1, 1, nullptr, image.out()));
    }
    for (const bool on : {false, true})
        for (long n = 0;; n += n < all ? 1 : 1 + n / 2) {
            const long before = live;
            const smx_status status = call_failing_at(call, n, on);
            if (!is_openexr) {
                EXPECT_EQ(live, before) << what << ", allocation " << n << " on " << on << ": " << smx_last_error();
            }
            if (!has_failed) {
                EXPECT_GT(n, 0) << what;
                EXPECT_SMX_OK(status) << what;
                break;
            }
            EXPECT_EQ(status, SMX_OUT_OF_MEMORY)
                << what << ", allocation " << n << " on " << on << ": " << smx_last_error();
            if (testing::Test::HasFailure()) return;
        }
}

struct Objects {
    const test::TempDir dir;
    test::Brdf brdf;
    test::Density density;
    test::Material material = test::make_material({{0.5, 0.2}, {0.5, 0.6}});
    test::Image image;

    Objects() {
        EXPECT_SMX_OK(smx_brdf_open("builtin:conductor", brdf.out()));
        EXPECT_SMX_OK(smx_density_create(brdf, nullptr, density.out()));
        // Several of OpenEXR's blocks of rows.
        EXPECT_SMX_OK(smx_image_create(8, 40, nullptr, image.out()));
        EXPECT_SMX_OK(smx_image_set_attribute(image, "slopemix.note", "some text that is not short at all"));
        EXPECT_SMX_OK(smx_brdf_write(brdf, (dir / "t.binary").c_str()));
        EXPECT_SMX_OK(smx_image_write_exr(image, (dir / "i.exr").c_str()));
        test::write_file(dir / "d.csv", "theta,ndf\n0,3.5\n0.25,1.5e-1\n1.5,0\n");
    }
};

smx_status fit(smx_density density, smx_model model) {
    smx_fit_options options = SMX_FIT_OPTIONS_INIT;
    options.lobes = 2;
    options.model = model;
    test::Material material;
    return smx_material_fit(density, &options, material.out());
}

const smx_scene scene = test::make_scene(16, 16, test::radians(60.0), {0.25, 0.25, 0.0, 0.0, 0.0});

} // namespace

// Not material files: the JSON library allocates in a destructor, which ends the process where that fails.
TEST(Allocation, Files) {
    const Objects o;
    const std::string table = o.dir / "t.binary", csv = o.dir / "d.csv", exr = o.dir / "i.exr";
    expect_out_of_memory("smx_brdf_open", 5, [&] {
        test::Brdf brdf;
        return smx_brdf_open(table.c_str(), brdf.out());
    });
    expect_out_of_memory("smx_density_read_csv", 200, [&] {
        test::Density density;
        return smx_density_read_csv(csv.c_str(), density.out());
    });
    expect_out_of_memory(
        "smx_image_read_exr", 200,
        [&] {
            test::Image image;
            return smx_image_read_exr(exr.c_str(), image.out());
        },
        true);
    const auto names = o.dir.names();
    expect_out_of_memory(
        "smx_image_write_exr", 200, [&] { return smx_image_write_exr(o.image, exr.c_str()); }, true);
    expect_out_of_memory("smx_image_write_png", 200, [&] { return smx_image_write_png(o.image, exr.c_str(), 1.0); });
    EXPECT_EQ(o.dir.names(), names);
}

TEST(Allocation, Fits) {
    const Objects o;
    expect_out_of_memory("smx_brdf_open", 5, [&] {
        test::Brdf brdf;
        return smx_brdf_open("analytic:lambert,albedo=0.5", brdf.out());
    });
    expect_out_of_memory("smx_density_create", 5, [&] {
        test::Density density;
        return smx_density_create(o.brdf, nullptr, density.out());
    });
    expect_out_of_memory("smx_material_fit, shared", 100, [&] { return fit(o.density, SMX_MODEL_SHARED); });
    expect_out_of_memory("smx_material_fit, per lobe", 100, [&] { return fit(o.density, SMX_MODEL_PER_LOBE); });
}

TEST(Allocation, Renders) {
    const Objects o;
    const test::Image before = test::render_filtered(o.material, scene);
    expect_out_of_memory("smx_render_filtered", 200, [&] {
        test::Image image;
        return smx_render_filtered(test::context(), o.material, &scene, nullptr, image.out(), nullptr);
    });
    expect_out_of_memory("smx_render_reference", 100, [&] {
        test::Image image;
        const smx_render_options options = test::make_options(16);
        return smx_render_reference(test::context(), o.brdf, &scene, &options, image.out(), nullptr);
    });
    expect_out_of_memory("smx_render_geometric", 100, [&] {
        test::Image image;
        const smx_render_options options = test::make_options(4);
        smx_geometric_options geometric = SMX_GEOMETRIC_OPTIONS_INIT;
        geometric.tile = 64;
        geometric.realisations = 2;
        geometric.bounces = 1;
        return smx_render_geometric(test::context(), o.brdf, &scene, &options, &geometric, image.out(), nullptr);
    });
    expect_out_of_memory("smx_material_eval", 200, [&] {
        const float up[] = {0.0f, 0.0f, 1.0f};
        float fcos[3];
        return smx_material_eval(test::context(), o.material, &scene.displacement, SMX_G2_CORRELATED, nullptr, 1, up,
                                 up, fcos);
    });
    expect_out_of_memory("smx_evaluator_create, smx_evaluator_sample", 200, [&] {
        test::Handle<smx_evaluator, smx_evaluator_release> evaluator;
        const smx_status status = smx_evaluator_create(test::context(), o.material, &scene.displacement,
                                                       SMX_G2_CORRELATED, nullptr, evaluator.out());
        if (status != SMX_OK) return status;
        const float up[] = {0.0f, 0.0f, 1.0f};
        float drawn[6];
        const smx_vectors v = SMX_PACKED(up);
        const smx_vectors_out wi = SMX_PACKED(drawn), fcos = SMX_PACKED(drawn + 3);
        return smx_evaluator_sample(evaluator, 1, &v, &v, &wi, &fcos, nullptr);
    });
    expect_out_of_memory("smx_material_pack", 200, [&] {
        std::size_t count = 0;
        const smx_status status = smx_material_pack(o.material, nullptr, &count);
        if (status != SMX_OK) return status;
        float words[256];
        return count <= 256 ? smx_material_pack(o.material, words, &count) : SMX_INTERNAL;
    });
    EXPECT_EQ(test::relrmse(test::render_filtered(o.material, scene), before), 0.0);
}
