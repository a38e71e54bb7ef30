#include "server/conversation.hpp"

namespace rois::test {

namespace {

struct EmptyHall {
    GatewayProcess gateway{
        {"--scenario", ROIS_SOURCE_DIR "/tests/server/data/empty_hall.xml", "--sim-speed", "20", "--seed", "1"}};

    // The components are ready after the first step of the world.
    EmptyHall() {
        Application application{Way::http, gateway};
        application.connect();
        while (application.query("engine_status").values()["status"].at(0) != "READY") {
        }
    }
};

}  // namespace

GatewayProcess& empty_hall() {
    static EmptyHall hall;
    return hall.gateway;
}

Command speak_long(std::string const& id) {
    std::string text;
    for (int i = 0; i < 2'000; ++i) text += "words, ";
    return speak(text, id);
}

}  // namespace rois::test
