#include "height_fields.h"

namespace smx {

namespace {

constexpr std::size_t most_kept_bytes = std::size_t{1} << 28;

std::size_t bytes_of(const HeightField &field) { return (field.heights.size() + field.maxima.size()) * sizeof(float); }

} // namespace

std::shared_ptr<const HeightFields::Pair> HeightFields::pair(std::uint32_t number) {
    const std::lock_guard lock(mutex_);
    if (const auto found = kept_.find(number); found != kept_.end()) return found->second;
    // Weyl's sequence by the golden ratio: no two numbers of one seed, and none of near seeds, are alike.
    const std::uint64_t seed = seed_ * 0xd1342543de82ef95u + 0x9e3779b97f4a7c15u * (std::uint64_t{number} + 1);
    auto made = std::make_shared<const Pair>(make_height_fields(log2_side_, seed));
    if ((kept_.size() + 1) * 2 * bytes_of((*made)[0]) <= most_kept_bytes) kept_.emplace(number, made);
    return made;
}

std::shared_ptr<const HeightField> HeightFields::get(std::uint32_t realisation) {
    const std::shared_ptr<const Pair> both = pair(realisation / 2);
    return {both, &(*both)[realisation % 2]};
}

} // namespace smx
