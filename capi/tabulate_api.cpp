// smx_density_tabulate, smx_material_tabulate
#include "tabulate.h"

#include "handles.h"

using namespace smx;

extern "C" {

smx_status smx_density_tabulate(smx_density density, smx_brdf *brdf) {
    return guarded([&] {
        require_pointer(density, "density");
        require_pointer(brdf, "brdf");
        *brdf = new smx_brdf_s(std::make_shared<const Brdf>(tabulate(density->object->density)));
    });
}

smx_status smx_material_tabulate(smx_material material, smx_brdf *brdf) {
    return guarded([&] {
        require_pointer(material, "material");
        require_pointer(brdf, "brdf");
        *brdf = new smx_brdf_s(std::make_shared<const Brdf>(tabulate(*material->object)));
    });
}
}
