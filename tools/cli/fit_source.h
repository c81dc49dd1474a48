// An input of `fit`, opened: a table, or a slope density that is from none.
#pragma once

#include <string>

#include "flags.h"
#include "handles.h"
#include "input.h"

namespace slopemix::cli {

class FitSource {
  public:
    FitSource(const std::string &input, const FitFlags &flags);

    const std::string &input() const { return input_; }
    const FitFlags &flags() const { return flags_; } // that are for this input
    std::string sha256() const;
    const Brdf &brdf() const { return brdf_; } // null: there is none

    // Made when they are first asked for: a table's inversion, and the fit of the model that flags() does not name.
    const Density &density();
    const Material &other_model();

  private:
    std::string input_;
    FitFlags flags_;
    Brdf brdf_;
    Density density_;
    Material other_model_;
};

} // namespace slopemix::cli
