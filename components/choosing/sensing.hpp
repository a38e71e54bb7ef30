// A logical component that senses with all its members, and reports what they sense as one (docs/choosing.md).
#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "choosing/logical.hpp"
#include "choosing/sightings.hpp"

namespace rois::choosing {

// While active, binds and starts every free member, also those that come or recover later.
class Sensing final : public Logical, private Observer {
public:
    Sensing(ComponentDescription, std::shared_ptr<Roster>, std::shared_ptr<Sightings>);
    ~Sensing() override;
    Sensing(Sensing const&) = delete;
    Sensing& operator=(Sensing const&) = delete;

    void attach(ComponentPort&) override;

private:
    // What an event reports, by the results in its profile.
    enum class Reports : std::uint8_t {
        positions,  // `person_ref` and `position_data`: all persons whom the unit senses
        names,      // `person_ref`
        number,     // `number`
        other
    };
    struct Event {
        std::string type;
        Reports reports = Reports::other;
        std::string kind{};  // "person", "face", "sound": the part of the event's name before the first '_'
    };
    static std::vector<Event> events_of(ComponentProfile const&);
    Event const* find(std::string_view type) const;

    std::optional<std::string> why_never(std::string_view command_type) const override;
    std::vector<std::string> candidates(ParameterList const& parameters) override;
    bool is_used(std::string const& ref) const override { return started_.contains(ref); }
    void begin(std::string const& command_type, ParameterList const&, CommandHandle) override;
    void start(std::string const& ref, std::shared_ptr<CommandHandle> const& for_command);
    void complete(std::shared_ptr<CommandHandle> const&, Outcome const&);
    void change_parameters(ParameterList const&, CommandHandle);
    void end_sensing();
    void lose(Member const&);

    void take(Event const&, ReceiveEvent const&, Member const&, Instant now);
    void take_positions(Event const&, ReceiveEvent const&, Member const&, Instant now);
    bool differs(Fusion const&, Instant now) const;
    void report_positions(Event const&, Instant now);
    void report_names(Event const&, ReceiveEvent const&, Member const&, Instant now);
    void report_once(Event const&, Results, Member const&, Instant now);
    void report_number(Event const&, Instant now);
    void report_misplaced(Event const&);

    void forget_commands() override { end_sensing(); }
    void abort_commands() override { end_sensing(); }
    void happened(ReceiveEvent const&, Member const&, Instant now) override;
    void changed(Member const&) override;
    Member const* shown() override;
    bool has_warning() const override { return !misplaced_.empty(); }
    void time_passed(Instant now) override;
    void report_problems(Member const&, Received const&);

    std::shared_ptr<Sightings> const sightings_;
    std::vector<Event> const events_;
    bool is_active_ = false;
    ParameterList parameters_;           // of `start`
    std::set<std::string> started_;      // refs of the members that sense, or are starting
    std::map<std::string, int> counts_;  // the last number of each member, by ref
    std::optional<std::size_t> reported_number_;
    struct Reported {
        Steady at;
        std::string engine;
        std::string type;
        ParameterList content;  // without the timestamp
    };
    std::vector<Reported> reported_;      // the last events without positions
    bool has_news_ = false;               // since the last report of positions: a list of a member, or another name
    std::map<std::string, Vector> told_;  // the positions of the last report, by name, in metres
    Steady reported_at_{};
    std::set<std::string> misplaced_;  // engines
    std::set<std::string> faulty_;     // refs of the members whose last list had a problem
};

}  // namespace rois::choosing
