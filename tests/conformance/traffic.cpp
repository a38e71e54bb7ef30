#include "conformance/traffic.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "conformance/point.hpp"
#include "files/files.hpp"

namespace rois::conformance {

namespace {

std::shared_ptr<xml::Schemas const> schemas() {
    auto const& files = files::schemas();
    return std::make_shared<xml::Schemas const>(xml::NamedFiles{files.begin(), files.end()});
}

// Returns whether the element has this position. Texts may be rounded to whole millimetres and degrees.
bool matches(pugi::xml_node located, Point const& point) {
    constexpr double rounded = 1;
    std::istringstream position{located.child("position").text().get()}, orientation{located.child("orientation").text().get()};
    double x = 0, y = 0, roll = 0, pitch = 0, yaw = 0;
    if (!(position >> x >> y) || std::abs(x - point.x) > rounded || std::abs(y - point.y) > rounded) return false;
    if (!point.heading || !(orientation >> roll >> pitch >> yaw)) return true;
    return std::abs(std::remainder(yaw - *point.heading, 360)) <= rounded;
}

std::string written(pugi::xml_node node) {
    std::ostringstream text;
    node.print(text, "", pugi::format_raw);
    return text.str();
}

}  // namespace

Traffic::Traffic()
    : rules_{{"documents_are_valid", "docs/clients.md; schemas"},
             {"answers_match_their_requests", "docs/clients.md"},
             {"refusals_have_a_reason", "table 1; docs/clients.md"},
             {"notification_sequences_have_no_gaps", "decision 22"},
             {"an_answer_precedes_its_notifications", "figures 9, 10; decision 22"},
             {"commands_complete_once", "figure 10; decision 12"},
             {"events_match_their_subscriptions", "figure 13; table 6"},
             {"event_ids_are_unique", "table 6; decisions 20, 21"},
             {"events_expire_in_the_future", "table 6; decision 21"},
             {"located_elements_match_their_texts", "decision 27; docs/frames.md"},
             {"times_are_utc", "table 6; decision 28"},
             {"no_notification_is_sent_without_a_session", "figure 6; decision 3"},
             {"errors_have_details", "figure 7; tables 6, 7; decision 24"}},
      validator_{schemas()} {}

void Traffic::check(std::string const& name, bool holds, std::string const& message) {
    auto const rule = std::ranges::find(rules_, name, &MessageRule::name);
    if (rule == rules_.end()) throw std::logic_error{"unknown rule '" + name + "'"};
    ++rule->occasions;
    if (!holds && rule->violation.empty()) rule->violation = message;
}

void Traffic::check_located(pugi::xml_node results) {
    for (auto const result : results.children("result")) {
        std::string_view const frame = result.child("rois:data_type_ref").attribute("rois:codebook_ref").value();
        std::vector<pugi::xml_node> located;
        for (auto const one : results.children("located"))
            if (std::string_view{one.attribute("of").value()} == result.attribute("rois:name").value() &&
                one.attribute("crs").value() == frame)
                located.push_back(one);
        if (located.empty()) continue;
        for (auto const value : result.children("rois:value")) {
            auto const point = point_in(value.text().get());
            if (!point) continue;  // the name of a place
            auto const fits = [&](auto const one) { return matches(one, *point); };
            check("located_elements_match_their_texts", std::ranges::any_of(located, fits),
                  std::string{"expected an element `located` with the position \""} + value.text().get() + "\", got " +
                      written(results));
        }
    }
}

void Traffic::validate(std::string const& document) {
    auto const objection = validator_.objection_to(document);
    check("documents_are_valid", !objection, objection ? objection->text + ": " + document : "");
}

}  // namespace rois::conformance
