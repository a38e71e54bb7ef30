// Tests operate components like the engine, with a manual clock.
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "basic/body/pose.hpp"
#include "engine/component.hpp"
#include "files/files.hpp"
#include "xml/profiles/profile_document.hpp"

namespace rois::basic::stage {

// A report of a component: an event, or the progress of a command.
struct LogEntry {
    std::string what;  // the event's type, or "started", or "completed OK"
    Results results;   // of an event
    WorldTime at{};
};

// One component with its port. Stores the parameters like the engine.
class Operated final : public ComponentPort {
public:
    Operated(std::unique_ptr<Component> component, std::function<Instant()> now, std::function<WorldTime()> world_now)
        : component_{std::move(component)}, now_{std::move(now)}, world_now_{std::move(world_now)} {
        component_->attach(*this);
    }

    Component& component() { return *component_; }

    // Returns why the command is refused with these parameters merged into the stored ones.
    std::optional<std::string> refusal(std::string const& command_type, ParameterList const& arrived) const {
        return component_->refusal(command_type, merged(arrived));
    }

    void set_parameter(ParameterList const& arrived) {
        stored_ = merged(arrived);
        component_->parameters_changed(stored_, now_());
    }

    void start(ParameterList const& arrived = {}) {
        if (runs_) component_->halt(now_());
        stored_ = merged(arrived);
        runs_ = true;
        component_->start(CommandHandle{++last_}, stored_, now_());
    }

    // A command of the component's own profile.
    void perform(std::string_view command_type, ParameterList const& arguments) {
        component_->perform(CommandHandle{++last_}, command_type, arguments, now_());
    }

    Halted stop() {
        runs_ = false;
        return component_->halt(now_());
    }
    void suspend() { component_->suspend(now_()); }
    void resume() { component_->resume(now_()); }
    std::vector<Results> rows(std::string_view type) { return component_->query(type, now_()); }
    Results query(std::string_view type) {
        auto all = rows(type);
        return all.empty() ? Results{} : all.front();
    }
    ParameterList const& stored() const { return stored_; }

    // The outcome of the last `start`; nothing if it has not ended.
    std::optional<std::string> ended() const {
        for (auto entry = log_.rbegin(); entry != log_.rend() && entry->what != "started"; ++entry)
            if (entry->what.starts_with("completed")) return entry->what.substr(std::string{"completed "}.size());
        return {};
    }

    // Of the last command that completed.
    Results const& results() const { return last_results_; }
    Afterwards afterwards() const { return last_afterwards_; }
    std::string const& reason() const { return last_reason_; }

    std::vector<LogEntry> const& log() const { return log_; }
    std::vector<std::string> words() const {
        std::vector<std::string> all;
        for (auto const& entry : log_) all.push_back(entry.what);
        return all;
    }
    std::vector<LogEntry> events(std::string_view type) const {
        std::vector<LogEntry> found;
        for (auto const& entry : log_)
            if (entry.what == type) found.push_back(entry);
        return found;
    }
    void forget() { log_.clear(); }
    // By default, only the last command may complete.
    void allow_any_command() { any_command_ = true; }

    void halted() override { record("halted", {}); }
    void started(CommandHandle) override { record("started", {}); }
    void completed(CommandHandle command, CompletedStatus status, Results results, Afterwards afterwards,
                   std::string reason) override {
        if (!any_command_) {
            EXPECT_EQ(static_cast<std::uint64_t>(command), last_);
        }
        last_results_ = std::move(results);
        last_afterwards_ = afterwards;
        last_reason_ = std::move(reason);
        runs_ = afterwards == Afterwards::active;
        record("completed " + std::string{to_text(status)} + (runs_ ? ", active" : ""), {});
    }
    void event(std::string_view type, Results results) override { record(std::string{type}, std::move(results)); }
    void error(ErrorType, std::string text, Report report) override {
        record((report == Report::once ? "error, once: " : "error ") + text, {});
    }

private:
    ParameterList merged(ParameterList const& arrived) const {
        ParameterList all = stored_;
        for (auto const& parameter : arrived) {
            std::erase_if(all, [&](Parameter const& p) { return p.name == parameter.name; });
            all.push_back(parameter);
        }
        component_->reconcile(all, arrived);
        return all;
    }
    void record(std::string what, Results results) { log_.push_back({std::move(what), std::move(results), world_now_()}); }

    std::unique_ptr<Component> component_;
    std::function<Instant()> now_;
    std::function<WorldTime()> world_now_;
    ParameterList stored_;
    std::uint64_t last_ = 0;
    bool runs_ = false;
    bool any_command_ = false;
    Results last_results_;
    std::string last_reason_;
    Afterwards last_afterwards_ = Afterwards::as_before;
    std::vector<LogEntry> log_;
};

inline std::vector<ComponentProfile> bare_profiles() {
    std::vector<ComponentProfile> profiles;
    for (auto name : {"SystemInformation", "PersonDetection", "PersonLocalization", "PersonIdentification", "FaceDetection",
                      "FaceLocalization", "SoundDetection", "SoundLocalization", "SpeechRecognition", "GestureRecognition",
                      "SpeechSynthesis", "Reaction", "Navigation", "Follow", "Move", "AudioStreaming", "VideoStreaming"}) {
        ComponentProfile profile;
        profile.object.identifier = "urn:x-rois:def:Component:omg::" + std::string{name};
        profiles.push_back(std::move(profile));
    }
    return profiles;
}

inline std::shared_ptr<xml::Schemas const> schemas() {
    static xml::Platform const platform;
    static auto const compiled = std::make_shared<xml::Schemas const>(files::schemas());
    return compiled;
}

// The profiles of the basic components.
inline std::vector<ComponentProfile> own_profiles() {
    std::vector<ComponentProfile> profiles;
    for (auto const& [name, text] : files::profiles())
        profiles.push_back(xml::read_component_profile(schemas(), name, std::string{text}));
    return profiles;
}

// An example of a user-defined component (components/simulation/profiles).
inline ComponentProfile shipped_profile(std::string const& file) {
    std::ifstream in{std::string{ROIS_SOURCE_DIR "/components/simulation/profiles/"} + file};
    return xml::read_component_profile(schemas(), file, {std::istreambuf_iterator<char>{in}, {}});
}

// An identifier with only a code.
inline Identifier coded(std::string code) {
    return {.code = std::move(code), .authority = {}, .codebook_ref = {}, .version = {}};
}

// A list of numbers: "1000 90".
inline Parameter integers(std::string name, std::string numbers) {
    return {std::move(name), coded("int[]"), {std::move(numbers)}};
}

// Readers of results.
inline std::string value(Results const& results, std::string_view name) {
    auto const* parameter = find(results.parameters, name);
    return parameter == nullptr || parameter->values.empty() ? "none" : parameter->values.front();
}
inline std::vector<std::string> values(Results const& results, std::string_view name) {
    auto const* parameter = find(results.parameters, name);
    return parameter == nullptr ? std::vector<std::string>{"none"} : parameter->values;
}
inline std::string codebook_of(Results const& results, std::string_view name) {
    auto const* parameter = find(results.parameters, name);
    return parameter == nullptr ? "none" : parameter->data_type_ref.codebook_ref;
}

}  // namespace rois::basic::stage
