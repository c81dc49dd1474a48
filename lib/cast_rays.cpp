#include "cast_rays.h"

#include "device_buffer.h"

namespace smx {

std::vector<CastRay> cast_rays(Context &context, const HeightField &field, const Displacement &displacement,
                               const std::vector<RayPair> &rays) {
    std::vector<cl_uint2> origins;
    std::vector<cl_float4> wo, wi;
    for (const RayPair &r : rays) {
        origins.push_back({{r.origin[0], r.origin[1]}});
        wo.push_back({{r.wo[0], r.wo[1], r.wo[2], 0.0f}});
        wi.push_back({{r.wi[0], r.wi[1], r.wi[2], 0.0f}});
    }
    const Context::Lock lock(context);
    const cl::Buffer out = empty_buffer<CastRay>(context, rays.size()), heights = buffer_from(context, field.heights),
                     maxima = buffer_from(context, field.maxima), origin_buffer = buffer_from(context, origins),
                     wo_buffer = buffer_from(context, wo), wi_buffer = buffer_from(context, wi);
    cl::Kernel kernel = context.kernel("cast_rays.cl", "cast_rays");
    kernel.setArg(0, out);
    kernel.setArg(1, static_cast<cl_int>(rays.size()));
    kernel.setArg(2, tile_frame(field, displacement));
    kernel.setArg(3, heights);
    kernel.setArg(4, maxima);
    kernel.setArg(5, origin_buffer);
    kernel.setArg(6, wo_buffer);
    kernel.setArg(7, wi_buffer);
    launch(context, kernel, rays.size(), 1, 0);
    std::vector<CastRay> cast(rays.size());
    context.queue().enqueueReadBuffer(out, CL_TRUE, 0, cast.size() * sizeof(CastRay), cast.data());
    return cast;
}

} // namespace smx
