#include "basic/base/listening.hpp"

#include <utility>

namespace rois::basic {

void Listening::begin() {
    inputs_.clear();
    read_ = missed_until_ = perception().last_sequence();
}

void Listening::suspended() {
    for (auto& [who, input] : inputs_) input.whole = false;
}

void Listening::resumed() { missed_until_ = perception().last_sequence(); }

void Listening::sense(Instant when) {
    for (auto& event : perception().speech_since(std::exchange(read_, perception().last_sequence()))) {
        if (event.kind == SpeechEvent::Kind::began) {
            begins(std::move(event), when);
        } else {
            ends(std::move(event), when);
        }
    }
}

void Listening::begins(SpeechEvent speech, Instant when) {
    if (speech.sequence <= missed_until_ || !listens_to(speech.place)) return;
    inputs_[speech.speaker] = {true, when, std::move(speech.source)};
    began(when);
}

void Listening::ends(SpeechEvent speech, Instant when) {
    auto found = inputs_.extract(speech.speaker);
    if (found.empty()) return;
    ended(when);
    auto& input = found.mapped();
    if (input.whole && speech.kind == SpeechEvent::Kind::ended)
        heard({std::move(speech.text), std::move(speech.language), input.began, std::move(input.source)}, when);
}

}  // namespace rois::basic
