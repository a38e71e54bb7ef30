// Speech and reactions.
#include "broken/breaking.hpp"
#include "broken/commands.hpp"
#include "broken/rules.hpp"

namespace rois::broken {

std::vector<BrokenRule> rules_of_actions() {
    std::string const speech = "speech_synthesis", reaction = "reaction";
    std::vector<BrokenRule> rules{
        {"start of speech is a stop", "speech_takes_time", [=] { return replaces_command(speech, "start", "stop"); }},
        {"speech completes before it is over", "speech_takes_time", [=] { return completes_at_once(speech); }},
        {"speech completes long after it is over", "an_action_completes_at_its_end", [=] { return completes_late(speech); }},
        {"speech ends after its first letters", "longer_speech_takes_longer",
         [=] {
             return edits_arguments(speech, "speech_text", [](Values values) { return Values{values.front().substr(0, 3)}; });
         }},
        {"speech goes on while it is suspended", "suspended_speech_waits", [=] { return pretends_to_suspend(speech); }},
        {"speech is over with resume", "suspended_speech_waits", [=] { return replaces_command(speech, "resume", "stop"); }},
        {"start of a reaction is a stop", "a_reaction_takes_time", [=] { return replaces_command(reaction, "start", "stop"); }},
        {"a reaction completes before it is over", "a_reaction_takes_time", [=] { return completes_at_once(reaction); }},
        {"a reaction completes long after it is over", "a_reaction_takes_time", [=] { return completes_late(reaction); }},
        {"a reaction goes on while it is suspended", "a_suspended_reaction_waits", [=] { return pretends_to_suspend(reaction); }},
        {"a reaction goes on after stop", "stop_ends_a_reaction",
         [=] { return replaces_command(reaction, "stop", "set_parameter"); }}};
    for (auto& rule : rules) rule.world = World::calm_hall;
    return rules;
}

}  // namespace rois::broken
