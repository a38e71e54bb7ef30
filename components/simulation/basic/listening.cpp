#include "simulation/basic/listening.hpp"

#include <algorithm>
#include <utility>

namespace rois::simulation {

void Listening::begin() {
    inputs_.clear();
    read_ = missed_until_ = hall().chronicle().last();
}

void Listening::suspended() {
    for (auto& [who, input] : inputs_) input.whole = false;
}

void Listening::resumed() { missed_until_ = hall().chronicle().last(); }

void Listening::sense(Instant when) {
    for (Happening const& happening : hall().chronicle().since(read_)) {
        read_ = happening.sequence;
        if (happening.who == Entity{robot()}) continue;
        if (happening.kind == Happening::Kind::speech_started) begins(happening, when);
        if (happening.kind == Happening::Kind::speech_finished || happening.kind == Happening::Kind::speech_broken ||
            happening.kind == Happening::Kind::left)
            ends(happening, when);
    }
}

void Listening::begins(Happening const& speech, Instant when) {
    if (speech.sequence <= missed_until_ || !hears(hall(), robot(), speech.place) || !listens_to(speech.place)) return;
    auto const sounds = sounds_heard(hall(), robot());
    auto const from = std::ranges::find(sounds, speech.who, &HeardSound::who);
    inputs_[speech.who] = {true, when, from == sounds.end() ? std::nullopt : std::optional{*from}};
    began(when);
}

void Listening::ends(Happening const& speech, Instant when) {
    auto const found = inputs_.extract(speech.who);
    if (found.empty()) return;
    ended(when);
    auto const& input = found.mapped();
    bool const whole = input.whole && speech.kind == Happening::Kind::speech_finished;
    if (whole && hears(hall(), robot(), speech.place)) heard({speech.text, speech.language, input.began, input.from}, when);
}

}  // namespace rois::simulation
