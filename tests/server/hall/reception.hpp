// Figure 1 of the specification as a service application: wait for a person, drive there, identify them, say the message or
// listen to the answer, bow, say goodbye, return to the start.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "server/application.hpp"

namespace rois::test {

// The outcome for one visitor.
struct Received {
    std::string visitor;               // the permanent id; empty if the visitor was not identified
    std::string message;               // words of the robot
    std::vector<std::string> answers;  // words of the visitor

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
    // Connects, binds and subscribes. `messages` maps the id of a visitor to the message for them.
    Reception(Transport, GatewayProcess const&, std::map<std::string, std::string> messages);

    // Receives the next person who has not been received, and returns to the start.
    Received receive();
    // Unsubscribes, and starts detection once more, without a subscriber.
    void close();

    Pose where();  // the measured pose of the robot
    Pose const& start() const { return start_; }
    std::vector<Document> const& history() const { return engine_.history(); }
    std::vector<std::string> const& commanded() const { return commanded_; }  // ids, in the order of the commands
    std::vector<std::string> const& driven() const { return driven_; }        // ids of the navigation commands

private:
    struct Person {
        Pose pose;
        std::string ref;
    };

    void wait_for_a_person();
    // Returns the standing person with this temporary name, else the nearest one who has not been received.
    Person locate(std::string const& ref = "");
    std::vector<Person> standing();  // standing people who have not been received, nearest first
    Pose approach();                 // drives to a person, and returns their pose
    bool go_to(Pose const&);
    std::string identify();
    std::vector<std::string> say_and_listen(std::string const& text);
    void bow();

    // Runs units in sequence until the last has completed. Returns the notifications until then.
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
