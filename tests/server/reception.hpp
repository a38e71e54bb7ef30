// Figure 1 of the specification as a service application: wait for a person, go there, find out who it is, tell the message or
// ask and hear the answer, bow, say goodbye, return to the start.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "server/application.hpp"

namespace rois::test {

// How one visitor was received.
struct Received {
    std::string visitor;             // the permanent id; empty when nobody was identified
    std::string told;                // what the robot said
    std::vector<std::string> heard;  // what was said to the robot then

    bool operator==(Received const&) const = default;
};
std::ostream& operator<<(std::ostream&, Received const&);

struct Pose {
    double x = 0, y = 0;  // mm
    double th = 0;        // degrees
};
double distance(Pose const&, Pose const&);  // mm

class Reception {
public:
    // Connects, binds and subscribes. `messages`: what is there for whom.
    Reception(Way, GatewayProcess const&, std::map<std::string, std::string> messages);

    // Receives the next person who has not been received, and returns to the start.
    Received receive();
    // Unsubscribes, and detects once more what nobody hears then.
    void close();

    Pose where();  // the robot, measured
    Pose const& start() const { return start_; }
    std::vector<Document> const& history() const { return engine_.history(); }
    std::vector<std::string> const& commanded() const { return commanded_; }  // ids, in the order in which they were given
    std::vector<std::string> const& driven() const { return driven_; }        // those of navigation

private:
    struct Person {
        Pose pose;
        std::string ref;
    };

    void wait_for_a_person();
    // Of those who stand: who has this temporary name, else the nearest who has not been received.
    Person locate(std::string const& ref = "");
    std::vector<Person> standing();  // who have not been received, nearest first
    Pose approach();                 // where the person is that stands before the robot then
    bool go_to(Pose const&);
    std::string identify();
    std::vector<std::string> say_and_listen(std::string const& text);
    void bow();

    // Runs units one after the other until the last has completed; what was heard until then.
    std::vector<Document> run(std::vector<Command> units);
    std::string fresh_id(std::string const& of);

    Application engine_;
    std::map<std::string, std::string> messages_;
    Pose start_;
    std::vector<Pose> received_;
    std::vector<std::string> subscriptions_;
    std::vector<std::string> commanded_;
    std::vector<std::string> driven_;
};

}  // namespace rois::test
