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
#include "engine/rights.hpp"
#include "engine/session.hpp"

namespace rois {

class RegisteredComponent;

// Whether all members of logical components are looked at, or only those whose refs are demanded.
enum class Members : std::uint8_t { hidden, shown };

// The components that exist for a client, or that it may command.
struct View {
    Members members = Members::hidden;
    Rights const* rights = nullptr;
    enum class Of : std::uint8_t { seen, commanded } of = Of::seen;

    bool shows(std::string const& ref) const { return of == Of::seen ? may_see(rights, ref) : may_command(rights, ref); }
};

// Iterates over several lists of components: ordered by ref, without duplicates. Invalid after a component was added or removed.
class ComponentsInOrder {
public:
    using List = std::span<RegisteredComponent* const>;  // ordered by ref

    ComponentsInOrder(View view, List all) : view_{view}, first_{all} {}
    ComponentsInOrder(View, std::vector<RegisteredComponent*> own, std::vector<List> others);
    ComponentsInOrder(ComponentsInOrder&&) noexcept = default;
    ComponentsInOrder& operator=(ComponentsInOrder&&) noexcept = default;

    // Returns null at the end.
    RegisteredComponent* next();
    // Returns the remaining components.
    std::vector<RegisteredComponent*> rest();

private:
    View view_;
    std::vector<RegisteredComponent*> own_;  // with demanded refs
    List first_;                             // the rest of the single list, or of own_
    std::vector<List> others_;               // the rest of each further list
};

inline Members members_for(Filter const& filter) { return filter.names_units() ? Members::shown : Members::hidden; }
inline View seen_by(Session const& asker, Filter const& filter) { return {members_for(filter), asker.rights.get()}; }
inline View commanded_by(Session const& asker, Filter const& filter) {
    return {members_for(filter), asker.rights.get(), View::Of::commanded};
}

class ComponentIndex {
public:
    // Adding a component twice has no effect.
    void add(RegisteredComponent&);
    void remove(RegisteredComponent const&);

    // Ordered by ref.
    std::vector<RegisteredComponent*> const& all() const { return all_; }

    // Returns the components that can meet the demand; all of them without a demand.
    ComponentsInOrder possible(std::optional<Demand> const&, View) const;

private:
    std::vector<RegisteredComponent*> all_;
    std::map<std::string, std::vector<RegisteredComponent*>, std::less<>> by_type_;  // ordered by ref
};

}  // namespace rois
