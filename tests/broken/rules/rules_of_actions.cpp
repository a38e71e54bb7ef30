// Speech and reactions.
#include "broken/breaking.hpp"
#include "broken/commands.hpp"
#include "broken/rules.hpp"

namespace rois::broken {

std::vector<BrokenRule> rules_of_actions() {
    std::string const speech = "speech_synthesis", reaction = "reaction";
    std::vector<BrokenRule> rules{
        {"start of speech has the effect of stop", "speech_takes_time",
         [=] { return replaces_command(speech, "start", "stop"); }},
        {"speech completes before its end", "speech_takes_time", [=] { return completes_at_once(speech); }},
        {"speech completes long after its end", "an_action_completes_at_its_end", [=] { return completes_late(speech); }},
        {"speech ends after its first letters", "longer_speech_takes_longer",
         [=] {
             return edits_arguments(speech, "speech_text", [](Values values) { return Values{values.front().substr(0, 3)}; });
         }},
        {"speech continues while it is suspended", "suspended_speech_completes_after_resume",
         [=] { return pretends_to_suspend(speech); }},
        {"resume ends speech", "suspended_speech_completes_after_resume",
         [=] { return replaces_command(speech, "resume", "stop"); }},
        {"start of a reaction has the effect of stop", "a_reaction_takes_time",
         [=] { return replaces_command(reaction, "start", "stop"); }},
        {"a reaction completes before its end", "a_reaction_takes_time", [=] { return completes_at_once(reaction); }},
        {"a reaction completes long after its end", "a_reaction_takes_time", [=] { return completes_late(reaction); }},
        {"a reaction continues while it is suspended", "a_suspended_reaction_completes_after_resume",
         [=] { return pretends_to_suspend(reaction); }},
        {"a reaction continues after stop", "stop_ends_a_reaction",
         [=] { return replaces_command(reaction, "stop", "set_parameter"); }}};
    for (auto& rule : rules) rule.world = World::calm_hall;
    return rules;
}

}  // namespace rois::broken
