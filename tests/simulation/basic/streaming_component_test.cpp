#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "basic/streaming/media_offers.hpp"
#include "simulation/component_stage.hpp"

namespace rois::simulation::stage {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Optional;
using testing::SizeIs;

Parameter encoding(std::string wanted) { return text("encoding_parameters", std::move(wanted)); }
Parameter transport(std::string wanted) { return text("transport_parameters", std::move(wanted)); }
ParameterList stream(std::string id) { return {text("stream_id", std::move(id))}; }

// Returns "audio_streaming-1 RUNNING".
std::vector<std::string> reported(Operated& component) {
    std::vector<std::string> all;
    for (auto const& event : component.events("notify_stream_status"))
        all.push_back(value(event.results, "stream_id") + " " +
                      value(event.results, "status").substr(std::string{"STREAMING_"}.size()));
    component.forget();
    return all;
}

std::vector<std::string> rows(Operated& component) {
    std::vector<std::string> all;
    for (auto const& row : component.rows("get_stream_status"))
        all.push_back(value(row, "stream_id") + " " + value(row, "status").substr(std::string{"STREAMING_"}.size()));
    return all;
}

struct AudioStreaming : testing::Test {
    AudioStreaming() { stage.step(); }

    // The results of a connect_stream that succeeds.
    Results connected(ParameterList const& parameters = {}) {
        if (!parameters.empty()) audio.set_parameter(parameters);
        audio.perform("connect_stream", {});
        EXPECT_EQ(audio.ended(), "OK, active");
        return audio.results();
    }
    FakeMedia::Offered& offered(std::size_t index = 0) { return *stage.media().all.at(index); }
    void happens(media::Reception reception, std::size_t index = 0) {
        offered(index).news.push_back(reception);
        stage.step();
    }

    Stage stage;
    Operated& audio = stage["audio_streaming"];
};

TEST_F(AudioStreaming, HasThePitchOfTheSpeakingVoice) {
    connected();
    auto const& tone = std::get<media::Sound>(offered().content).tone;
    stage.step();
    EXPECT_EQ(tone.current_frequency(), 440);
    std::set<double> pitches;
    for (auto const* character : {"default", "female", "male", "child", "robot"}) {
        stage["speech_synthesis"].start({text("speech_text", "Good morning."), text("character", character)});
        stage.step();
        pitches.insert(tone.current_frequency());
        EXPECT_EQ(stage.outcome("speech_synthesis"), "OK");
        stage.step();
        EXPECT_EQ(tone.current_frequency(), 440) << "after the speech";
    }
    EXPECT_THAT(pitches, ElementsAre(90, 120, 165, 210, 300));
}

TEST_F(AudioStreaming, ReportsTheNegotiatedParameters) {
    auto const results = connected();
    EXPECT_EQ(value(results, "stream_id"), "audio_streaming-1");
    EXPECT_EQ(value(results, "encoding_parameters"), "audio/wav;rate=16000;channels=1");
    EXPECT_EQ(value(results, "transport_parameters"), "http://media.test/1");
    auto const& sound = std::get<media::Sound>(offered().content);
    EXPECT_EQ(sound.tone.frequency, 440);
    EXPECT_EQ(sound.tone.rate, 16'000u);
    EXPECT_THAT(reported(audio), ElementsAre("audio_streaming-1 NOT_RUNNING"));
}

TEST_F(AudioStreaming, NegotiatesTheFirstSupportedPair) {
    auto const agreed = [&](std::string encodings, std::string transports) {
        auto const results = connected({encoding(std::move(encodings)), transport(std::move(transports))});
        return value(results, "encoding_parameters") + " " + value(results, "transport_parameters");
    };
    EXPECT_EQ(agreed("audio/L16;rate=44100;channels=2", "http"), "audio/L16;rate=44100;channels=2 http://media.test/1");
    EXPECT_EQ(agreed("audio/opus, AUDIO/L16 ; Rate=8000", ""), "audio/L16;rate=8000;channels=1 http://media.test/2");
    EXPECT_EQ(agreed("", "rtp://127.0.0.1:5004"), "audio/L16;rate=16000;channels=1 rtp://127.0.0.1:5004;ssrc=7");
    EXPECT_EQ(agreed("audio/wav, audio/L16", "rtp://127.0.0.1:1, http"),
              "audio/L16;rate=16000;channels=1 rtp://127.0.0.1:1;ssrc=7");
    EXPECT_EQ(agreed("audio/wav", "rtp://192.0.2.1:5004, http"), "audio/wav;rate=16000;channels=1 http://media.test/5");
}

TEST_F(AudioStreaming, ListsItsEncodingsAndTransports) {
    auto const readable = audio.readable_parameters();
    EXPECT_EQ(find(readable, "available_encodings")->values.front(), "audio/wav, audio/L16");
    EXPECT_EQ(find(readable, "available_transports")->values.front(), "http, rtp");
}

TEST_F(AudioStreaming, RefusesUnsupportedParameters) {
    auto const why = [&](std::string encodings, std::string transports = "") {
        return audio.refusal("set_parameter", {encoding(std::move(encodings)), transport(std::move(transports))})
            .value_or("fine");
    };
    EXPECT_THAT(why("audio/opus"),
                HasSubstr("'encoding_parameters': 'audio/opus' is not supported; expected one of audio/wav, audio/L16"));
    EXPECT_THAT(why("audio/wav;rate=11025"), HasSubstr("rate must be one of 16000, 8000, 44100, 48000"));
    EXPECT_THAT(why("audio/wav;rate=fast"), HasSubstr("not 'fast'"));
    EXPECT_THAT(why("audio/wav;bits=8"), HasSubstr("'audio/wav' has no field 'bits'"));
    EXPECT_THAT(why("audio/wav;16000"), HasSubstr("name=value"));
    EXPECT_THAT(why("audio/wav,,audio/L16"), HasSubstr("empty"));
    EXPECT_THAT(why(std::string(2'000, 'x')), HasSubstr("1024"));
    EXPECT_THAT(why("a,b,c,d,e,f,g,h,i,j,k,l,m,n,o,p,q"), HasSubstr("more than 16 entries"));
    EXPECT_THAT(why("", "smtp"), HasSubstr("'transport_parameters': 'smtp' is not supported; expected one of http, rtp"));
    EXPECT_THAT(why("", "rtp://192.0.2.1:5004"), HasSubstr("'transport_parameters': this target is not allowed"));
    EXPECT_THAT(why("", "http://127.0.0.1:80/"), HasSubstr("'http' takes no target"));
    EXPECT_THAT(why("", "http;port=80"), HasSubstr("no field 'port'"));
    EXPECT_THAT(why("audio/wav", "rtp://127.0.0.1:5004"), HasSubstr("audio/wav cannot be sent by RTP: use audio/L16"));
    EXPECT_EQ(why("audio/wav", "http"), "fine");
}

TEST_F(AudioStreaming, ReportsReception) {
    connected();
    reported(audio);
    happens(media::Reception::begun);
    EXPECT_THAT(rows(audio), ElementsAre("audio_streaming-1 RUNNING"));
    happens(media::Reception::ended);
    EXPECT_THAT(rows(audio), ElementsAre("audio_streaming-1 NOT_RUNNING"));
    EXPECT_THAT(reported(audio), ElementsAre("audio_streaming-1 RUNNING", "audio_streaming-1 NOT_RUNNING"));
}

TEST_F(AudioStreaming, SuspendsAndResumesAStream) {
    connected();
    happens(media::Reception::begun);
    reported(audio);
    audio.perform("suspend_stream", stream("audio_streaming-1"));
    EXPECT_EQ(audio.ended(), "OK");
    EXPECT_TRUE(offered().held);
    EXPECT_TRUE(offered().open) << "receivers stay";
    EXPECT_THAT(rows(audio), ElementsAre("audio_streaming-1 SUSPENDED"));
    audio.perform("suspend_stream", stream("audio_streaming-1"));
    EXPECT_EQ(audio.ended(), "ERROR") << "suspended already";
    audio.perform("resume_stream", stream("audio_streaming-1"));
    EXPECT_EQ(audio.ended(), "OK");
    EXPECT_FALSE(offered().held);
    EXPECT_THAT(rows(audio), ElementsAre("audio_streaming-1 RESUMED"));
    audio.perform("resume_stream", stream("audio_streaming-1"));
    EXPECT_EQ(audio.ended(), "ERROR");
    EXPECT_THAT(reported(audio), ElementsAre("audio_streaming-1 SUSPENDED", "audio_streaming-1 RESUMED"));
}

TEST_F(AudioStreaming, ResumesWithoutReceivers) {
    connected();
    audio.perform("suspend_stream", stream("audio_streaming-1"));
    happens(media::Reception::begun);
    happens(media::Reception::ended);
    EXPECT_THAT(rows(audio), ElementsAre("audio_streaming-1 SUSPENDED"));
    reported(audio);
    audio.perform("resume_stream", stream("audio_streaming-1"));
    EXPECT_THAT(reported(audio), ElementsAre("audio_streaming-1 RESUMED", "audio_streaming-1 NOT_RUNNING"));
}

TEST_F(AudioStreaming, EndsWhenDisconnected) {
    connected();
    connected();
    reported(audio);
    audio.perform("disconnect_stream", stream("audio_streaming-1"));
    EXPECT_FALSE(offered(0).open);
    EXPECT_TRUE(offered(1).open);
    EXPECT_EQ(audio.afterwards(), Afterwards::as_before);
    EXPECT_THAT(reported(audio), ElementsAre("audio_streaming-1 NOT_CONNECTED"));
    EXPECT_THAT(rows(audio), ElementsAre("audio_streaming-2 NOT_RUNNING", "audio_streaming-1 NOT_CONNECTED"));
    auto const again = audio.accepted("disconnect_stream", stream("audio_streaming-2"));
    audio.perform("disconnect_stream", stream("audio_streaming-2"));
    EXPECT_EQ(audio.afterwards(), Afterwards::idle) << "no stream is connected";
    audio.carry_out(again);
    EXPECT_EQ(audio.ended(), "ERROR");
    EXPECT_EQ(audio.reason(), "the stream has been closed");
}

TEST_F(AudioStreaming, RefusesUnknownStreams) {
    for (auto const* command : {"disconnect_stream", "suspend_stream", "resume_stream"})
        EXPECT_THAT(audio.refusal(command, stream("moon")),
                    Optional(HasSubstr("stream 'moon' is not connected; connected: none")));
    connected();
    EXPECT_THAT(audio.refusal("suspend_stream", stream("moon")), Optional(HasSubstr("connected: audio_streaming-1")));
    EXPECT_EQ(audio.refusal("suspend_stream", stream("audio_streaming-1")), std::nullopt);
    EXPECT_EQ(audio.refusal("connect_stream", {}), std::nullopt);
}

TEST_F(AudioStreaming, StopClosesAllStreams) {
    connected();
    connected();
    reported(audio);
    audio.stop();
    EXPECT_FALSE(offered(0).open || offered(1).open);
    EXPECT_THAT(reported(audio), ElementsAre("audio_streaming-1 NOT_CONNECTED", "audio_streaming-2 NOT_CONNECTED"));
    audio.stop();
    EXPECT_THAT(reported(audio), IsEmpty());
}

TEST_F(AudioStreaming, SuspendHoldsAllStreams) {
    connected();
    connected();
    audio.perform("suspend_stream", stream("audio_streaming-1"));
    audio.suspend();
    EXPECT_TRUE(offered(0).held && offered(1).held);
    audio.resume();
    EXPECT_TRUE(offered(0).held) << "it was suspended before";
    EXPECT_FALSE(offered(1).held);
    audio.suspend();
    audio.perform("resume_stream", stream("audio_streaming-2"));
    EXPECT_FALSE(offered(1).held);
    reported(audio);
    audio.resume();
    EXPECT_THAT(reported(audio), IsEmpty()) << "it is running already";
}

TEST_F(AudioStreaming, AStreamThatConnectsWhileAllAreSuspendedIsSuspended) {
    connected();
    audio.suspend();
    reported(audio);
    connected();
    EXPECT_TRUE(offered(1).held);
    EXPECT_THAT(reported(audio), ElementsAre("audio_streaming-2 SUSPENDED"));
    happens(media::Reception::begun, 1);
    EXPECT_THAT(reported(audio), IsEmpty());
    audio.resume();
    EXPECT_FALSE(offered(0).held || offered(1).held);
    EXPECT_THAT(reported(audio),
                ElementsAre("audio_streaming-1 RESUMED", "audio_streaming-1 NOT_RUNNING", "audio_streaming-2 RESUMED"));
    audio.suspend();
    audio.set_parameter({transport("rtp://127.0.0.1:5004")});
    connected();
    EXPECT_TRUE(offered(2).held);
    audio.stop();
    connected();
    EXPECT_FALSE(offered(3).held) << "no stream is suspended";
}

TEST_F(AudioStreaming, StartStartsNothing) {
    audio.start({encoding("audio/L16")});
    EXPECT_EQ(audio.ended(), "OK");
    EXPECT_THAT(rows(audio), ElementsAre(" NOT_CONNECTED"));
    EXPECT_EQ(value(connected(), "encoding_parameters"), "audio/L16;rate=16000;channels=1")
        << "the parameters of start are stored";
}

TEST_F(AudioStreaming, HasEightStreamsAtMost) {
    for (int i = 0; i < 8; ++i) connected();
    audio.perform("connect_stream", {});
    EXPECT_EQ(audio.ended(), "OUT_OF_RESOURCES");
    EXPECT_THAT(stage.media().all, SizeIs(8));
}

TEST_F(AudioStreaming, RemembersSixteenClosedStreams) {
    for (int i = 1; i <= 20; ++i) {
        connected();
        audio.perform("disconnect_stream", stream("audio_streaming-" + std::to_string(i)));
    }
    auto const all = rows(audio);
    EXPECT_THAT(all, SizeIs(16));
    EXPECT_EQ(all.front(), "audio_streaming-20 NOT_CONNECTED");
    EXPECT_EQ(all.back(), "audio_streaming-5 NOT_CONNECTED");
}

TEST(VideoStreaming, ShowsTheHall) {
    Stage stage{{visitor("guest", {does(Wait{60})})}};
    stage.run(2);
    auto& video = stage["video_streaming"];
    video.set_parameter({encoding("multipart/x-mixed-replace;size=240;framerate=5")});
    video.perform("connect_stream", {});
    EXPECT_EQ(value(video.results(), "stream_id"), "video_streaming-1");
    EXPECT_EQ(value(video.results(), "encoding_parameters"), "multipart/x-mixed-replace;size=240;framerate=5");
    auto const& film = std::get<media::Film>(stage.media().all.at(0)->content);
    EXPECT_EQ(film.frames_per_second, 5u);
    auto const picture = film.draw();
    ASSERT_TRUE(picture);
    EXPECT_EQ(picture->width, 240);
    EXPECT_EQ(picture->height, 160);
}

TEST(VideoStreaming, SupportsSinglePictures) {
    Stage stage;
    stage.step();
    auto& video = stage["video_streaming"];
    video.set_parameter({encoding("image/jpeg")});
    video.perform("connect_stream", {});
    EXPECT_EQ(value(video.results(), "encoding_parameters"), "image/jpeg;size=640");
    EXPECT_EQ(std::get<media::Film>(stage.media().all.at(0)->content).form, media::Film::Form::jpeg);
    EXPECT_THAT(video.refusal("set_parameter", {encoding("image/jpeg;size=5000")}),
                Optional(HasSubstr("size must be 64 to 1280")));
    EXPECT_THAT(video.refusal("set_parameter", {encoding("image/jpeg;framerate=5")}),
                Optional(HasSubstr("no field 'framerate'")));
    EXPECT_THAT(video.refusal("set_parameter", {transport("rtp://127.0.0.1:5004")}), Optional(HasSubstr("expected one of http")));
}

}  // namespace
}  // namespace rois::simulation::stage
