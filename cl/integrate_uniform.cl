// The statistical reference under a uniform light of radiance 1: integrate_reference.cl's integral over the facets of
// X, integrated over all wi above,
//   (1 / p_o) integral f(wi_m, wo_m) <wi,wm>+ <wo,wm>+ G2_X D_X(wm) dwm dwi
// from samples (pixel_samples.clh) of a facet of X and a direction that the base reflects there (bounce.clh).
//
// Build parameters
//   W                lanes per work-item (vec.clh); default 1
//   GRADE            0: precise, 1: fast, 2: double (vec.clh); default 0
//   LOOKUP_NEAREST   0: linear, 1: nearest (table_whole.clh); default 0
//   and what hides facets of X (effects.clh)
#include "facet_brdf.clh"
#include "pixel_samples.clh"
#include "surface_masking.clh"

// The table, and where directions are drawn: `lobes` as of draw_bounce.
typedef struct {
    Displacement x;
    __global const float4 *table;
    __constant const float2 *lobes;
    int count;
} Integral;

inline RgbW sample_value(const Integral *f, PlaneW facet, PlaneW direction, VectorW wo) {
    // A facet of X. Its part of the viewer's projected area, <wo,wm> / wm.z, is linear in its slopes.
    PlaneW place = normal_point(facet.x, facet.y);
    realW d1 = sqrt(f->x.var_1) * place.x, d2 = sqrt(f->x.var_2) * place.y;
    VectorW v = {-(f->x.mean_x + f->x.axis_x * d1 - f->x.axis_y * d2),
                 -(f->x.mean_y + f->x.axis_y * d1 + f->x.axis_x * d2), (realW)1.0f};
    realW area = dotW(wo, v), mz = inv_sqrt(dotW(v, v));
    VectorW wm = {v.x * mz, v.y * mz, mz};
    intW seen = area > (realW)0.0f;
    VectorW safe_wo = select_vector(wm, wo, seen);

    UniformsW u = {direction.x, direction.y, rest_of_choice(direction.x, f->lobes, f->count)};
    Bounce b = draw_bounce(u, safe_wo, wm, f->lobes, f->count);
    seen = seen && (b.density > (realW)0.0f) && (b.wi.z > (realW)0.0f);
    realW weight = area * dotW(b.wi, wm) / selectW((realW)1.0f, b.density, seen);
    weight *= masking_factor(&f->x, b.wi.x, b.wi.y, b.wi.z, wo.x, wo.y, wo.z, seen);
    return scaled(facet_brdf(f->table, b.wi, safe_wo, wm, seen), selectW((realW)0.0f, weight, seen));
}

// Adds a part of the samples to W pixels of row first_row + r, work-item (c, r).
__kernel void integrate_uniform(__global float4 *rgba, __global float4 *errors, __global Estimate *estimates, Part part,
                                __constant uint *seeds, int first_row, SphereView view, Displacement x,
                                __global const float4 *table, __constant float2 *lobes, int count) {
    int column = W * (int)get_global_id(0), row = (int)get_global_id(1), at = row * view.width + column;
    if (column >= view.width) return;
    SpherePoint s = sphere_point(&view, column + laneW, first_row + row);
    VectorW wo = view_of(&s);
    const Integral f = {x, table, lobes, count};

    Estimates e;
    load_estimates(&e, estimates + at, &part, view.width - column);
    for (int number = 0; number < part.scrambles && anyW(s.inside); ++number) {
        Scramble scramble = scramble_of(seeds[part.scramble + number], (first_row + row) * view.width + column);
        begin_scramble(&e, &part);
        for (int block = part.first; block < part.first + part.size; block += BLOCK) {
            RgbW sum = {(realW)0.0f, (realW)0.0f, (realW)0.0f};
            for (int k = block; k < min(block + BLOCK, part.first + part.size); ++k)
                sum = plus(sum, sample_value(&f, point_of_facet(&scramble, (uint)k),
                                             point_of_direction(&scramble, (uint)k), wo));
            add_samples(&e, sum);
        }
        end_scramble(&e, &part, number);
    }
    store_estimates(&e, estimates + at, rgba + at, errors + at, &part, s.inside, view.width - column);
}
