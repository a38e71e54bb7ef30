// Greets a visitor with only the C++ PSM of the specification (section 7.7): waits for a person, drives up to them, welcomes them
// and bows. ROIS_URL is the address of the gateway.
// NOLINTBEGIN(modernize-use-override): the published functions are not virtual
#include <chrono>
#include <condition_variable>
#include <iostream>
#include <map>
#include <mutex>
#include <sstream>
#include <string>
#include <vector>

#include "RoIS_Navigation.hpp"
#include "RoIS_Person_Localization.hpp"
#include "RoIS_Reaction.hpp"
#include "RoIS_Speech_Synthesis.hpp"

std::mutex mutex;
std::condition_variable news;

// Remembers how commands ended, by the component and command in their ids: "navigation.start.7".
struct Application : RoIS_Service::ServiceApplicationBase {
    void completed(std::string command_id, RoIS_Service::Completed_Status status) {
        std::lock_guard<std::mutex> lock(mutex);
        ended[command_id.substr(0, command_id.rfind('.'))] = status;
        news.notify_all();
    }
    bool succeeds(RoIS_HRI::ReturnCode_t accepted, std::string const& command) {
        std::unique_lock<std::mutex> lock(mutex);
        auto has_ended = [&] { return ended.contains(command); };
        bool in_time = accepted == RoIS_HRI::OK && news.wait_for(lock, std::chrono::minutes(2), has_ended);
        bool good = in_time && ended[command] == RoIS_Service::OK;
        ended.erase(command);
        return good;
    }
    std::map<std::string, RoIS_Service::Completed_Status> ended;
};

// Keeps the latest position of the first visitor in sight: "x, y, th" in mm and degrees.
struct Visitors : Person_Localization::Event {
    void person_localized(RoIS_HRI::DateTime, RoIS_HRI::RoIS_IdentifierList, std::vector<RoLo::Architecture::Data> positions) {
        std::lock_guard<std::mutex> lock(mutex);
        if (!positions.empty()) position = positions.front();
        news.notify_all();
    }
    std::string wait() {
        std::unique_lock<std::mutex> lock(mutex);
        news.wait_for(lock, std::chrono::minutes(2), [&] { return !position.empty(); });
        return position;
    }
    std::string position;
};

int main() {
    Application application;
    Visitors visitors;
    RoIS_HRI::SystemIF system;
    Person_Localization::Command localization;
    Navigation::Command navigation;
    Speech_Synthesis::Command synthesis;
    Reaction::Command reaction;
    bool greeted = false;
    bool ready = system.connect() == RoIS_HRI::OK && localization.start() == RoIS_HRI::OK;
    for (int attempt = 0; ready && !greeted && attempt < 3; ++attempt) {  // the visitor may walk away meanwhile
        double x = 0, y = 0;
        char comma = 0;
        std::istringstream(visitors.wait()) >> x >> comma >> y;
        std::ostringstream before_the_visitor;
        before_the_visitor << x - 1000 << ", " << y << ", 0";
        navigation.set_parameter({before_the_visitor.str()}, 90000, "time");
        greeted = application.succeeds(navigation.start(), "navigation.start");
    }
    synthesis.set_parameter("Welcome. How can I help you?", "", 50, "en", "");
    greeted = greeted && application.succeeds(synthesis.start(), "speech_synthesis.start");
    reaction.set_parameter({"9"});  // a bow, of annex D
    greeted = greeted && application.succeeds(reaction.start(), "reaction.start");
    std::cout << (greeted ? "greeted a visitor\n" : "greeted no visitor\n");
    return system.disconnect() == RoIS_HRI::OK && greeted ? 0 : 1;
}
// NOLINTEND(modernize-use-override)
