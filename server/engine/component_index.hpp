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

    explicit ComponentsInOrder(List all) : first_{all} {}
    ComponentsInOrder(std::vector<RegisteredComponent*> own, std::vector<List> others);
    ComponentsInOrder(ComponentsInOrder&&) noexcept = default;
    ComponentsInOrder& operator=(ComponentsInOrder&&) noexcept = default;

    // Null when there is no other.
    RegisteredComponent* next();
    // All that are left.
    std::vector<RegisteredComponent*> rest();

private:
    std::vector<RegisteredComponent*> own_;
    List first_;                // what is left of the one list, or of its own
    std::vector<List> others_;  // and of each of these
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
