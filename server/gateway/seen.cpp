// What a client sees with its rights (docs/trust.md).
#include <algorithm>

#include "gateway/gateway.hpp"

namespace rois {

std::shared_ptr<EngineProfile const> Gateway::profile(Rights const* rights) const {
    std::lock_guard const lock{mutex_};
    return engine_.profile(rights);
}

std::vector<ComponentEntry> Gateway::components(Rights const* rights) const {
    std::lock_guard const lock{mutex_};
    return engine_.components(rights);
}

EngineStatistics Gateway::statistics(Rights const* rights) const {
    std::lock_guard const lock{mutex_};
    auto all = engine_.statistics();
    if (may_see_everything(rights)) return all;
    all.each_session.clear();
    all.components = engine_.components(rights).size();
    auto const sees = [rights](std::string const& ref) { return may_see(rights, ref); };
    all.not_halted = static_cast<std::size_t>(std::ranges::count_if(engine_.not_halted(), sees));
    return all;
}

std::vector<EngineState> Gateway::seen_of(std::vector<EngineState> sub_engines, Rights const* rights) const {
    if (may_see_everything(rights)) return sub_engines;
    auto const seen = components(rights);
    for (auto& engine : sub_engines) {
        auto const prefix = engine.name + ".";
        auto const is_of_it = [&](ComponentEntry const& each) { return each.ref.starts_with(prefix); };
        engine.components = static_cast<std::size_t>(std::ranges::count_if(seen, is_of_it));
        if (rights->sees_all_of(prefix)) continue;
        engine.link.clear();
        engine.last_error.clear();  // it may name components
    }
    std::erase_if(sub_engines, [](EngineState const& engine) { return engine.components == 0; });
    return sub_engines;
}

}  // namespace rois
