// Figure 1 of the specification: waits for visitors, drives to each, says their message or asks and listens, bows and returns.
// Usage: reception [VISITORS]. ROIS_URL is the address of the gateway.
#include <algorithm>
#include <cstdio>
#include <regex>
#include <rois/client.hpp>
#include <set>

using namespace rois;
using namespace std::chrono_literals;

std::string message_for(std::string const& visitor) {
    if (visitor.empty()) return "Welcome. How can I help you?";
    if (visitor == "tanaka") return "Mr. Tanaka, your meeting is in room 3.";
    if (visitor == "suzuki") return "Ms. Suzuki, your taxi is waiting at the entrance.";
    return "Welcome. There is no message for you today.";
}

// Returns the people in sight.
Task<std::vector<Sighting>> look(PersonLocalization localization) {
    auto localized = co_await localization.person_localized();
    co_await localization.start();
    auto const seen = co_await localized.next(3s);
    co_await localization.stop();
    co_return seen ? seen->people : std::vector<Sighting>{};
}

// Drives to a person who stands still and is not in `met`. Returns their name, or an empty text if the robot reached none.
Task<std::string> approach(Client& robot, PersonLocalization localization, Navigation navigation, std::set<std::string> met) {
    auto const earlier = co_await look(localization);
    co_await robot.sleep(1s);
    auto const now = co_await look(localization);
    for (auto const& [ref, pose] : now) {
        auto const was = std::ranges::find(earlier, ref.code, [](Sighting const& each) { return each.ref.code; });
        if (met.contains(ref.code) || was == earlier.end() || distance(was->pose, pose) > 300_mm) continue;
        for (auto const turn : {0_deg, 60_deg, -60_deg, 120_deg, -120_deg}) {
            auto const status = co_await navigation.go_to(before(pose, 1_m, turn), 90s);
            if (status == CompletedStatus::ok) co_return ref.code;
        }
    }
    co_return "";
}

Task<> receive(Client& robot, int visitors) {
    auto const detection = co_await robot.bind_any<PersonDetection>();
    auto const localization = co_await robot.bind_any<PersonLocalization>();
    auto const identification = co_await robot.bind_any<PersonIdentification>();
    auto const recognition = co_await robot.bind_any<SpeechRecognition>();
    auto const synthesis = co_await robot.bind_any<SpeechSynthesis>();
    auto const reaction = co_await robot.bind_any<Reaction>();
    auto const navigation = co_await robot.bind_any<Navigation>();
    auto detected = co_await detection.person_detected(conditions::result("number") > 0);
    auto identified = co_await identification.person_identified();
    auto recognized = co_await recognition.speech_recognized();
    auto const start = (co_await SystemInformation{robot.component("system_information")}.robot_position()).robots.at(0).pose;
    std::set<std::string> met;  // temporary names and permanent ids of the visitors received so far
    for (int count = 0; count < visitors;) {
        co_await navigation.go_to(start);
        detected.skip();
        co_await detection.start();
        co_await detected.next();
        co_await detection.stop();
        auto const person = co_await approach(robot, localization, navigation, met);
        if (person.empty()) continue;
        met.insert(person);
        co_await identification.start();
        auto const identity = co_await identified.next(8s);
        co_await identification.stop();
        std::string const visitor = identity && !identity->people.empty() ? identity->people.front().code : "";
        if (!visitor.empty() && !met.insert(visitor).second) continue;
        auto const message = message_for(visitor);
        std::string line = (visitor.empty() ? "somebody" : visitor) + ": told \"" + message + "\"";
        if (visitor.empty()) co_await recognition.start();
        co_await synthesis.say(message);
        if (visitor.empty()) {
            auto const answer = co_await recognized.next(10s);
            co_await recognition.stop();
            if (answer) line += ", heard \"" + answer->recognized_text.at(0) + "\"";
            if (answer) co_await synthesis.say("I shall tell my colleagues at the desk.");
        }
        co_await reaction.react("9");
        co_await synthesis.say("Goodbye.");
        std::puts(line.c_str());
        ++count;
    }
    co_await navigation.go_to(start);
    std::printf("visitors received: %d\n", visitors);
}

int main(int argc, char** argv) try {
    std::string const visitors = argc > 1 ? argv[1] : "1";
    if (!std::regex_match(visitors, std::regex{"[1-9][0-9]{0,5}"}))
        throw Error{ReturnCode::bad_parameter, "VISITORS is a whole number, 1 to 999999, not '" + visitors + "'"};
    Client robot{{}, {.attempt_failed = [](auto const& one) { std::fprintf(stderr, "reception: %s\n", one.reason.c_str()); }}};
    robot.wait(receive(robot, std::stoi(visitors)));
} catch (std::exception const& problem) {
    std::fprintf(stderr, "reception: %s\n", problem.what());
    return 1;
}
