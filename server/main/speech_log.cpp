#include "main/speech_log.hpp"

#include <spdlog/spdlog.h>

#include <utility>
#include <variant>

#include "basic/speech/voice_characters.hpp"
#include "types/text/texts.hpp"

namespace rois {

namespace {

constexpr std::size_t shown = 200;  // bytes of a text that are shown

using simulation::Happening;

void log(Happening const& happening, std::string const& robot) {
    if (happening.kind == Happening::Kind::speech_started) {
        std::string voice;
        if (happening.character != basic::default_character) voice += ", voice " + happening.character;
        if (!happening.prosody.empty()) voice += ", " + happening.prosody;
        spdlog::info("{} says in {}, {:.2f} s{}: {}", robot, happening.language, happening.lasts, voice,
                     quoted(happening.text, shown));
    }
    if (happening.kind == Happening::Kind::speech_broken) spdlog::info("{} breaks off: {}", robot, quoted(happening.text, shown));
}

}  // namespace

SpeechLog::SpeechLog(std::shared_ptr<simulation::Simulation> simulation) : simulation_{std::move(simulation)} {
    simulation_->join(*this);
}

SpeechLog::~SpeechLog() { simulation_->part(*this); }

void SpeechLog::observe(Instant) {
    auto const& hall = simulation_->hall();
    for (Happening const& happening : hall.chronicle().since(read_)) {
        read_ = happening.sequence;
        if (auto const* robot = std::get_if<simulation::RobotId>(&happening.who)) log(happening, hall.robot(*robot).name);
    }
}

}  // namespace rois
