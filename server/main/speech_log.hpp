// Logs the speech of the robots in the hall: voice, language, duration and prosody.
#pragma once

#include <cstdint>
#include <memory>

#include "simulation/world/simulation.hpp"

namespace rois {

// Logs during its lifetime.
class SpeechLog : private simulation::Observer {
public:
    explicit SpeechLog(std::shared_ptr<simulation::Simulation>);
    ~SpeechLog() override;
    SpeechLog(SpeechLog const&) = delete;
    SpeechLog& operator=(SpeechLog const&) = delete;

private:
    void observe(Instant when) override;

    std::shared_ptr<simulation::Simulation> simulation_;
    std::uint64_t read_ = 0;  // the last entry of the chronicle that was read
};

}  // namespace rois
