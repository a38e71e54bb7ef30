// The duration of speech and reactions (tables 32, 44 and 45; decisions 8 and 9).
#include <algorithm>

#include "conformance/observation.hpp"

namespace rois::conformance {

namespace {

constexpr auto sentence_text = "Good morning, and welcome to you.";
constexpr milliseconds margin{20};  // short, because a simulation may run faster than real time

std::string in_ms(milliseconds time) { return std::to_string(time.count()) + " ms"; }

Command speech(Component const& speaker, std::string const& text) {
    return {.component = speaker.ref, .arguments = {speech_argument(speaker, text)}};
}

Command first_reaction(Client& client, Component const& reaction) {
    auto const parameters = require_ok(client.get_parameter(reaction.ref)).values("parameters");
    auto const reactions = parameters.find("available_reactions");
    if (reactions == parameters.end() || reactions->second.empty()) throw Skipped{reaction.ref + " has no available_reactions"};
    return {.component = reaction.ref, .arguments = {argument(reaction, "reaction_ref", {reactions->second.front()})}};
}

void longer_speech_takes_longer(Context& context) {
    auto const& speaker = context.speaker();
    Client client{context};
    client.bind_or_skip(speaker);
    auto greeting = milliseconds::max(), sentence = milliseconds::max();
    // Compares the shortest of several durations, so that transmission delays have no effect.
    for (int round = 1; round <= 3 || (round <= 5 && sentence <= greeting + margin); ++round) {
        greeting = std::min(greeting, duration_of(client, speech(speaker, "Hi."), speaker));
        sentence = std::min(sentence, duration_of(client, speech(speaker, sentence_text), speaker));
    }
    require(sentence > greeting + margin, "expected a sentence of " + std::to_string(std::string{sentence_text}.size()) +
                                              " letters to take longer than \"Hi.\" (" + in_ms(greeting) + "), took " +
                                              in_ms(sentence));
}

void speech_takes_time(Context& context) {
    auto const& speaker = context.speaker();
    Client client{context};
    client.bind_or_skip(speaker);
    auto const shortest = shortest_duration(client, command(speaker, "stop"), speaker);
    auto const sentence = shortest_duration(client, speech(speaker, sentence_text), speaker);
    require(sentence > shortest + margin,
            "expected a sentence to take longer than stop (" + in_ms(shortest) + "), took " + in_ms(sentence));
}

void a_reaction_takes_time(Context& context) {
    auto const& reaction = context.component_of_kind({"reaction"});
    Client client{context};
    client.bind_or_skip(reaction);
    auto const shortest = shortest_duration(client, command(reaction, "stop"), reaction);
    auto const took = shortest_duration(client, first_reaction(client, reaction), reaction);
    require(took > shortest + margin,
            "expected a reaction to take longer than stop (" + in_ms(shortest) + "), took " + in_ms(took));
}

// Requires that `start` does not complete while it is suspended, and completes with OK after `resume`.
void require_suspended(Client& client, Component const& component, Command const& start) {
    auto const usual = duration_of(client, start, component);
    auto const id = client.execute_one(start);
    auto const suspended = client.run(command(component, "suspend"));
    if (!client.completion_statuses(id).empty()) throw NotObservable{"start of " + component.ref + " completed before suspend"};
    require_equal("the status of suspend", "OK", suspended);
    wait(usual + usual / 2);
    while (client.receive_now()) {
    }
    client.command_state(id);  // over a WebSocket, notifications before this answer have been received
    while (client.receive_now()) {
    }
    require(client.completion_statuses(id).empty(), "start of " + component.ref + " completed while it was suspended");
    require_equal("the state of a suspended command", "RUNNING", client.command_state(id));
    require_equal("the status of resume", "OK", client.run(command(component, "resume")));
    await_success(client, id, component);
}

void suspended_speech_completes_after_resume(Context& context) {
    auto const& speaker = context.speaker();
    Client client{context};
    client.bind_or_skip(speaker);
    require_suspended(client, speaker, speech(speaker, sentence_text));
}

void a_suspended_reaction_completes_after_resume(Context& context) {
    auto const& reaction = context.component_of_kind({"reaction"});
    Client client{context};
    client.bind_or_skip(reaction);
    require_suspended(client, reaction, first_reaction(client, reaction));
}

void stop_ends_a_reaction(Context& context) {
    auto const& reaction = context.component_of_kind({"reaction"});
    Client client{context};
    client.bind_or_skip(reaction);
    auto const id = client.execute_one(first_reaction(client, reaction));
    auto const stopped = client.run(command(reaction, "stop"));
    auto const completion_statuses = client.completion_statuses(id);
    if (completion_statuses == std::vector<std::string>{"OK"}) throw NotObservable{"the reaction completed before stop"};
    require_equal("the status of stop", "OK", stopped);
    client.flush_notifications(reaction);
    require(client.completion_statuses(id) == std::vector<std::string>{"ABORT"},
            "expected a stopped reaction to complete once with ABORT, got " + list(client.completion_statuses(id)));
}

}  // namespace

Clause action_clause() {
    return {"Effects: speech and reactions",
            {{"speech_takes_time", "table 44; decision 8", speech_takes_time},
             {"longer_speech_takes_longer", "table 44", longer_speech_takes_longer},
             {"suspended_speech_completes_after_resume", "tables 32, 44; decision 9", suspended_speech_completes_after_resume},
             {"a_reaction_takes_time", "table 45; decision 8", a_reaction_takes_time},
             {"a_suspended_reaction_completes_after_resume", "tables 32, 45; decision 9",
              a_suspended_reaction_completes_after_resume},
             {"stop_ends_a_reaction", "tables 8, 32, 45; decision 9", stop_ends_a_reaction}}};
}

}  // namespace rois::conformance
