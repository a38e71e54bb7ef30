// What the robots of the hall say, in the log: whose voice, in which language, for how long, with which prosody.
#pragma once

#include <cstdint>
#include <memory>

#include "simulation/simulation.hpp"

namespace rois {

// Logs for as long as it lives.
class SpeechLog : private simulation::Observer {
public:
    explicit SpeechLog(std::shared_ptr<simulation::Simulation>);
    ~SpeechLog() override;
    SpeechLog(SpeechLog const&) = delete;
    SpeechLog& operator=(SpeechLog const&) = delete;

private:
    void observe(Instant when) override;

    std::shared_ptr<simulation::Simulation> simulation_;
    std::uint64_t read_ = 0;  // of the chronicle
};

}  // namespace rois
