#include "sheet_painter.h"

#include <numeric>

#include "input.h"

namespace slopemix::cli {

namespace {

std::string label(const SheetImage &image) {
    const char *const role[] = {"geometry", "reference", "filtered"};
    return to_string(image.id) + ' ' + role[static_cast<std::size_t>(image.role)];
}

// Proportional to the evaluations per pixel, so that the bar moves evenly.
double work_of(const SheetImage &image, const SheetJob &job) {
    return image.role == Role::reference ? job.flags.spp : 1.0;
}

double total_work(const std::vector<SheetImage> &images, const SheetJob &job) {
    return std::accumulate(images.begin(), images.end(), 0.0,
                           [&](double sum, const SheetImage &image) { return sum + work_of(image, job); });
}

} // namespace

SheetPainter::SheetPainter(const SheetJob &job, const SheetPlan &plan, const std::vector<SheetImage> &images)
    : job_(job),
      progress_(total_work(images, job)),
      context_(open_context(job.flags)),
      brdf_(open_brdf(job.input)),
      fits_(job, plan, brdf_) {}

void SheetPainter::skip(const SheetImage &image) {
    progress_.advance(to_string(image.id) + " is there", work_of(image, job_));
}

Rendering SheetPainter::paint(const SheetImage &image) {
    progress_.start(label(image), work_of(image, job_));
    Rendering rendering = render(image);
    progress_.finish();
    return rendering;
}

Rendering SheetPainter::render(const SheetImage &image) {
    const smx_displacement displacement = {image.alpha_x, image.alpha_y, 0.0, 0.0, 0.0};
    const double light = light_degrees[image.has_light() ? image.light : 0];
    const smx_scene what = scene(job_.flags, displacement, light);
    smx_render_options how = render_options(job_.flags);
    progress_.attach(how);
    switch (image.role) {
        case Role::geometry:
            return render_geometry(context_, what, how);
        case Role::reference:
            return render_reference(context_, brdf_, what, how);
        case Role::filtered:
            how.widening_order = image.widening_order;
            return render_filtered(context_, fits_.material_of(image), what, how);
    }
    return {};
}

} // namespace slopemix::cli
