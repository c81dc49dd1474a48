// Filtered shading under a uniform light of radiance 1: the integral of f cos_i over all wi above, from samples
// (pixel_samples.clh) of directions that the widened lobes reflect (draw_light.clh). f cos_i is that of
// shade_filtered.cl, or of shade_widened.cl.
//
// Build parameters
//   W             lanes per work-item (vec.clh); default 1
//   GRADE         0: precise, 1: fast, 2: double (vec.clh); default 0
//   PER_LOBE      0: shared model, 1: per-lobe model (mixture.clh); default 0
//   and what is simulated (effects.clh)
//   WIDENING      0: all lobes in closed form; 1 or 2: each by its order, axes along which X is rough
//   (facet_chart.clh);
//                 default 0
#ifndef WIDENING
#define WIDENING 0
#endif

#include "draw_light.clh"
#include "fcos.clh"
#include "packed.clh"
#include "widened_fcos.clh"

// The mixture, and where directions are drawn.
typedef struct {
    Displacement x;
    __constant const LightLobe *drawn;
    int drawn_count;
    __constant const Lobe *lobes;
    int count;
    Curves curves;
#if WIDENING
    FacetDensity facets;
    __constant const QuadratureLobe *orders;
    __constant const HermiteNode *nodes;
#endif
} Shading;

// f cos_i over the density that the direction was drawn by. Adds to `unsettled` the lanes that have a lobe whose peak
// the Newton steps did not settle.
inline RgbW sample_value(const Shading *f, PlaneW u, VectorW wo, intW inside, int *unsettled) {
    Bounce b = draw_light(&f->x, f->drawn, f->drawn_count, u, wo);
    VectorW i = b.wi;
    Evaluation e = evaluation_of(&f->x, i, wo);
    e.visible = e.visible && inside && (b.density > (realW)0.0f);
    KnotPosition knot = knot_of(&f->curves, i, wo);
#if WIDENING
    Quadrature q = quadrature(&f->facets, f->orders, f->nodes, &e, i.x, i.y, i.z, wo.x, wo.y, wo.z);
    RgbW fcos = widened_fcos_of_pair(f->lobes, f->count, &f->curves, &knot, &e, &q);
    *unsettled += lanes_of(q.unsettled && e.visible);
#else
    RgbW fcos = fcos_of_pair(f->lobes, f->count, PER_LOBE, &f->curves, &knot, &e);
#endif
    return scaled(fcos, 1.0f / selectW((realW)1.0f, b.density, e.visible));
}

// Adds a part of the samples to W pixels of row first_row + r, work-item (c, r), and to `unsettled` the samples that
// have a lobe whose peak was not settled. `packed` is the material (packed.clh).
__kernel void shade_uniform(__global float4 *rgba, __global float4 *errors, __global Estimate *estimates, Part part,
                            __constant uint *seeds, int first_row, SphereView view, Displacement x,
                            __constant LightLobe *drawn, int drawn_count, __constant Lobe *lobes, int count,
                            __global const float *packed, __global int *unsettled
#if WIDENING
                            ,
                            FacetDensity facets, __constant QuadratureLobe *orders, __constant HermiteNode *nodes
#endif
) {
    int column = W * (int)get_global_id(0), row = (int)get_global_id(1), at = row * view.width + column;
    if (column >= view.width) return;
    SpherePoint s = sphere_point(&view, column + laneW, first_row + row);
    VectorW wo = view_of(&s);
#if WIDENING
    const Shading f = {x, drawn, drawn_count, lobes, count, packed_curves(packed), facets, orders, nodes};
#else
    const Shading f = {x, drawn, drawn_count, lobes, count, packed_curves(packed)};
#endif

    Estimates e;
    int counted = 0;
    load_estimates(&e, estimates + at, &part, view.width - column);
    for (int number = 0; number < part.scrambles && anyW(s.inside); ++number) {
        Scramble scramble = scramble_of(seeds[part.scramble + number], (first_row + row) * view.width + column);
        begin_scramble(&e, &part);
        for (int block = part.first; block < part.first + part.size; block += BLOCK) {
            RgbW sum = {(realW)0.0f, (realW)0.0f, (realW)0.0f};
            for (int k = block; k < min(block + BLOCK, part.first + part.size); ++k)
                sum = plus(sum, sample_value(&f, point_of_direction(&scramble, (uint)k), wo, s.inside, &counted));
            add_samples(&e, sum);
        }
        end_scramble(&e, &part, number);
    }
    store_estimates(&e, estimates + at, rgba + at, errors + at, &part, s.inside, view.width - column);
    if (counted > 0) atomic_add(unsettled, counted);
}
