// A path tracer in one kernel, with slopemix's materials. A material is a place in a buffer of words, a surface's
// roughness is made at every hit: by the sphere, by the place on it, by the tile of the floor.
//
// The host puts scene.h before this text, and may put smx_device_header() there too.
#ifndef SMX_SLOPEMIX_CLH
#include "slopemix.clh"
#endif

#define PI 3.14159265358979f
#define FAR 1e30f

// Four uniform numbers of [0, 1) for a place in the sequence: pcg4d of Jarzynski, Olano 2020, "Hash Functions for GPU
// Rendering".
inline float4 uniforms(uint4 v) {
    v = v * 1664525u + 1013904223u;
    v.x += v.y * v.w, v.y += v.z * v.x, v.z += v.x * v.y, v.w += v.y * v.z;
    v ^= v >> 16;
    v.x += v.y * v.w, v.y += v.z * v.x, v.z += v.x * v.y, v.w += v.y * v.z;
    return convert_float4(v >> 8) * 0x1p-24f;
}

// ---- What a ray hits

typedef struct {
    float t;
    float3 normal, x, y; // the frame of shading
    float alpha_x, alpha_y;
    int material;
} Hit;

inline float sphere_distance(__global const Sphere *s, float3 from, float3 d) {
    float3 o = from - (float3)(s->x, s->y, s->z);
    float b = dot(o, d);
    float3 nearest = o - b * d; // to the centre, which does not cancel as dot(o, o) - b b does
    float under = s->radius * s->radius - dot(nearest, nearest);
    if (under < 0.0f) return FAR;
    float t = -b - sqrt(under); // rays begin outside: the farther intersection is never the first
    return t > 0.0f ? t : FAR;
}

inline float lamp_distance(__global const Lamp *lamp, float3 from, float3 d) {
    float3 u = (float3)(lamp->ux, lamp->uy, lamp->uz), v = (float3)(lamp->vx, lamp->vy, lamp->vz), n = cross(u, v);
    float facing = -dot(d, n);
    if (facing <= 0.0f) return FAR;
    float3 to = (float3)(lamp->x, lamp->y, lamp->z) - from;
    float t = -dot(to, n) / facing;
    float3 p = t * d - to;
    float a = dot(p, u) / dot(u, u), b = dot(p, v) / dot(v, v);
    return t > 0.0f && a >= 0.0f && a <= 1.0f && b >= 0.0f && b <= 1.0f ? t : FAR;
}

// Tiles of side 1, every other one rough.
inline Hit floor_hit(const Settings *s, float t, float3 p) {
    float alpha = ((int)floor(p.x) + (int)floor(p.y)) & 1 ? 0.0f : s->tile_alpha;
    Hit h = {t, (float3)(0, 0, 1), (float3)(1, 0, 0), (float3)(0, 1, 0), alpha, alpha, s->floor_material};
    return h;
}

inline Hit sphere_hit(__global const Sphere *s, float t, float3 p) {
    Hit h;
    h.t = t;
    h.normal = normalize(p - (float3)(s->x, s->y, s->z));
    float2 across = h.normal.xy;
    float length2 = dot(across, across);
    float2 azimuth = length2 > 0.0f ? across * rsqrt(length2) : (float2)(1, 0); // at the poles any will do
    h.y = (float3)(-azimuth.y, azimuth.x, 0.0f);
    h.x = cross(h.y, h.normal);
    float right = 0.5f + 0.5f * h.normal.x, more = s->alpha_right * right * right;
    h.alpha_x = s->alpha_x + more, h.alpha_y = s->alpha_y + more;
    h.material = s->material;
    return h;
}

inline Hit nearest_hit(const Settings *s, __global const Sphere *spheres, float3 from, float3 d) {
    float t = d.z < 0.0f ? -from.z / d.z : FAR;
    int which = -1;
    for (int k = 0; k < s->spheres; ++k) {
        float sphere = sphere_distance(spheres + k, from, d);
        if (sphere < t) t = sphere, which = k;
    }
    float3 p = from + t * d;
    return which < 0 ? floor_hit(s, t, p) : sphere_hit(spheres + which, t, p);
}

inline bool is_free(const Settings *s, __global const Sphere *spheres, float3 from, float3 d, float t) {
    for (int k = 0; k < s->spheres; ++k)
        if (sphere_distance(spheres + k, from, d) < t) return false;
    return true;
}

// ---- Light

inline float3 sky(const Settings *s, float3 d) {
    if (s->white_sky) return 1.0f;
    float height = sqrt(max(d.z, 0.0f));
    return mix((float3)(0.85f, 0.75f, 0.68f), (float3)(0.1f, 0.2f, 0.42f), height);
}

inline float3 radiance_of(__global const Lamp *lamp) { return (float3)(lamp->r, lamp->g, lamp->b); }

// Density over solid angle of drawing a direction to a lamp, at distance t: a lamp by chance, a point of it evenly.
inline float lamp_pdf(__global const Lamp *lamp, int lamps, float3 d, float t) {
    float3 n = cross((float3)(lamp->ux, lamp->uy, lamp->uz), (float3)(lamp->vx, lamp->vy, lamp->vz));
    return t * t / (-dot(d, n) * lamps); // the length of n is the area
}

// ---- Materials

typedef struct {
    smx_material material;
    smx_surface surface;
    int by_cosine;
} Shading;

inline smx_vector to_local(const Hit *h, float3 k) {
    smx_vector v = {dot(k, h->x), dot(k, h->y), dot(k, h->normal)};
    return v;
}

inline float3 to_world(const Hit *h, smx_vector v) { return v.x * h->x + v.y * h->y + v.z * h->normal; }

// Variances add: of the roughness of the place and of that of all surfaces.
inline Shading shading_of(const Settings *s, __global const float *words, const Hit *h) {
    float least = s->least_alpha * s->least_alpha;
    Shading at;
    at.material = smx_load_material(words + h->material);
    at.surface = smx_surface_of_alphas(sqrt(h->alpha_x * h->alpha_x + least), sqrt(h->alpha_y * h->alpha_y + least), 0);
    at.by_cosine = s->by_cosine;
    return at;
}

inline float direction_pdf(const Shading *at, smx_vector wi, smx_vector wo) {
    return at->by_cosine ? wi.z / PI : smx_pdf(&at->material, &at->surface, wi, wo);
}

inline smx_drawn draw_direction(const Shading *at, smx_vector wo, smx_vector u) {
    if (!at->by_cosine) return smx_sample(&at->material, &at->surface, wo, u);
    float r = sqrt(u.y), phi = 2.0f * PI * u.z;
    smx_drawn drawn;
    drawn.wi.x = r * cos(phi), drawn.wi.y = r * sin(phi), drawn.wi.z = sqrt(1.0f - u.y);
    drawn.fcos = smx_eval(&at->material, &at->surface, drawn.wi, wo);
    drawn.pdf = drawn.wi.z / PI;
    return drawn;
}

inline float3 colour(smx_rgb c) { return (float3)(c.r, c.g, c.b); }

// ---- Paths

// Light of a lamp that is drawn, weighed against its being met by the next direction (balance heuristic, Veach 1997).
inline float3 light_of_lamp(const Settings *s, __global const Sphere *spheres, __global const Lamp *lamps, const Hit *h,
                            const Shading *at, float3 p, smx_vector wo, float4 u) {
    if (s->lamps == 0) return 0.0f;
    __global const Lamp *lamp = lamps + min((int)(u.x * s->lamps), s->lamps - 1); // the product may round up
    float3 to = (float3)(lamp->x, lamp->y, lamp->z) + u.y * (float3)(lamp->ux, lamp->uy, lamp->uz) +
                u.z * (float3)(lamp->vx, lamp->vy, lamp->vz) - p;
    float t = length(to);
    float3 d = to / t;
    smx_vector wi = to_local(h, d);
    float pdf = lamp_pdf(lamp, s->lamps, d, t);
    if (wi.z <= 0.0f || pdf <= 0.0f || !is_free(s, spheres, p, d, t)) return 0.0f;
    float3 fcos = colour(smx_eval(&at->material, &at->surface, wi, wo));
    return fcos * radiance_of(lamp) / (pdf + direction_pdf(at, wi, wo));
}

// Light that is met along a ray where no surface is before it; `pdf` is the density the ray was drawn with, 0 from the
// eye.
inline float3 light_met(const Settings *s, __global const Lamp *lamps, float3 from, float3 d, float t, float pdf,
                        bool *met) {
    for (int k = 0; k < s->lamps; ++k) {
        float at = lamp_distance(lamps + k, from, d);
        if (at >= t) continue;
        *met = true;
        float3 light = radiance_of(lamps + k);
        return pdf > 0.0f ? light * (pdf / (pdf + lamp_pdf(lamps + k, s->lamps, d, at))) : light;
    }
    *met = t >= FAR;
    return *met ? sky(s, d) : (float3)0.0f;
}

inline float3 path(const Settings *s, __global const Sphere *spheres, __global const Lamp *lamps,
                   __global const float *words, float3 from, float3 d, uint4 place) {
    float3 radiance = 0.0f, through = 1.0f;
    float pdf = 0.0f;
    for (int bounce = 0;; ++bounce) {
        Hit h = nearest_hit(s, spheres, from, d);
        bool met;
        radiance += through * light_met(s, lamps, from, d, h.t, pdf, &met);
        if (met || bounce == s->bounces) break;

        // Off the surface by more than a float's rounding of the place, or the next ray would meet it again.
        Shading at = shading_of(s, words, &h);
        float3 p = from + h.t * d + 1e-4f * h.normal;
        smx_vector wo = to_local(&h, -d);
        float4 u = uniforms(place + (uint4)(0, 0, 2 * bounce + 1, 0));
        radiance += through * light_of_lamp(s, spheres, lamps, &h, &at, p, wo, u);

        float4 v = uniforms(place + (uint4)(0, 0, 2 * bounce + 2, 0));
        smx_vector three = {v.x, v.y, v.z};
        smx_drawn drawn = draw_direction(&at, wo, three);
        if (drawn.wi.z <= 0.0f || drawn.pdf <= 0.0f) break;
        through *= colour(drawn.fcos) / drawn.pdf;

        // Paths that carry little end by chance, and those that go on carry more.
        float survival = min(max(through.x, max(through.y, through.z)), 1.0f);
        if (bounce >= 2 && v.w >= survival) break;
        if (bounce >= 2) through /= survival;
        from = p, d = to_world(&h, drawn.wi), pdf = drawn.pdf;
    }
    return radiance;
}

// The mean of a pass: out [height][width], row 0 at the top.
__kernel void trace(Settings s, __global const Sphere *spheres, __global const Lamp *lamps, __global const float *words,
                    __global float4 *out) {
    int x = get_global_id(0), y = get_global_id(1), pixel = y * s.width + x;
    Camera c = s.camera;
    float3 sum = 0.0f;
    for (int sample = 0; sample < s.samples; ++sample) {
        uint4 place = (uint4)(pixel, s.pass * s.samples + sample, 0, s.seed);
        float4 u = uniforms(place);
        float right = 2.0f * (x + u.x) / s.width - 1.0f, up = 1.0f - 2.0f * (y + u.y) / s.height;
        float3 d = normalize((float3)(c.ahead_x, c.ahead_y, c.ahead_z) +
                             right * (float3)(c.right_x, c.right_y, c.right_z) + up * (float3)(c.up_x, c.up_y, c.up_z));
        sum += path(&s, spheres, lamps, words, (float3)(c.x, c.y, c.z), d, place);
    }
    out[pixel] = (float4)(sum / s.samples, 1.0f);
}
