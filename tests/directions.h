// Pairs of directions as the C API takes them.
#pragma once

#include <cstddef>
#include <vector>

#include "vec3.h"

namespace test {

struct Directions {
    std::vector<float> wi, wo;

    void add(const oracle::Vec &i, const oracle::Vec &o) {
        for (const double v : {i.x, i.y, i.z}) wi.push_back(static_cast<float>(v));
        for (const double v : {o.x, o.y, o.z}) wo.push_back(static_cast<float>(v));
    }
    std::size_t count() const { return wi.size() / 3; }
    static oracle::Vec at(const std::vector<float> &list, std::size_t k) {
        return {list[3 * k], list[3 * k + 1], list[3 * k + 2]};
    }
};

} // namespace test
