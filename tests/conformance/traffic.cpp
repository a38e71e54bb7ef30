#include "conformance/traffic.hpp"

#include <algorithm>
#include <stdexcept>

#include "files/files.hpp"

namespace rois::conformance {

namespace {

std::shared_ptr<xml::Schemas const> schemas() {
    auto const& files = files::schemas();
    return std::make_shared<xml::Schemas const>(xml::NamedFiles{files.begin(), files.end()});
}

}  // namespace

Traffic::Traffic()
    : rules_{{"documents_are_valid", "wire.md; schemas"},
             {"answers_belong_to_their_requests", "wire.md: names, request_id"},
             {"refusals_give_a_reason", "table 1; wire.md"},
             {"notifications_are_counted_without_gaps", "decision 22"},
             {"answers_come_before_what_they_cause", "figures 9, 10; decision 22"},
             {"commands_complete_once", "figure 10; decision 12"},
             {"events_are_those_that_were_subscribed", "figure 13; table 6"},
             {"an_event_id_names_one_event", "table 6; decisions 20, 21"},
             {"events_expire_in_the_future", "table 6; decision 21"},
             {"times_are_utc", "table 6; decision 28"},
             {"nothing_is_sent_outside_of_a_session", "figure 6; decision 3"},
             {"errors_have_details", "figure 7; tables 6, 7; decision 24"}},
      validator_{schemas()} {}

void Traffic::see(std::string const& name, bool holds, std::string const& otherwise) {
    auto const rule = std::ranges::find(rules_, name, &StandingRule::name);
    if (rule == rules_.end()) throw std::logic_error{"no rule " + name};
    ++rule->seen;
    if (!holds && rule->objection.empty()) rule->objection = otherwise;
}

void Traffic::validate(std::string const& document) {
    auto const objection = validator_.objection_to(document);
    see("documents_are_valid", !objection, objection ? objection->text + ": " + document : "");
}

}  // namespace rois::conformance
