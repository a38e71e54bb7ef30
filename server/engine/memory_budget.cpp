#include "engine/memory_budget.hpp"

namespace rois {

MemoryBudget& MemoryBudget::none() {
    static MemoryBudget unlimited;
    return unlimited;
}

void MemoryBudget::look() {
    taken_ = 0;
    if (measure_) used_ = measure_() + reserved_;
}

MemoryBudget::Room MemoryBudget::reserve(std::size_t bytes) {
    if (bytes == 0) return {*this, 0};
    auto const before = reserved_.fetch_add(bytes);
    Room room{*this, bytes};
    if (!measure_) return room;
    if (measure_() + before + bytes <= total()) return room;
    return {};
}

std::string MemoryBudget::refuse(std::string_view what) {
    ++refusals_;
    if (exhausted()) return std::string{what} + ": the system gives the gateway no more memory; try again later";
    auto const in_mib = [](std::size_t bytes) { return std::to_string(bytes >> 20U); };
    return std::string{what} + ": the gateway uses " + in_mib(used()) + " of the " + in_mib(total()) +
           " MiB of its memory_budget; try again later";
}

}  // namespace rois
