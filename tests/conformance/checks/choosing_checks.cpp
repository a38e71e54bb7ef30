// Logical components, which stand for components of several units (7.2; decision 44).
#include <algorithm>
#include <future>
#include <thread>

#include "conformance/context.hpp"

namespace rois::conformance {

namespace {

using Clock = std::chrono::steady_clock;

// A member is BUSY a little earlier: while it is asked whether it can carry out the command.
constexpr std::chrono::milliseconds until_it_has_begun{500};

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

Logical logical_speech(Context& context, Client& client) {
    auto const all = logical_components(context, client);
    auto const speech = std::ranges::find(all, "speechsynthesis", [](Logical const& each) { return each.component->basic(); });
    if (speech == all.end()) throw NotObservable{"no speech synthesis is logical"};
    if (!busy(client, speech->members).empty()) throw Skipped{"another application uses one of " + list(speech->members)};
    return *speech;
}

// Returns the members that act. One begins a little later than the logical component.
std::vector<std::string> acting_members(Context& context, Client& client, std::vector<std::string> const& members) {
    auto acting = busy(client, members);
    for (; acting.empty(); context.check_deadline()) acting = busy(client, members);
    return acting;
}

void at_most_one_member_acts(Context& context) {
    Client client{context};
    auto const [component, members] = logical_speech(context, client);
    client.bind_or_skip(*component);
    auto const id = client.execute_one(long_speech(*component, unique_name()));
    auto acting = acting_members(context, client, members);
    for (auto const end = Clock::now() + std::chrono::milliseconds{500}; acting.size() == 1 && Clock::now() < end;)
        acting = acting_members(context, client, members);  // a second one may begin later
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
    std::string code;
    for (auto const end = Clock::now() + context.patience(); code != "OUT_OF_RESOURCES" && Clock::now() < end;) {
        code = client.bind(component->ref).return_code();
        if (code == "OK") require_ok(client.release(component->ref));
    }
    require_equal("bind of " + component->ref + " while all its members are bound", "OUT_OF_RESOURCES", code);
}

// A long speech of a logical component. The member that performs it fails.
struct DisturbedSpeech {
    DisturbedSpeech(Context& where, std::string const& switching) : context{where}, client{where} {
        context.can_disturb();
        auto const [logical, all_members] = logical_speech(context, client);
        component = logical;
        members = all_members;
        await_two_members();
        client.bind_or_skip(*component);
        require_ok(client.ask("bind", kit::component_ref(component->ref), {{"switching", switching}}));
        id = client.execute_one(long_speech(*component, unique_name()));
        acting_members(context, client, members);
        std::this_thread::sleep_for(until_it_has_begun);
        failed = acting_members(context, client, members).front();
        disturbance = context.disturb(failed);
    }

    // A member that an earlier check has disturbed returns after a while.
    void await_two_members() {
        auto const is_ready = [&](std::string const& ref) { return client.component_status(ref) == "READY"; };
        for (auto const end = Clock::now() + context.patience(); std::ranges::count_if(members, is_ready) < 2;)
            if (Clock::now() > end) throw Skipped{"fewer than two of " + list(members) + " are READY"};
    }

    // Requires that one member acts, and that it is not the one that has failed. Returns its ref.
    std::string require_another(std::string const& when) {
        std::vector<std::string> acting;
        for (; acting.empty(); context.check_deadline()) {
            acting = busy(client, members);
            std::erase(acting, failed);
        }
        require(acting.size() == 1, when + ": expected one other member to be BUSY, got " + list(acting));
        return acting.front();
    }

    void stop() {
        require_equal("the status of stop of " + component->ref, "OK", client.run(command(*component, "stop")));
        client.flush_notifications(*component);
    }

    Context& context;
    Client client;
    Component const* component = nullptr;
    std::vector<std::string> members{};
    std::string id{};      // of the command
    std::string failed{};  // the member
    std::future<int> disturbance{};
};

void a_command_goes_on_with_another_member(Context& context) {
    DisturbedSpeech speech{context, "restart"};
    auto& client = speech.client;
    auto received = client.receive();
    while (received.name() != "switched") {
        require(client.completion_statuses(speech.id).empty(),
                "expected `switched` after " + speech.failed + " has failed, got " + received.whole());
        received = client.receive();
    }
    require_equal("component_ref of `switched`", speech.component->ref, received.ref());
    require_equal("`from` of `switched`", speech.failed, received.text("from"));
    require_equal("`to` of `switched`", speech.require_another("after `switched`"), received.text("to"));
    speech.stop();
    require(client.completion_statuses(speech.id) == std::vector<std::string>{"ABORT"},
            "expected one `completed` of start, with ABORT because of stop, got " + list(client.completion_statuses(speech.id)));
}

void a_command_aborts_with_its_member(Context& context) {
    DisturbedSpeech speech{context, "abort"};
    auto& client = speech.client;
    require_equal("the status of start after " + speech.failed + " has failed", "ABORT", client.status_of(speech.id));
    client.execute_one(long_speech(*speech.component, unique_name()));
    speech.require_another("after a new start");
    speech.stop();
    require(client.completion_statuses(speech.id).size() == 1, "expected one `completed` of start");
}

}  // namespace

Clause choosing_clause() {
    return {"7.2 HRI engine: choosing and switching",
            {{"bind_accepts_switching", "decision 44", bind_accepts_switching},
             {"a_session_may_ask_for_all_switches", "decision 44", a_session_may_ask_for_all_switches},
             {"members_are_seen_by_those_who_ask_for_units", "7.2; decision 44", members_are_seen_by_those_who_ask_for_units},
             {"at_most_one_member_acts", "7.2; decision 44", at_most_one_member_acts},
             {"a_logical_component_cannot_be_bound_without_free_members", "7.2; decision 44",
              a_logical_component_cannot_be_bound_without_free_members},
             {"a_command_goes_on_with_another_member", "7.2; decision 44", a_command_goes_on_with_another_member},
             {"a_command_aborts_with_its_member", "7.2; decision 44", a_command_aborts_with_its_member}}};
}

}  // namespace rois::conformance
