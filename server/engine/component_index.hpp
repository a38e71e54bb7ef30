// Components to be looked up by what conditions demand of them.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/demand.hpp"

namespace rois {

class RegisteredComponent;

// Components one after the other, ordered by ref, each once. Good until a component comes or goes.
class ComponentsInOrder {
public:
    using List = std::span<RegisteredComponent* const>;  // ordered by ref

    ComponentsInOrder(std::vector<RegisteredComponent*> own, std::vector<List> others);
    ComponentsInOrder(ComponentsInOrder&&) noexcept = default;
    ComponentsInOrder& operator=(ComponentsInOrder&&) noexcept = default;

    // Null when there is no other.
    RegisteredComponent* next();

private:
    std::vector<RegisteredComponent*> own_;  // one of the lists
    std::vector<List> lists_;                // what is left of each
};

class ComponentIndex {
public:
    // One that is there already is there once.
    void add(RegisteredComponent&);
    void remove(RegisteredComponent const&);

    // Ordered by ref.
    std::vector<RegisteredComponent*> const& all() const { return all_; }

    // Those of which alone the demand can be met; all when there is none.
    ComponentsInOrder possible(std::optional<Demand> const&) const;

private:
    std::vector<RegisteredComponent*> all_;
    std::map<std::string, std::vector<RegisteredComponent*>, std::less<>> by_type_;  // ordered by ref, too
};

}  // namespace rois
