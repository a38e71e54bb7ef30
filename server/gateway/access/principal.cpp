#include "gateway/access/principal.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <variant>

#include "types/text/listing.hpp"

namespace rois {

namespace {

constexpr std::array<std::pair<std::string_view, Role>, 4> roles{{{"observer", Role::observer},
                                                                  {"operator", Role::operator_},
                                                                  {"engine", Role::engine},
                                                                  {"administrator", Role::administrator}}};

template <class... Observed>
bool is_one_of(Operation const& operation) {
    return (std::holds_alternative<Observed>(operation) || ...);
}

}  // namespace

std::string_view to_text(Role role) {
    auto const found = std::ranges::find(roles, role, &std::pair<std::string_view, Role>::second);
    return found == roles.end() ? "nobody" : found->first;
}

std::optional<Role> read_role(std::string_view text) {
    auto const found = std::ranges::find(roles, text, &std::pair<std::string_view, Role>::first);
    return found == roles.end() ? std::nullopt : std::optional{found->second};
}

std::string const& names_of_roles() {
    static std::string const names = listed(roles, &std::pair<std::string_view, Role>::first);
    return names;
}

Role least_role_for(Operation const& operation) {
    if (auto const* connect = std::get_if<Connect>(&operation)) return connect->is_engine ? Role::engine : Role::observer;
    if (auto const* bind = std::get_if<Bind>(&operation)) return bind->take_over ? Role::administrator : Role::operator_;
    bool const observes =
        is_one_of<Resume, Disconnect, GetProfile, GetErrorDetail, Search, Query, Subscribe, Unsubscribe, GetEventDetail>(
            operation);
    return observes ? Role::observer : Role::operator_;
}

Fault not_allowed_for(Role role, Role least) {
    return {FaultCode::not_allowed,
            "the token has the role " + std::string{to_text(role)} + ": expected at least " + std::string{to_text(least)}};
}

Fault only_for_all() {
    return {FaultCode::not_allowed, "the stop is for all components: expected a token that may see all of them"};
}

std::shared_ptr<Principal const> Principal::nobody() {
    static auto const made = [] {
        auto principal = std::make_shared<Principal>();
        principal->rights = std::make_shared<Rights const>("", std::vector<std::string>{}, std::vector<std::string>{});
        return principal;
    }();
    return made;
}

std::vector<std::string> seen_by(Principal const* principal, std::vector<std::string> refs) {
    if (principal != nullptr) std::erase_if(refs, [&](std::string const& ref) { return !principal->rights->sees(ref); });
    return refs;
}

}  // namespace rois
