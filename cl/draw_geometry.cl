// A picture of the displaced sphere: the tile of the geometric reference (lib/height_field.h) as relief, with X's
// slopes, and far larger than the displacement that it stands for, so that its shape shows. The radius is 1 + relief; a
// ray is marched to it.
//
// The tile is laid around the point that faces the viewer, straight along every great circle through it (azimuthal
// equidistant), so that its seam is behind; what one axis has beyond the other is a line of the tile along theta or
// phi.

#define MARCH_STEPS 96
#define BISECTIONS 12
#define SHADOW_STEPS 32

// Relief as the host lays it out (lib/draw_geometry.cpp).
typedef struct {
    float shared, along_theta, along_phi; // alphas: of both axes, and what one has beyond the other
    float cells_per_radian;
    int log2_side;
    float radius; // mean, so that the relief fits the unit sphere
} Relief;

// Height over a point of the tile, in cells, between its corners by Catmull-Rom splines: their slopes are continuous.
inline float4 spline_weights(float t) {
    return 0.5f * (float4)(((2.0f - t) * t - 1.0f) * t, (3.0f * t - 5.0f) * t * t + 2.0f,
                           ((4.0f - 3.0f * t) * t + 1.0f) * t, (t - 1.0f) * t * t);
}

inline float tile_height(__global const float *heights, int log2_side, float x, float y) {
    int mask = (1 << log2_side) - 1, left = (int)floor(x), low = (int)floor(y);
    float4 wx = spline_weights(x - (float)left), wy = spline_weights(y - (float)low);
    float column[4];
    for (int j = 0; j < 4; ++j) {
        __global const float *row = heights + (((low + j - 1) & mask) << log2_side);
        column[j] =
            dot(wx, (float4)(row[(left - 1) & mask], row[left & mask], row[(left + 1) & mask], row[(left + 2) & mask]));
    }
    return dot(wy, vload4(0, column));
}

// Slopes along phi stay what they are where latitudes are short: the relief shrinks as they do.
inline float relief_at(const Relief *r, __global const float *heights, float3 p) {
    float theta = acos(clamp(p.z, -1.0f, 1.0f)), phi = atan2(p.x, p.y); // the viewer is at phi 0
    float across = hypot(p.x, p.z), away = atan2(across, p.y);
    float2 outward = across > 0.0f ? (float2)(p.x, p.z) / across : (float2)(0.0f);
    float2 at = away * r->cells_per_radian * outward;
    float sum = r->shared * tile_height(heights, r->log2_side, at.x, at.y);
    sum += r->along_theta * tile_height(heights, r->log2_side, theta * r->cells_per_radian, 0.0f);
    sum += r->along_phi * hypot(p.x, p.y) * tile_height(heights, r->log2_side, phi * r->cells_per_radian, 0.0f);
    return sum / r->cells_per_radian;
}

// Height of p above the displaced sphere, along the ray from the centre.
inline float height_above(const Relief *r, __global const float *heights, float3 p) {
    float distance = length(p);
    return distance - r->radius * (1.0f + relief_at(r, heights, p / distance));
}

inline float3 surface_normal(const Relief *r, __global const float *heights, float3 p) {
    const float e = 2e-3f; // far below a bump, far above a float's steps
    float3 dx = (float3)(e, 0.0f, 0.0f), dy = (float3)(0.0f, e, 0.0f), dz = (float3)(0.0f, 0.0f, e);
    return normalize((float3)(height_above(r, heights, p + dx) - height_above(r, heights, p - dx),
                              height_above(r, heights, p + dy) - height_above(r, heights, p - dy),
                              height_above(r, heights, p + dz) - height_above(r, heights, p - dz)));
}

// Where the ray towards -y through (x, z) meets the surface; below -1 where it does not.
inline float march(const Relief *r, __global const float *heights, float x, float z) {
    float near2 = 1.0f - x * x - z * z;
    if (near2 <= 0.0f) return -2.0f;
    float y = sqrt(near2), step = 1.2f * y / MARCH_STEPS;
    for (int s = 0; s < MARCH_STEPS; ++s) {
        y -= step;
        if (height_above(r, heights, (float3)(x, y, z)) > 0.0f) continue;
        float inside = y, outside = y + step;
        for (int b = 0; b < BISECTIONS; ++b) {
            float middle = 0.5f * (inside + outside);
            if (height_above(r, heights, (float3)(x, middle, z)) <= 0.0f)
                inside = middle;
            else
                outside = middle;
        }
        return inside;
    }
    return -2.0f;
}

// How much of a light that is not quite a point is left: the least height of the ray over its length so far. It begins
// above the surface by more than a float's steps.
inline float light_left(const Relief *r, __global const float *heights, float3 p, float3 n, float3 l) {
    const float sharpness = 12.0f, reach = 0.5f;
    float left = 1.0f;
    for (int s = 1; s <= SHADOW_STEPS; ++s) {
        float t = reach * (float)s / SHADOW_STEPS;
        left = fmin(left, 0.5f + 0.5f * sharpness * height_above(r, heights, p + 4e-3f * n + t * l) / t);
    }
    return smoothstep(0.0f, 1.0f, left);
}

// A matte solid under a raking light from the upper left, which throws shadows, and a weak one from the viewer; what
// lies deep sees less of the latter.
inline float shade(const Relief *r, __global const float *heights, float3 p) {
    float3 n = surface_normal(r, heights, p), l = normalize((float3)(-0.75f, 0.4f, 0.65f));
    float key = fmax(dot(n, l), 0.0f);
    if (key > 0.0f) key *= light_left(r, heights, p, n, l);
    float deep = clamp(0.75f + 3.0f * (length(p) - r->radius), 0.3f, 1.2f);
    return 0.62f * key + 0.14f * deep * fmax(n.y, 0.0f) + 0.02f;
}

__kernel void draw_geometry(__global float4 *rgba, int width, int height, int first_row, Relief relief,
                            __global const float *heights) {
    int column = (int)get_global_id(0), band_row = (int)get_global_id(1), row = first_row + band_row;
    if (column >= width) return;
    float inv_side = 1.0f / (float)min(width, height);
    float x = (float)(2 * column + 1 - width) * inv_side, z = (float)(height - 2 * row - 1) * inv_side;
    float y = march(&relief, heights, x, z);
    rgba[band_row * width + column] =
        y < -1.0f ? (float4)(0.0f) : (float4)((float3)(shade(&relief, heights, (float3)(x, y, z))), 1.0f);
}
