// The baseline of the reference's benchmarks: the same integral, written plainly. A work-item takes one sample of one
// pixel: built-in functions, angles by acos and atan2, a trilinear lookup in the whole table.

inline float plain_uniform(uint *state) {
    *state = *state * 747796405u + 2891336453u;
    uint word = ((*state >> ((*state >> 28) + 4u)) ^ *state) * 277803737u;
    return ((float)(((word >> 22) ^ word) >> 9) + 0.5f) * 0x1p-23f;
}

inline float plain_sigma(float alpha, float3 k) {
    float sine = sqrt(fmax(1.0f - k.z * k.z, 0.0f)), v = k.z / (alpha * sine + 1e-20f);
    return 0.5f * k.z * (1.0f + erf(v)) + alpha * sine * exp(-v * v) / (2.0f * sqrt(M_PI_F));
}

inline float4 plain_lookup(__global const float4 *table, float theta_h, float theta_d, float phi_d) {
    float h = sqrt(theta_h / M_PI_2_F) * 90.0f, d = theta_d / M_PI_2_F * 90.0f, p = phi_d / M_PI_F * 180.0f;
    int h0 = min((int)h, 88), d0 = min((int)d, 88), p0 = min((int)p, 179), p1 = (p0 + 1) % 180;
    float fh = fmin(h - h0, 1.0f), fd = fmin(d - d0, 1.0f), fp = p - p0;
    float4 value = (float4)(0.0f);
    for (int corner = 0; corner < 8; ++corner) {
        int up = corner & 1, over = (corner >> 1) & 1, across = corner >> 2;
        float weight = (up ? fh : 1.0f - fh) * (over ? fd : 1.0f - fd) * (across ? fp : 1.0f - fp);
        value += weight * table[((h0 + up) * 90 + d0 + over) * 180 + (across ? p1 : p0)];
    }
    return value;
}

// values: [samples][side * side]; table: [90][90][180] of RGB and a zero; isotropic X; the light stands at phi in the
// plane z = 0.
__kernel void reference_plain(__global float4 *values, int side, float light_phi, float alpha,
                              __global const float4 *table, uint seed) {
    int pixel = (int)get_global_id(0), sample = (int)get_global_id(1);
    float x = (2 * (pixel % side) + 1 - side) / (float)side, z = (side - 1 - 2 * (pixel / side)) / (float)side;
    float4 value = (float4)(0.0f);
    if (x * x + z * z < 1.0f) {
        // The pixel's frame, and both directions in it.
        float3 n = (float3)(x, sqrt(1.0f - x * x - z * z), z);
        float3 b = normalize((float3)(-n.y, n.x, 0.0f)), t = cross(b, n);
        float3 light = (float3)(cos(light_phi), sin(light_phi), 0.0f), view = (float3)(0.0f, 1.0f, 0.0f);
        float3 wi = (float3)(dot(light, t), dot(light, b), dot(light, n));
        float3 wo = (float3)(dot(view, t), dot(view, b), dot(view, n));

        // A facet of X.
        uint state = seed + (uint)(sample * side * side + pixel);
        plain_uniform(&state);
        float radius = alpha * sqrt(-log(plain_uniform(&state))), turn = 2.0f * M_PI_F * plain_uniform(&state);
        float3 wm = normalize((float3)(-radius * cos(turn), -radius * sin(turn), 1.0f));
        float i_m = dot(wi, wm), o_m = dot(wo, wm);
        if (wi.z > 0.0f && wo.z > 0.0f && i_m > 0.0f && o_m > 0.0f) {
            // Half and difference angles about the facet.
            float3 wh = normalize(wi + wo);
            float theta_h = acos(clamp(dot(wh, wm), -1.0f, 1.0f)), theta_d = acos(clamp(dot(wi, wh), -1.0f, 1.0f));
            float3 across = cross(wm, wh);
            float phi_d = atan2(dot(cross(across, wh), cross(wi, wh)), dot(across, cross(wi, wh)));
            if (phi_d < 0.0f) phi_d += M_PI_F;

            float sigma_i = plain_sigma(alpha, wi), sigma_o = plain_sigma(alpha, wo);
            float g2_over_co = wi.z / (sigma_i * wo.z + sigma_o * wi.z - wi.z * wo.z);
            float weight = i_m * o_m / wm.z * g2_over_co;
            value = weight * plain_lookup(table, theta_h, theta_d, phi_d);
            value.w = 1.0f;
        }
    }
    values[sample * side * side + pixel] = value;
}
