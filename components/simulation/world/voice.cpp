#include "simulation/world/voice.hpp"

#include <algorithm>
#include <iterator>

namespace rois::simulation {

UtteranceId Voice::speak(Utterance utterance, WorldTime now, Point const& place, Chronicle& chronicle) {
    if (state_ == SpeechState::speaking || state_ == SpeechState::held) finish(SpeechState::broken, now, place, chronicle);
    last_ = UtteranceId{static_cast<std::uint64_t>(last_) + 1};
    state_ = SpeechState::speaking;
    loudness_ = std::clamp(utterance.loudness, 0.0, 1.0);
    further_.assign(std::make_move_iterator(utterance.passages.begin()), std::make_move_iterator(utterance.passages.end()));
    begin_passage(now, place, chronicle);
    return last_;
}

void Voice::begin_passage(WorldTime now, Point const& place, Chronicle& chronicle) {
    auto passage = std::move(further_.front());
    further_.pop_front();
    speech_ = {std::move(passage.text), std::move(passage.language), now, now + world_time(passage.duration),
               std::move(passage.character)};
    chronicle.add({0, now, Happening::Kind::speech_started, speaker_, place, speech_.text, speech_.language, passage.duration,
                   std::move(passage.prosody), speech_.character});
}

SpeechState Voice::state(UtteranceId id) const {
    if (id == last_) return state_;
    auto found = std::ranges::find(ended_, id, &std::pair<UtteranceId, SpeechState>::first);
    return found == ended_.end() ? SpeechState::broken : found->second;
}

void Voice::break_off(UtteranceId id, WorldTime now, Point const& place, Chronicle& chronicle) {
    if (id != last_ || (state_ != SpeechState::speaking && state_ != SpeechState::held)) return;
    finish(SpeechState::broken, now, place, chronicle);
}

void Voice::hold(UtteranceId id, WorldTime now) {
    if (id != last_ || state_ != SpeechState::speaking) return;
    state_ = SpeechState::held;
    left_when_held_ = speech_.ends - now;
}

void Voice::go_on(UtteranceId id, WorldTime now) {
    if (id != last_ || state_ != SpeechState::held) return;
    state_ = SpeechState::speaking;
    speech_.ends = now + left_when_held_;
}

void Voice::step(WorldTime now, Point const& place, Chronicle& chronicle) {
    if (state_ != SpeechState::speaking || now < speech_.ends) return;
    if (further_.empty()) return finish(SpeechState::spoken, now, place, chronicle);
    chronicle.add({0, now, Happening::Kind::speech_finished, speaker_, place, speech_.text, speech_.language, 0, {}});
    begin_passage(now, place, chronicle);
}

std::optional<Speech> Voice::speech() const { return state_ == SpeechState::speaking ? std::optional{speech_} : std::nullopt; }

void Voice::finish(SpeechState state, WorldTime now, Point const& place, Chronicle& chronicle) {
    constexpr std::size_t remembered = 16;
    state_ = state;
    further_.clear();
    ended_.emplace_back(last_, state);
    if (ended_.size() > remembered) ended_.pop_front();
    auto const kind = state == SpeechState::spoken ? Happening::Kind::speech_finished : Happening::Kind::speech_broken;
    chronicle.add({0, now, kind, speaker_, place, speech_.text, speech_.language, 0, {}});
}

}  // namespace rois::simulation
