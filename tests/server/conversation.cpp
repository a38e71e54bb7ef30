#include "server/conversation.hpp"

namespace rois::test {

GatewayProcess& empty_hall() {
    static GatewayProcess hall{
        {"--scenario", ROIS_SOURCE_DIR "/tests/server/data/empty_hall.xml", "--sim-speed", "20", "--seed", "1"}};
    return hall;
}

Command speak_long(std::string const& id) {
    std::string text;
    for (int i = 0; i < 2'000; ++i) text += "words, ";
    return speak(text, id);
}

}  // namespace rois::test
