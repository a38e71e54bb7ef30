// Finds components by ref and type, for conditions (demand.hpp).
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/conditions/demand.hpp"
#include "engine/conditions/filter.hpp"

namespace rois {

class RegisteredComponent;

// Whether the members of logical components are looked at, or only the logical ones.
enum class Members : std::uint8_t { hidden, shown };

// Iterates over several lists of components: ordered by ref, without duplicates. Invalid after a component was added or removed.
class ComponentsInOrder {
public:
    using List = std::span<RegisteredComponent* const>;  // ordered by ref

    ComponentsInOrder(Members members, List all) : members_{members}, first_{all} {}
    ComponentsInOrder(Members, std::vector<RegisteredComponent*> own, std::vector<List> others);
    ComponentsInOrder(ComponentsInOrder&&) noexcept = default;
    ComponentsInOrder& operator=(ComponentsInOrder&&) noexcept = default;

    // Returns null at the end.
    RegisteredComponent* next();
    // Returns the remaining components.
    std::vector<RegisteredComponent*> rest();

private:
    RegisteredComponent* next_of_all();

    Members members_;
    std::vector<RegisteredComponent*> own_;
    List first_;                // the rest of the single list, or of own_
    std::vector<List> others_;  // the rest of each further list
};

// Only conditions that name units see the members.
inline Members seen_by(Filter const& filter) { return filter.names_units() ? Members::shown : Members::hidden; }

class ComponentIndex {
public:
    // Adding a component twice has no effect.
    void add(RegisteredComponent&);
    void remove(RegisteredComponent const&);

    // Ordered by ref.
    std::vector<RegisteredComponent*> const& all() const { return all_; }

    // Returns the components that can meet the demand; all of them without a demand.
    ComponentsInOrder possible(std::optional<Demand> const&, Members) const;

private:
    std::vector<RegisteredComponent*> all_;
    std::map<std::string, std::vector<RegisteredComponent*>, std::less<>> by_type_;  // ordered by ref
};

}  // namespace rois
