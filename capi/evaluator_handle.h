// The evaluator's handle, and its quantities by their bits.
#pragma once

#include <array>
#include <memory>
#include <utility>

#include "evaluator.h"
#include "handles.h"

struct smx_evaluator_s : smx::Handle<smx::Evaluator> {
    smx_evaluator_s(std::shared_ptr<smx::Context> on, std::shared_ptr<smx::Evaluator> evaluator)
        : Handle(std::move(evaluator)), context(std::move(on)) {}
    ~smx_evaluator_s() { object.reset(); } // before the context, which it refers to
    std::shared_ptr<smx::Context> context;
};

namespace smx {

constexpr std::array<std::pair<std::uint32_t, Quantity>, 7> quantity_bits = {{{SMX_QUANTITY_FCOS, Quantity::Fcos},
                                                                              {SMX_QUANTITY_PDF, Quantity::Pdf},
                                                                              {SMX_QUANTITY_SAMPLE, Quantity::Sample},
                                                                              {SMX_QUANTITY_NDF, Quantity::Ndf},
                                                                              {SMX_QUANTITY_SIGMA, Quantity::Sigma},
                                                                              {SMX_QUANTITY_G1, Quantity::G1},
                                                                              {SMX_QUANTITY_G2, Quantity::G2}}};

} // namespace smx
