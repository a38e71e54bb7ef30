// The log of the robots' speech.
#include <csignal>

#include "server/conversation.hpp"

namespace rois::test {
namespace {

TEST(Speech, IsLoggedPassageByPassage) {
    GatewayProcess gateway{{"--scenario", ROIS_SOURCE_DIR "/tests/server/data/empty_hall.xml", "--sim-speed", "20"}};
    {
        Application desk{Transport::http, gateway};
        desk.connect();
        desk.bind("speech_synthesis");
        desk.execute(Command{.component = "speech_synthesis",
                             .id = "greet",
                             .arguments = {{"SSML_text",
                                            "string",
                                            {"<speak xml:lang='en'>Welcome, <lang xml:lang='ja'>ようこそ</lang> <break "
                                             "time='1s'/><prosody pitch='high' volume='soft'>Tanaka</prosody> "
                                             "<voice name='child'>Hello</voice></speak>"}}}});
        EXPECT_EQ(desk.status_of("greet"), "OK");
    }
    gateway.signal(SIGTERM);
    auto const log = gateway.wait().error;
    EXPECT_THAT(log, HasSubstr("info robot1 says in en, 0.52 s: 'Welcome,'"));
    EXPECT_THAT(log, HasSubstr("info robot1 says in ja, 1.60 s: 'ようこそ'"));
    EXPECT_THAT(log, HasSubstr("info robot1 says in en, 0.39 s, pitch high, volume soft: 'Tanaka'"));
    EXPECT_THAT(log, HasSubstr("info robot1 says in en, 0.27 s, voice child: 'Hello'"));
}

}  // namespace
}  // namespace rois::test
