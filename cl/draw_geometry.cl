// A picture of the displaced sphere: relief with X's slopes, far larger than the displacement it stands for, so that
// its shape shows. The radius is 1 + relief(direction), a sum of waves that the host draws; a ray is marched to it. Not
// a reference: the relief's slopes are X's only in their statistics.

typedef struct {
    float kx, ky, kz; // wave over the unit direction (solid), over theta (kx) or over phi (kx)
    float amplitude, phase;
    int kind; // 0: solid, 1: along theta, 2: along phi, fading towards the poles
} Wave;

#define MARCH_STEPS 96
#define BISECTIONS 12

inline float relief(__constant const Wave *waves, int count, float3 p) {
    float theta = acos(clamp(p.z, -1.0f, 1.0f)), phi = atan2(p.y, p.x);
    float sin_theta = sqrt(fmax(1.0f - p.z * p.z, 0.0f));
    float sum = 0.0f;
    for (int j = 0; j < count; ++j) {
        Wave w = waves[j];
        float at = w.kind == 0 ? w.kx * p.x + w.ky * p.y + w.kz * p.z : w.kx * (w.kind == 1 ? theta : phi);
        sum += w.amplitude * cos(at + w.phase) * (w.kind == 2 ? sin_theta : 1.0f);
    }
    return sum;
}

// Height of p above the displaced sphere of mean radius `radius`, along the ray from the centre.
inline float height_above(__constant const Wave *waves, int count, float radius, float3 p) {
    float r = length(p);
    return r - radius * (1.0f + relief(waves, count, p / r));
}

inline float3 surface_normal(__constant const Wave *waves, int count, float radius, float3 p) {
    const float e = 2e-3f; // far below the shortest wave, far above a float's steps
    float3 dx = (float3)(e, 0.0f, 0.0f), dy = (float3)(0.0f, e, 0.0f), dz = (float3)(0.0f, 0.0f, e);
    return normalize((float3)(height_above(waves, count, radius, p + dx) - height_above(waves, count, radius, p - dx),
                              height_above(waves, count, radius, p + dy) - height_above(waves, count, radius, p - dy),
                              height_above(waves, count, radius, p + dz) - height_above(waves, count, radius, p - dz)));
}

__kernel void draw_geometry(__global float4 *rgba, int width, int height, int first_row, __constant Wave *waves,
                            int count, float radius) {
    int column = (int)get_global_id(0), band_row = (int)get_global_id(1), row = first_row + band_row;
    if (column >= width) return;
    float inv_side = 1.0f / (float)min(width, height);
    float x = (float)(2 * column + 1 - width) * inv_side, z = (float)(height - 2 * row - 1) * inv_side;

    // March through the shell that holds the relief, towards -y.
    const float outer = 1.0f;
    float near2 = outer * outer - x * x - z * z;
    float4 pixel = (float4)(0.0f);
    if (near2 > 0.0f) {
        float y = sqrt(near2), step = 1.2f * y / MARCH_STEPS;
        float hit = -2.0f;
        for (int s = 0; s < MARCH_STEPS && hit < -1.0f; ++s) {
            y -= step;
            if (height_above(waves, count, radius, (float3)(x, y, z)) <= 0.0f) hit = y;
        }
        if (hit >= -1.0f) {
            float inside = hit, outside = hit + step;
            for (int b = 0; b < BISECTIONS; ++b) {
                float middle = 0.5f * (inside + outside);
                if (height_above(waves, count, radius, (float3)(x, middle, z)) <= 0.0f)
                    inside = middle;
                else
                    outside = middle;
            }

            // Shade as a matte solid under a raking light and a weak one from the viewer.
            float3 n = surface_normal(waves, count, radius, (float3)(x, inside, z));
            float key = fmax(dot(n, normalize((float3)(-0.75f, 0.45f, 0.6f))), 0.0f);
            float fill = fmax(n.y, 0.0f);
            pixel = (float4)((float3)(0.62f * key + 0.16f * fill + 0.02f), 1.0f);
        }
    }
    rgba[band_row * width + column] = pixel;
}
