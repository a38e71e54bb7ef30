// Logical components, which stand for components of several units (7.2; decision 44).
#include <algorithm>

#include "conformance/context.hpp"

namespace rois::conformance {

namespace {

// The components of units with the same name: "robot1.navigation" for "navigation". They are seen only by those who ask for
// units.
std::vector<std::string> members_of(Client& client, Component const& component) {
    auto members =
        client.search(kit::where(kit::both(kit::like("component_ref", "*." + component.ref), kit::like("engine", "*"))));
    auto const all = client.search();
    std::erase_if(members, [&](std::string const& ref) {
        return !ref.ends_with("." + component.ref) || std::ranges::find(all, ref) != all.end();
    });
    return members;
}

struct Logical {
    Component const* component;
    std::vector<std::string> members;
};

// Throws Skipped if the gateway has none.
std::vector<Logical> logical_components(Context& context, Client& client) {
    std::vector<Logical> found;
    for (auto const& component : context.catalogue().components) {
        auto members = members_of(client, component);
        if (!members.empty()) found.push_back({&component, std::move(members)});
    }
    if (found.empty()) throw Skipped{"the gateway has no logical components"};
    return found;
}

std::vector<std::string> busy(Client& client, std::vector<std::string> const& refs) {
    std::vector<std::string> busy;
    for (auto const& ref : refs)
        if (client.component_status(ref) == "BUSY") busy.push_back(ref);
    return busy;
}

// The times of the specification's own messages are short; a member of another engine may need some.
void wait_until_free(Context& context, Client& client, std::vector<std::string> const& refs) {
    while (!busy(client, refs).empty()) context.check_deadline();
}

void bind_accepts_switching(Context& context) {
    auto const& component = *context.two_common_components().first;
    Client client{context};
    client.bind_or_skip(component);
    auto const ref = kit::component_ref(component.ref);
    for (auto const* switching : {"abort", "restart", "none"}) require_ok(client.ask("bind", ref, {{"switching", switching}}));
    require_fault(client.ask("bind", ref, {{"switching", unknown_name}}), "invalid");
}

void a_session_may_ask_for_all_switches(Context& context) {
    Client client{context, Client::Initially::disconnected};
    require_ok(client.ask("connect", {}, {{"switches", "true"}}));
}

void members_are_seen_by_those_who_ask_for_units(Context& context) {
    Client client{context};
    for (auto const& [component, members] : logical_components(context, client)) {
        auto const of_type = client.search(kit::where(kit::equal("component_type", component->type)));
        require(std::ranges::find(of_type, component->ref) != of_type.end(),
                "search for component_type = " + component->type + ": expected " + component->ref + ", got " + list(of_type));
        for (auto const& member : members) {
            require(std::ranges::find(of_type, member) == of_type.end(),
                    "search for component_type = " + component->type + " returned " + member + ", a member of " + component->ref);
            auto const by_ref = client.search(kit::where(kit::equal("component_ref", member)));
            require(by_ref == std::vector{member}, "search for component_ref = " + member + ": got " + list(by_ref));
        }
    }
}

void at_most_one_member_acts(Context& context) {
    Client client{context};
    auto const all = logical_components(context, client);
    auto const speech = std::ranges::find(all, "speechsynthesis", [](Logical const& each) { return each.component->basic(); });
    if (speech == all.end()) throw NotObservable{"no speech synthesis is logical"};
    auto const& [component, members] = *speech;
    if (!busy(client, members).empty()) throw Skipped{"another application uses one of " + list(members)};
    client.bind_or_skip(*component);
    auto const id = client.execute_one(long_speech(*component, unique_name()));
    auto acting = busy(client, members);
    for (; acting.empty(); context.check_deadline()) acting = busy(client, members);  // a member begins a little later
    require(acting.size() == 1, "while " + component->ref + " acts, expected one of its members to be BUSY, got " + list(acting));
    require_equal("the status of stop of " + component->ref, "OK", client.run(command(*component, "stop")));
    client.flush_notifications(*component);
    require(client.completion_statuses(id).size() == 1, "expected one `completed` of start of " + component->ref);
    require_ok(client.release(component->ref));
    wait_until_free(context, client, members);
}

void a_logical_component_cannot_be_bound_without_free_members(Context& context) {
    Client holder{context}, client{context};
    auto const [component, members] = logical_components(context, client).front();
    for (auto const& member : members)
        if (holder.bind(member).return_code() != "OK") throw Skipped{"another application uses " + member};
    // The engine may notice a little later that the members are not free.
    for (;;) {
        auto const code = client.bind(component->ref).return_code();
        if (code == "OUT_OF_RESOURCES") return;
        if (code == "OK") require_ok(client.release(component->ref));
        context.check_deadline();
    }
}

}  // namespace

Clause choosing_clause() {
    return {"7.2 HRI engine: choosing and switching",
            {{"bind_accepts_switching", "decision 44", bind_accepts_switching},
             {"a_session_may_ask_for_all_switches", "decision 44", a_session_may_ask_for_all_switches},
             {"members_are_seen_by_those_who_ask_for_units", "7.2; decision 44", members_are_seen_by_those_who_ask_for_units},
             {"at_most_one_member_acts", "7.2; decision 44", at_most_one_member_acts},
             {"a_logical_component_cannot_be_bound_without_free_members", "7.2; decision 44",
              a_logical_component_cannot_be_bound_without_free_members}}};
}

}  // namespace rois::conformance
