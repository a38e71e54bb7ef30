// Tests operate components like the engine, with a manual clock.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "basic/body/pose.hpp"
#include "engine/local_component.hpp"
#include "files/files.hpp"
#include "xml/profiles/profile_document.hpp"

namespace rois::basic::stage {

// A report of a component: an event, or the progress of a command.
struct LogEntry {
    std::string what;  // the event's type, or "started", or "completed OK"
    Results results;   // of an event
    WorldTime at{};
};

// One component with its port. Stores the parameters like the engine. Expects answers to all questions within the call.
class Operated final : public ComponentPort {
public:
    Operated(std::unique_ptr<Component> component, std::function<Instant()> now, std::function<WorldTime()> world_now)
        : component_{std::move(component)}, now_{std::move(now)}, world_now_{std::move(world_now)} {
        call([&] { component_->attach(*this); });
    }

    ComponentDescription const& description() const { return component_->description(); }

    // The state that the component has reported last.
    ComponentStatus status() const { return state_.status; }
    std::optional<Located> const& location() const { return state_.location; }
    ParameterList const& readable_parameters() const { return state_.parameters; }

    // Call this after each step of the component's world: lets the component report.
    void after_step() { component_->after_call(); }

    // Returns why the command is refused. For start and set_parameter, `arrived` is merged into the stored parameters.
    std::optional<std::string> refusal(std::string_view command_type, ParameterList const& arrived) {
        bool const is_stored = command_type == "start" || command_type == "set_parameter";
        auto const prepared = prepare(command_type, is_stored ? merged(arrived) : arrived);
        auto const* refused = std::get_if<Refused>(&prepared);
        return refused == nullptr ? std::nullopt : std::optional{refused->reason};
    }

    void set_parameter(ParameterList const& arrived) {
        auto const begin = accepted("set_parameter", merged(arrived));
        stored_ = merged(arrived);
        setting_ = CommandHandle{++handles_};
        call([&] { begin(*setting_, now_()); });
        EXPECT_FALSE(setting_) << "set_parameter has not completed";
    }

    // All parameters are their defaults again: none is stored.
    void restore_defaults() {
        stored_.clear();
        call([&] { component_->parameters_changed(stored_, now_()); });
    }

    void start(ParameterList const& arrived = {}) {
        auto const begin = accepted("start", merged(arrived));
        if (runs_) stop();
        stored_ = merged(arrived);
        runs_ = true;
        carry_out(begin);
    }

    // A command of the component's own profile.
    CommandHandle perform(std::string_view command_type, ParameterList const& arguments) {
        return carry_out(accepted(command_type, arguments));
    }

    // The two halves of perform(). accepted() throws if the command is refused.
    Begin accepted(std::string_view command_type, ParameterList const& parameters) {
        auto prepared = prepare(command_type, parameters);
        if (auto const* refused = std::get_if<Refused>(&prepared))
            throw std::logic_error(std::string{command_type} + " is refused: " + refused->reason);
        return std::get<Begin>(std::move(prepared));
    }
    CommandHandle carry_out(Begin const& begin) {
        last_ = CommandHandle{++handles_};
        call([&] { begin(last_, now_()); });
        return last_;
    }

    Halted stop() {
        runs_ = false;
        halt_ = Ticket{++tickets_};
        halted_ = Halted::not_yet;
        call([&] { component_->halt(halt_, now_()); });
        return *std::exchange(halted_, {});
    }
    void suspend() {
        expect_done(ask([&](Ticket ticket) { call([&] { component_->suspend(ticket, now_()); }); }));
    }
    void resume() {
        expect_done(ask([&](Ticket ticket) { call([&] { component_->resume(ticket, now_()); }); }));
    }

    bool answers(std::string_view query_type) { return answer_to(query_type).has_value(); }
    std::vector<Results> rows(std::string_view query_type) {
        return std::get<std::vector<Results>>(answer_to(query_type).value());
    }
    Results query(std::string_view query_type) {
        auto all = rows(query_type);
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

    // Returns "OK", or "ERROR" with its reason; nothing if the command has not ended.
    std::optional<std::string> outcome(CommandHandle command) const {
        auto const found = outcomes_.find(command);
        return found == outcomes_.end() ? std::nullopt : std::optional{found->second};
    }

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

    void report(ComponentReport&& report) override {
        std::visit([&](auto& each) { take(each); }, report);
    }

private:
    // Calls the component like the engine: it reports after the call, even if it throws.
    template <class What>
    void call(What const& what) {
        try {
            what();
        } catch (...) {
            component_->after_call();
            throw;
        }
        component_->after_call();
    }

    // Returns nothing if the component has not answered within the call.
    template <class Question>
    std::optional<ComponentAnswer> ask(Question const& question) {
        answer_.reset();
        asked_ = Ticket{++tickets_};
        question(asked_);
        return std::exchange(answer_, {});
    }
    std::optional<ComponentAnswer> answer_to(std::string_view query_type) {
        return ask([&](Ticket ticket) { component_->query(ticket, query_type, now_()); });
    }
    Prepared prepare(std::string_view command_type, ParameterList const& parameters) {
        auto answer = ask([&](Ticket ticket) { component_->prepare(ticket, command_type, parameters, now_()); }).value();
        if (auto* refused = std::get_if<Refused>(&answer)) return std::move(*refused);
        return std::get<Begin>(std::move(answer));
    }
    static void expect_done(std::optional<ComponentAnswer> const& answer) {
        EXPECT_TRUE(answer && std::holds_alternative<Done>(*answer));
    }

    ParameterList merged(ParameterList const& arrived) const {
        auto const has_arrived = [&](std::string const& name) { return find(arrived, name) != nullptr; };
        ParameterList all = stored_;
        std::erase_if(all, [&](Parameter const& each) { return has_arrived(each.name); });
        for (auto const& group : description().alternatives)
            if (std::ranges::any_of(group, has_arrived))
                std::erase_if(all, [&](Parameter const& each) { return std::ranges::find(group, each.name) != group.end(); });
        all.insert(all.end(), arrived.begin(), arrived.end());
        return all;
    }

    void take(StateChanged const& state) { state_ = *state; }
    void take(OperationAsked&) { ADD_FAILURE() << "only logical components have a session"; }
    void take(MemberSwitched&) { ADD_FAILURE() << "only logical components have members"; }
    void take(Answered& answered) {
        EXPECT_EQ(answered.ticket, asked_);
        EXPECT_FALSE(answer_) << "two answers to one question";
        answer_ = std::move(answered.answer);
    }
    void take(HaltConfirmed const& confirmed) {
        EXPECT_EQ(confirmed.ticket, halt_);
        if (!halted_) return record("halted");
        halted_ = Halted::confirmed;
    }
    void take(HaltFailed const&) { ADD_FAILURE() << "only a sub engine reports that a halt has failed"; }
    void take(CommandStarted const&) { record("started"); }
    void take(CommandEnded& ended) {
        if (setting_ == ended.command) {
            EXPECT_EQ(ended.status, CompletedStatus::ok);
            return setting_.reset();
        }
        if (!any_command_) {
            EXPECT_EQ(ended.command, last_);
        }
        std::string const status{to_text(ended.status)};
        auto const outcome = status + (ended.reason.empty() ? "" : " " + ended.reason);
        EXPECT_TRUE(outcomes_.emplace(ended.command, outcome).second) << "a command ends once";
        last_results_ = std::move(ended.results);
        last_afterwards_ = ended.afterwards;
        last_reason_ = std::move(ended.reason);
        runs_ = ended.afterwards == Afterwards::active;
        record("completed " + status + (runs_ ? ", active" : ""));
    }
    void take(EventOccurred const& event) { record(event.event_type, *event.results); }
    void take(ErrorOccurred const& error) { record((error.report == Report::once ? "error, once: " : "error ") + error.text); }
    void record(std::string what, Results results = {}) { log_.push_back({std::move(what), std::move(results), world_now_()}); }

    std::unique_ptr<Component> component_;
    std::function<Instant()> now_;
    std::function<WorldTime()> world_now_;
    ComponentState state_;
    ParameterList stored_;

    std::uint64_t tickets_ = 0;
    Ticket asked_{};                         // of the last question
    std::optional<ComponentAnswer> answer_;  // to the last question
    Ticket halt_{};                          // of the last halt
    std::optional<Halted> halted_;           // during a halt

    std::uint64_t handles_ = 0;
    CommandHandle last_{};                  // of the last command, except set_parameter
    std::optional<CommandHandle> setting_;  // a set_parameter that has not completed
    bool runs_ = false;
    bool any_command_ = false;
    std::map<CommandHandle, std::string> outcomes_;
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
inline std::vector<ComponentProfile> own_profiles() { return xml::read_component_profiles(schemas(), files::profiles()); }

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
