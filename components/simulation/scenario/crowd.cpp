#include "simulation/scenario/crowd.hpp"

#include <array>

namespace rois::simulation {
namespace {

// Phrases of strangers by language.
struct Phrases {
    std::string_view language;
    std::array<std::string_view, 3> greetings;
    std::array<std::string_view, 3> answers;
};
constexpr std::array<Phrases, 3> phrases{{
    {"en",
     {"Hello. Is anybody here?", "Good morning. I have an appointment.", "Excuse me, where is the exhibition?"},
     {"Thank you very much.", "Yes, please.", "I see. Thanks."}},
    {"ja",
     {"こんにちは。", "すみません、受付はこちらですか。", "おはようございます。"},
     {"ありがとうございます。", "はい、お願いします。", "わかりました。"}},
    {"de",
     {"Guten Tag.", "Entschuldigung, ist hier der Empfang?", "Hallo, ich bin verabredet."},
     {"Vielen Dank.", "Ja, bitte.", "Alles klar, danke."}},
}};

template <class Choices>
auto const& one_of(Choices const& choices, Random& random) {
    return choices[random.below(choices.size())];
}

}  // namespace

Crowd::Crowd(Scenario scenario, FloorPlan const& plan, std::uint64_t seed) : scenario_(std::move(scenario)), random_(seed) {
    for (RobotPlan const& robot : plan.robots)
        if (!robot.fixed) robots_.push_back(robot.name);
    for (Role const& role : scenario_.roles) next_entry_.emplace_back(role.enters);
    if (scenario_.arrivals) next_arrival_ = random_.uniform(scenario_.arrivals->gap_least, scenario_.arrivals->gap_most);
}

std::optional<Role> Crowd::next(WorldTime now, std::size_t inside, std::function<bool(std::string_view)> const& is_inside) {
    Seconds const time = in_seconds(now);
    for (std::size_t i = 0; i < scenario_.roles.size(); ++i) {
        Role const& role = scenario_.roles[i];
        auto& entry = next_entry_[i];
        if (!entry || time < *entry || is_inside(role.id)) continue;
        if (!scenario_.round) {
            entry.reset();
        } else {
            while (*entry <= time) *entry += *scenario_.round;
        }
        return role;
    }
    if (!scenario_.arrivals || time < next_arrival_ || inside >= scenario_.arrivals->at_most) return std::nullopt;
    next_arrival_ = time + random_.uniform(scenario_.arrivals->gap_least, scenario_.arrivals->gap_most);
    return stranger();
}

// A visitor who goes to the desk or a robot, says a request, waits for an answer, looks around and leaves.
Role Crowd::stranger() {
    Phrases const& spoken = one_of(phrases, random_);
    std::string const language{spoken.language};
    std::string const& robot = one_of(robots_, random_);
    Role role;
    role.id = "stranger-" + std::to_string(++strangers_);
    role.language = language;
    role.height = random_.uniform(1.5, 1.9);
    role.speed = random_.uniform(0.8, 1.3);
    role.answers.push_back({"*", "", language, std::string{one_of(spoken.answers, random_)}, "nod", false});
    role.answers.push_back({"", "9", "", "", "bow", true});
    if (random_.chance(0.15)) role.actions.push_back({Ignore{}, {}});
    if (random_.chance(0.4)) role.actions.push_back({Wander{random_.uniform(5, 20)}, {}});
    role.actions.push_back({Walk{{random_.chance(0.65) ? std::string{"desk"} : robot}}, {}});
    if (random_.chance(0.85)) role.actions.push_back({Face{{robot}}, {}});
    if (random_.chance(0.5)) role.actions.push_back({Gesture{"wave"}, {}});
    role.actions.push_back({Say{language, std::string{one_of(spoken.greetings, random_)}}, {}});
    role.actions.push_back({Wait{random_.uniform(45, 90)}, {}});
    if (random_.chance(0.3)) role.actions.push_back({Wander{random_.uniform(10, 25)}, {}});
    role.actions.push_back({Leave{}, {}});
    return role;
}

}  // namespace rois::simulation
