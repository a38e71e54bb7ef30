// How long speech and reactions take (tables 32, 44 and 45; decisions 8 and 9).
#include <algorithm>

#include "conformance/observation.hpp"

namespace rois::conformance {

namespace {

constexpr auto some_words = "Good morning, and welcome to you.";
constexpr milliseconds clearly{20};  // the world of a simulation may be some times faster than the clock

std::string in_ms(milliseconds time) { return std::to_string(time.count()) + " ms"; }

Command speech(Component const& speaker, std::string const& text) {
    return {.component = speaker.ref, .arguments = {spoken(speaker, text)}};
}

Command first_reaction(Guest& guest, Component const& reaction) {
    auto const parameters = ok(guest.get_parameter(reaction.ref)).values("parameters");
    auto const reactions = parameters.find("available_reactions");
    if (reactions == parameters.end() || reactions->second.empty()) throw NotPlayed{reaction.ref + " has no reactions"};
    return {.component = reaction.ref, .arguments = {argument(reaction, "reaction_ref", {reactions->second.front()})}};
}

void longer_speech_takes_longer(Stage& stage) {
    auto const& speaker = stage.speaker();
    Guest guest{stage};
    guest.take(speaker);
    auto greeting = milliseconds::max(), sentence = milliseconds::max();
    // The shortest of several count, so that a delay on the way does not.
    for (int round = 1; round <= 2 || (round <= 5 && sentence <= greeting + clearly); ++round) {
        greeting = std::min(greeting, duration_of(guest, speech(speaker, "Hi."), speaker));
        sentence = std::min(sentence, duration_of(guest, speech(speaker, some_words), speaker));
    }
    require(sentence > greeting + clearly, "\"Hi.\" takes " + in_ms(greeting) + ", and a sentence of " +
                                               std::to_string(std::string{some_words}.size()) + " letters takes " +
                                               in_ms(sentence));
}

void speech_takes_time(Stage& stage) {
    auto const& speaker = stage.speaker();
    Guest guest{stage};
    guest.take(speaker);
    auto const at_once = shortest_duration(guest, speaker);
    auto const sentence = duration_of(guest, speech(speaker, some_words), speaker);
    require(sentence > at_once + clearly, "a sentence took " + in_ms(sentence) + ", and a stop takes " + in_ms(at_once));
}

void a_reaction_takes_time(Stage& stage) {
    auto const& reaction = stage.one_of({"reaction"});
    Guest guest{stage};
    guest.take(reaction);
    auto const start = first_reaction(guest, reaction);
    auto const at_once = shortest_duration(guest, reaction);
    auto const took = duration_of(guest, start, reaction);
    require(took > at_once + clearly, "a reaction was over within " + in_ms(took) + ", and a stop takes " + in_ms(at_once));
}

// Until it is resumed.
void require_held(Guest& guest, Component const& component, Command const& start) {
    auto const usual = duration_of(guest, start, component);
    auto const id = guest.order(start);
    auto const suspended = guest.ending(command(component, "suspend"));
    if (!guest.endings(id).empty()) throw NotObservable{component.ref + " was done before it could be suspended"};
    same("the status of suspend", "OK", suspended);
    wait(usual + usual / 2);
    while (guest.hear_now()) {
    }
    guest.state_of(id);  // over a WebSocket, notifications before this answer have been received
    while (guest.hear_now()) {
    }
    require(guest.endings(id).empty(), "start of " + component.ref + " completed while it was suspended");
    same("the state of a suspended command", "RUNNING", guest.state_of(id));
    same("the status of resume", "OK", guest.ending(command(component, "resume")));
    require_end(guest, id, component);
}

void suspended_speech_waits(Stage& stage) {
    auto const& speaker = stage.speaker();
    Guest guest{stage};
    guest.take(speaker);
    require_held(guest, speaker, speech(speaker, some_words));
}

void a_suspended_reaction_waits(Stage& stage) {
    auto const& reaction = stage.one_of({"reaction"});
    Guest guest{stage};
    guest.take(reaction);
    require_held(guest, reaction, first_reaction(guest, reaction));
}

void stop_ends_a_reaction(Stage& stage) {
    auto const& reaction = stage.one_of({"reaction"});
    Guest guest{stage};
    guest.take(reaction);
    auto const id = guest.order(first_reaction(guest, reaction));
    auto const stopped = guest.ending(command(reaction, "stop"));
    auto const endings = guest.endings(id);
    if (endings == std::vector<std::string>{"OK"}) throw NotObservable{"the reaction was over before it could be stopped"};
    same("the status of stop", "OK", stopped);
    guest.settle(reaction);
    require(guest.endings(id) == std::vector<std::string>{"ABORT"},
            "a reaction that was stopped should complete with ABORT, and did with " + list(guest.endings(id)));
}

}  // namespace

Clause action_clause() {
    return {"Effects: speech and reactions",
            {{"speech_takes_time", "table 44; decision 8", speech_takes_time},
             {"longer_speech_takes_longer", "table 44", longer_speech_takes_longer},
             {"suspended_speech_waits", "tables 32, 44; decision 9", suspended_speech_waits},
             {"a_reaction_takes_time", "table 45; decision 8", a_reaction_takes_time},
             {"a_suspended_reaction_waits", "tables 32, 45; decision 9", a_suspended_reaction_waits},
             {"stop_ends_a_reaction", "tables 8, 32, 45; decision 9", stop_ends_a_reaction}}};
}

}  // namespace rois::conformance
